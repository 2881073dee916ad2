// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_PixelsOfVariance_h
#define sensornoise_refined_PixelsOfVariance_h

#include "SensorNoiseExport.h"
#include "pixels/VarianceLine.h"
#include "sensornoise/Settings.h"
#include "scene/StillScene.h"
#include "series/SceneSeries.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** The level without light, or one that it is hardly below: what is known, what the flicker tells, or the lowest code.
 * It serves to tell light from offset roughly, where the frames do not. [DN] */
SensorNoise_EXPORT double
BlackLevel(const RefinedSettings & settings, const StillScene & scene, const std::optional<const SceneSeries> & series);

/** The noise of rounding to codes [DN^2]. */
inline double
CodesVariance(const StillScene & scene)
{
  const double step = scene.summary.codes.quantisationStepDn;
  return step * step / 12.0;
}

/** The pixels that are usable, at levels that the user wants, and not found defective in dark frames: what is left out
 * in the dark is left out in the light. */
SensorNoise_EXPORT std::vector<std::uint8_t>
PixelsOfVariance(const StillScene & scene, const RefinedSettings & settings, std::vector<std::uint8_t> & pixelUse);

/** Leaves out of \a chosen the pixels whose surroundings have another level than they have. Where frames were filtered,
 * such a pixel's variance is a mean over other neighbours than its level is, and on no line. \a line is that of the
 * frames as they are. */
SensorNoise_EXPORT void
LeaveOutEdges(const ReferenceFrame &      frame,
              const VarianceLine &        line,
              std::vector<std::uint8_t> & chosen,
              std::vector<std::uint8_t> & pixelUse);

} // namespace sensornoise

#endif
