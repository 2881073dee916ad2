// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_DarkSignal_h
#define sensornoise_refined_DarkSignal_h

#include "SensorNoiseExport.h"
#include "correlation/NoiseCorrelation.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "scene/ReferenceFrame.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Returns the fraction of the scene's signal that the dark frames contain, as of a shutter that was not closed [1].
 * Returns null if it is below InRefined.leastSignalOfDark or not significant, if too few places of the scene have
 * contrast, or if there are no maps of the dark frames.
 *
 * The estimate is the regression of the dark mean on the difference of bright and dark mean, within tiles of the
 * frame. Offsets of the pixels are in both means and cancel in the difference. \a pixelUse has a value of PixelUse for
 * each pixel. Estimator.md, 3.9. */
SensorNoise_EXPORT std::optional<MeasuredNumber>
FindDarkSignal(const std::optional<KnownOffset> & offset,
               const ReferenceFrame &             bright,
               const std::vector<std::uint8_t> &  pixelUse,
               const ParallelFor &                parallelFor);

} // namespace sensornoise

#endif
