// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_TimeCorrelation_h
#define sensornoise_correlation_TimeCorrelation_h

#include "SensorNoiseExport.h"
#include "correlation/CorrelationSums.h"
#include "correlation/NoiseCorrelation.h"

namespace sensornoise
{

/** Whether frames share noise, by any of the \a coefficients in time. */
SensorNoise_EXPORT bool
SharesInTime(const std::vector<LagCoefficient> & coefficients);

/** Sums what frames share over the lags within reach, which grows until the last two share little. More lags than
 * needed are worse: the projection of a short burst leaves little that tells them apart. */
SensorNoise_EXPORT void
SumOverTime(CorrelationSums & sums, NoiseCorrelation & found);

} // namespace sensornoise

#endif
