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

/** Result of pass 1 of the published method: maps of a frame, and the sets from which pass 2 estimates the flicker. */
struct PublishedScene
{
  StackSummary                    summary;
  std::vector<double>             mean;          ///< [DN]
  std::vector<double>             variance;      ///< variance of the uncorrected stack, flicker included [DN^2]
  std::vector<std::uint8_t>       valid;         ///< 1: finite, never clipped and not masked by the user
  std::vector<std::uint8_t>       kept;          ///< 1: kept by the vibration mask
  std::vector<std::uint8_t>       pixelUse;      ///< values of PixelUse, as far as pass 1 determines them
  IsoIntensitySet                 bright;        ///< S^*
  IsoIntensitySet                 dark;          ///< S_*
  IsoIntensitySet                 rowSet;        ///< set for gamma_t(y); empty with RollingShutter::Off
  std::optional<NothingToMeasure> failureReason; ///< reason why the stack cannot be measured; null: it can
};

/** Sets valid, kept and pixelUse of a scene that has mean, variance and valid of the moments. Pixels that are 0 in
 * \a mask become invalid. An empty \a mask excludes no pixels. */
SensorNoise_EXPORT void
SortPixels(PublishedScene &                  scene,
           const PublishedSettings &         settings,
           const FrameGeometry &             geometry,
           std::size_t                       frames,
           const std::vector<std::uint8_t> & mask,
           const ParallelFor &               parallelFor);

/** Sets the iso-intensity sets of a scene after SortPixels(), or its obstacle. */
SensorNoise_EXPORT void
FindSets(PublishedScene &          scene,
         const PublishedSettings & settings,
         std::size_t               frames,
         const ParallelFor &       parallelFor);

} // namespace sensornoise

#endif
