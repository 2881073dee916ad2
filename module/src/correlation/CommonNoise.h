// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_CommonNoise_h
#define sensornoise_correlation_CommonNoise_h

#include "SensorNoiseExport.h"
#include "correlation/NoiseResiduals.h"
#include "correlation/LagSums.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Sums over pairs of pixels that are at least a quarter of a tile apart: the products of their weights w = 1 / V,
 * signals z and covariance y. A prime marks the second pixel. */
struct DistantSums
{
  double covariance{ 0.0 };       ///< sum of w w' y
  double constant{ 0.0 };         ///< sum of w w'
  double signal{ 0.0 };           ///< sum of w z w' z'
  double signalCovariance{ 0.0 }; ///< sum of w z w' z' y
  double signalSquare{ 0.0 };     ///< sum of w z^2 w' z'^2

  DistantSums &
  operator+=(const DistantSums & other);
};

/** \struct DistantCovariance
 * \brief Noise covariance of pixels far apart in a tile: noise of whole rows and columns, and illumination that the
 * temporal components left.
 *
 * Neither decreases with the distance, as the covariance of neighbours does. The noise of rows and columns does not
 * depend on the signal. The covariance by residual illumination grows with the squared signal. */
struct DistantCovariance
{
  /** Number of distances between rows, or between columns, at which the covariance of lines is evaluated, from 0
   * [pixels]. */
  static constexpr std::size_t Lines = 7;

  std::array<DistantSums, Lines> rows;    ///< pixels this many rows apart, and far apart along the rows
  std::array<DistantSums, Lines> columns; ///< pixels this many columns apart, and far apart along the columns
  DistantSums                    far;     ///< pixels far apart along both axes

  DistantCovariance &
  operator+=(const DistantCovariance & other);
};

/** Returns the sums of tile \a i. */
SensorNoise_EXPORT DistantCovariance
SumDistantCovariance(const NoiseResiduals & residuals, std::size_t i);

/** Noise covariance that does not decrease with the distance of two pixels. It is subtracted before the covariance of
 * neighbours is evaluated. */
struct CommonNoise
{
  double illumination{ 0.0 };                          ///< residual illumination: the coefficient of the squared signal
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
