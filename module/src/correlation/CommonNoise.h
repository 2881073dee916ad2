// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_CommonNoise_h
#define sensornoise_correlation_CommonNoise_h

#include "SensorNoiseExport.h"
#include "correlation/LagSums.h"
#include "correlation/DistantCovariance.h"

#include <array>

namespace sensornoise
{

/** Noise covariance that does not decrease with the distance of two pixels. It is subtracted before the covariance of
 * neighbours is evaluated. */
struct CommonNoise
{
  double light{ 0.0 };                                 ///< residual illumination: the coefficient of the squared signal
                                                       ///< [1]
  std::array<double, DistantCovariance::Lines> rows{}; ///< covariance of pixels this many rows apart, and far apart
                                                       ///< along the rows [DN^2]
  std::array<double, DistantCovariance::Lines> columns{}; ///< covariance of pixels this many columns apart, and far
                                                          ///< apart along the columns [DN^2]

  /** Returns \a sums, the sums of the spatial lag \a lag, without the common covariance. */
  SensorNoise_EXPORT LagSums
  TakeOff(LagSums sums, const Lag & lag) const;
};

/** Estimates the common noise from the sums over tiles. */
SensorNoise_EXPORT CommonNoise
FindCommonNoise(const DistantCovariance & sums);

} // namespace sensornoise

#endif
