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
#ifndef sensornoise_correlation_SpaceCorrelation_h
#define sensornoise_correlation_SpaceCorrelation_h

#include "SensorNoiseExport.h"
#include "sensornoise/correlation/CorrelationSums.h"
#include "sensornoise/correlation/NoiseCorrelation.h"

namespace sensornoise
{

/** Whether the nearest neighbours together, or any of the \a coefficients in space, share more than a trifle. What
 * grows with the light is looked for where it is bright. */
SensorNoise_EXPORT bool
SharesInSpace(const CorrelationSums & sums, const std::vector<LagCoefficient> & coefficients);

/** Sums what neighbours share over all lags within reach, which grows until the next ring adds little, or nothing that
 * is seen; finds how it depends on the light, and the kind that it tells, unless frames share, too. */
SensorNoise_EXPORT void
SumOverSpace(CorrelationSums & sums, NoiseCorrelation & found);

} // namespace sensornoise

#endif
