// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_LagSums_h
#define sensornoise_correlation_LagSums_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "correlation/NoiseResiduals.h"

#include <array>
#include <cstddef>
#include <vector>

/** \file
 * Sums of the noise covariance of pixels that are near to each other, by lag, and of pixels far apart. */

namespace sensornoise
{

/** Distance of two values: \a x and \a y [pixels], \a t [frames]. */
struct Lag
{
  int x{ 0 };
  int y{ 0 };
  int t{ 0 };
};

/** Sums over pairs of pixels, where y is the noise covariance of a pair, V its typical variance, and z its signal. */
struct PairSums
{
  double pairs{ 0.0 };      ///< sum of the weights of the pairs by their position in the tile [1]
  double covariance{ 0.0 }; ///< sum of y / V [1]
  double constant{ 0.0 };   ///< sum of 1 / V [1/DN^2]
  double signal{ 0.0 };     ///< sum of z / V [1/DN]
  double square{ 0.0 };     ///< sum of z^2 / V [1]

  PairSums &
  operator+=(const PairSums & other);
};

/** Sums of one lag in each intensity bin. */
struct SensorNoise_EXPORT LagSums
{
  std::array<PairSums, NoiseResiduals::IntensityBins> bins;

  LagSums &
  operator+=(const LagSums & other);
  /** Returns the sums over all bins. */
  PairSums
  Total() const;
};

/** Returns the products of the residuals of tile \a tile with the residuals at each of \a lags, summed over time, for
 * each pixel of the tile: [lag][pixel]. Where a lag leads beyond the end of a row of the tile, the product has no
 * meaning. */
SensorNoise_EXPORT std::vector<std::vector<float>>
SumProducts(const NoiseResiduals & residuals, std::size_t tile, const std::vector<Lag> & lags);

/** Does the same for a tile of two samples: the products of the values \a own with the values of \a other, which lie
 * \a shift values behind them. Both begin with the first frame of the tile. */
std::vector<float>
SumProducts(const float * own, const float * other, const SampleTiles & tiles, std::ptrdiff_t shift);

/** \class LagSummation
 * \brief Computes the sums of a tile for each lag, where y is sum_t r_t(p) r_(t + lag.t)(q) over the degrees of
 * freedom.
 *
 * The residuals must outlive the object. */
class SensorNoise_EXPORT LagSummation
{
public:
  LagSummation(const NoiseResiduals & residuals, std::vector<Lag> lags);

  /** Returns the sums of a tile, in the order of the lags. */
  std::vector<LagSums>
  OfTile(std::size_t tile) const;

private:
  /** Weights of pairs by their position in the tile. */
  struct PlaceWeights
  {
    std::vector<double> columns;
    std::vector<double> rows;
  };

  const NoiseResiduals &    m_Residuals;
  std::vector<Lag>          m_Lags;
  std::vector<PlaceWeights> m_Weights; // weights for each lag
};

/** Returns the sums of every tile for each lag: [tile][lag]. */
SensorNoise_EXPORT std::vector<std::vector<LagSums>>
SumLags(const NoiseResiduals & residuals, const std::vector<Lag> & lags, const ParallelFor & parallelFor);

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
struct SensorNoise_EXPORT DistantCovariance
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

  /** Returns the covariance that line noise causes between pixels at the distance \a lag [DN^2]. */
  SensorNoise_EXPORT double
  OfLines(const Lag & lag) const;
  /** Returns \a sums, the sums of the spatial lag \a lag, without the common covariance. */
  SensorNoise_EXPORT LagSums
  Subtract(LagSums sums, const Lag & lag) const;
};

/** Estimates the common noise from the sums over tiles. */
SensorNoise_EXPORT CommonNoise
FindCommonNoise(const DistantCovariance & sums);

} // namespace sensornoise

#endif
