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

/** Fits the covariance at the zero lag, and then at each of \a lags, by a line through the four intensity bins: slope
 * times level + intercept. Filtered noise has linear covariances, whichever part of the read noise was filtered. */
SensorNoise_EXPORT std::vector<CovarianceLine>
FitCovarianceLines(const CorrelationSums & sums, const CorrelationSums::Lags & lags);

} // namespace sensornoise

#endif
