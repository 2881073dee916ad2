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

/** What physics leaves to the offset: sigma^2 >= 0 below, no light less than none above. Each end allows for its
 * errors. */
struct OffsetLimits
{
  std::optional<double> lowestDn;               ///< null: not bounded
  double                highestDn{ 0.0 };       ///< the darkest level and what chance and offsets may make of it
  double                rootDn{ 0.0 };          ///< where the line says sigma = 0, without errors
  double                largestNoiseDn2{ 0.0 }; ///< sigma^2 if the offset were highestDn
};

/** The limits by the line of \a gain; \a quantisationDn2 is the codes' noise. */
SensorNoise_EXPORT OffsetLimits
LimitsOf(const RefinedResults & found, const GainEstimate & gain, double quantisationDn2);

} // namespace sensornoise

#endif
