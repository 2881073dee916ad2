// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_CovarianceLines_h
#define sensornoise_correlation_CovarianceLines_h

#include "SensorNoiseExport.h"
#include "correlation/CorrelationSums.h"
#include "correlation/NoiseCorrelation.h"

#include <vector>

namespace sensornoise
{

/** The line through the covariance of each of \a lags, of the four bins of the light, and of the lag 0, which is first:
 * slope times level + intercept. Filters leave lines, whatever part of the read noise they share. */
SensorNoise_EXPORT std::vector<CovarianceLine>
FitCovarianceLines(const CorrelationSums & sums, const CorrelationSums::Lags & lags);

} // namespace sensornoise

#endif
