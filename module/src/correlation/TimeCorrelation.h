// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_TimeCorrelation_h
#define sensornoise_correlation_TimeCorrelation_h

#include "SensorNoiseExport.h"
#include "correlation/CorrelationSums.h"
#include "correlation/NoiseCorrelation.h"

namespace sensornoise
{

/** Returns whether one of the temporal \a coefficients significantly exceeds InCorrelation.leastTimeCoefficient. */
SensorNoise_EXPORT bool
IsCorrelatedInTime(const std::vector<LagCoefficient> & coefficients);

/** Sums the noise covariance over temporal lags, until the last two are small, and sets the noise class to Temporal.
 * More lags than needed increase the error: after the projection of a short burst, distant lags are hardly
 * distinguishable. */
SensorNoise_EXPORT void
SumOverTime(CorrelationSums & sums, NoiseCorrelation & found);

} // namespace sensornoise

#endif
