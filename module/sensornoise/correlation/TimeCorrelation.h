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
#ifndef sensornoise_correlation_TimeCorrelation_h
#define sensornoise_correlation_TimeCorrelation_h

#include "SensorNoiseExport.h"
#include "sensornoise/correlation/CorrelationSums.h"
#include "sensornoise/correlation/NoiseCorrelation.h"

namespace sensornoise
{

/** Whether frames share noise by any of the \a coefficients in time, as a filter shares it: in proportion to the
 * variance. A drift of the offsets is shared, too, and does not grow with the light. */
SensorNoise_EXPORT bool
SharesInTime(const CorrelationSums & sums, const std::vector<LagCoefficient> & coefficients);

/** Sums what frames share over the lags within reach, which grows until the last two share little. More lags than
 * needed are worse: the projection of a short burst leaves little that tells them apart. */
SensorNoise_EXPORT void
SumOverTime(CorrelationSums & sums, NoiseCorrelation & found);

} // namespace sensornoise

#endif
