// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_TemporalMixing_h
#define sensornoise_correlation_TemporalMixing_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"

#include <cstddef>

namespace sensornoise
{

/** Returns the matrix M by which the projection mixes the autocovariances R_k of a series. With P = I - Q Q', for
 * orthonormal \a basis Q,
 *
 *     E[sum_t r_t r_(t+d)] = sum_k M_dk R_k,   M_dk = sum_t (P B_k P)_(t, t+d),   d, k = 0 ... lags,
 *
 * where B_0 = I and B_k is the shift by k frames both ways. Exact for any distribution of the noise. */
SensorNoise_EXPORT Eigen::MatrixXd
TemporalMixing(const Eigen::MatrixXd & basis, std::size_t lags);

} // namespace sensornoise

#endif
