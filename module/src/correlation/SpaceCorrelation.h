// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_SpaceCorrelation_h
#define sensornoise_correlation_SpaceCorrelation_h

#include "SensorNoiseExport.h"
#include "correlation/CorrelationSums.h"
#include "correlation/NoiseCorrelation.h"

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
