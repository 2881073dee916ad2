// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_TotalCovariance_h
#define sensornoise_correlation_TotalCovariance_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/CorrelationSums.h"
#include "correlation/NoiseCorrelation.h"

#include <cstddef>

namespace sensornoise
{

/** Returns whether the spatial noise correlation exceeds the reporting threshold: the nearest neighbours together
 * exceed InCorrelation.leastEffect, or one of \a coefficients exceeds InCorrelation.leastCoefficient, both
 * significantly. Covariances that grow with the signal are tested in the brightest bin. */
SensorNoise_EXPORT bool
IsCorrelatedInSpace(const CorrelationSums & sums, const std::vector<LagCoefficient> & coefficients);

/** Sums the noise covariance over all spatial lags within reach. The reach grows until the next ring is small or not
 * significant. Fits the dependence on the signal, and sets the noise class unless it is Temporal. */
SensorNoise_EXPORT void
SumOverSpace(CorrelationSums & sums, NoiseCorrelation & found);

/** Returns whether one of the temporal \a coefficients, or the coefficient of neighbouring frames in the brightest bin,
 * significantly exceeds InCorrelation.leastTimeCoefficient. Image lag is proportional to the signal. */
SensorNoise_EXPORT bool
IsCorrelatedInTime(const CorrelationSums & sums, const std::vector<LagCoefficient> & coefficients);

/** Sums the noise covariance over temporal lags, until the last two are small, and continues it beyond them where it
 * decreases as behind a recursive filter. Fits the dependence on the signal, and sets the noise class to Temporal. More
 * lags than needed increase the error: after the projection of a short burst, distant lags are hardly distinguishable.
 */
SensorNoise_EXPORT void
SumOverTime(CorrelationSums & sums, NoiseCorrelation & found);

} // namespace sensornoise

#endif
