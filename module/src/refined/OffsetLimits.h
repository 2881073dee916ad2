// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_OffsetLimits_h
#define sensornoise_refined_OffsetLimits_h

#include "SensorNoiseExport.h"
#include "refined/RefinedResults.h"

#include <optional>

namespace sensornoise
{

struct GainEstimate;

/** Bounds of the offset by physics: sigma^2 >= 0 from below, no pixel darker than the offset from above. Both bounds
 * are widened by their errors. */
struct OffsetLimits
{
  std::optional<double> lowestDn;               ///< null: not bounded [DN]
  double                highestDn{ 0.0 };       ///< the darkest level plus its error [DN]
  double                rootDn{ 0.0 };          ///< level at which the line has sigma = 0, without errors [DN]
  double                largestNoiseDn2{ 0.0 }; ///< sigma^2 if the offset is highestDn [DN^2]
};

/** Returns the bounds by the line of \a gain; \a quantisationDn2 is the variance of the quantization noise [DN^2]. */
SensorNoise_EXPORT OffsetLimits
LimitsOf(const RefinedResults & found, const GainEstimate & gain, double quantisationDn2);

} // namespace sensornoise

#endif
