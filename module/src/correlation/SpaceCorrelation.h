// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_SpaceCorrelation_h
#define sensornoise_correlation_SpaceCorrelation_h

#include "SensorNoiseExport.h"
#include "correlation/CorrelationSums.h"
#include "correlation/NoiseCorrelation.h"

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

} // namespace sensornoise

#endif
