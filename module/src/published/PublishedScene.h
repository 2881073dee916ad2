// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedScene_h
#define sensornoise_published_PublishedScene_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/FrameGeometry.h"
#include "base/NothingToMeasure.h"
#include "moments/StackMaps.h"
#include "published/IsoIntensitySet.h"
#include "sensornoise/Settings.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** What pass 1 of the published method finds: maps of a frame's size, and the sets from which pass 2 tells the flicker.
 */
struct PublishedScene
{
  StackSummary                    summary;
  std::vector<double>             mean;     ///< [DN]
  std::vector<double>             variance; ///< of the stack as it is, flicker included [DN^2]
  std::vector<std::uint8_t>       valid;    ///< 1: finite, never clipped and not masked by the user
  std::vector<std::uint8_t>       kept;     ///< the vibration mask
  std::vector<std::uint8_t>       pixelUse; ///< values of PixelUse, as far as pass 1 tells
  IsoIntensitySet                 bright;   ///< S^*
  IsoIntensitySet                 dark;     ///< S_*
  IsoIntensitySet                 rowSet;   ///< of gamma_t(y); empty with RollingShutter::Off
  std::optional<NothingToMeasure> obstacle; ///< why the stack cannot be measured; null: it can
};

/** Sets valid (of which the pixels that \a mask leaves out are taken), kept and pixelUse of a scene whose mean,
 * variance and valid are those of the moments. An empty \a mask leaves out none. */
SensorNoise_EXPORT void
SortPixels(PublishedScene &                  scene,
           const PublishedSettings &         settings,
           const FrameGeometry &             geometry,
           std::size_t                       frames,
           const std::vector<std::uint8_t> & mask,
           const ParallelFor &               parallelFor);

/** Sets the iso-intensity sets of a scene whose pixels are sorted, or its obstacle. */
SensorNoise_EXPORT void
FindSets(PublishedScene &          scene,
         const PublishedSettings & settings,
         std::size_t               frames,
         const ParallelFor &       parallelFor);

} // namespace sensornoise

#endif
