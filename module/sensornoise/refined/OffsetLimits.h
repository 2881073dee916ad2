/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_refined_OffsetLimits_h
#define sensornoise_refined_OffsetLimits_h

#include "SensorNoiseExport.h"
#include "sensornoise/refined/RefinedResults.h"

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
