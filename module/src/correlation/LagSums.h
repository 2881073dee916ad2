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

namespace sensornoise
{

/** How far two values are apart, [pixels] and [frames]. */
struct Lag
{
  int x{ 0 };
  int y{ 0 };
  int t{ 0 };
};

/** Sums over pairs of pixels: of their covariance y, with V their typical variance and z their light. */
struct PairSums
{
  double pairs{ 0.0 };
  double covariance{ 0.0 }; ///< of y / V
  double constant{ 0.0 };   ///< of 1 / V
  double light{ 0.0 };      ///< of z / V
  double square{ 0.0 };     ///< of z^2 / V

  PairSums &
  operator+=(const PairSums & other);
};

/** The sums of one lag, in the bins of the light. */
struct LagSums
{
  std::array<PairSums, NoiseResiduals::LightBins> bins;

  LagSums &
  operator+=(const LagSums & other);
  /** Over all bins. */
  PairSums
  Total() const;
};

/** Sums over time of the products of the residuals of tile \a tile with those one of the \a lags away, of the pixels of
 * the tile: [lag][pixel]. Where the other pixel is in another row, the product has no meaning. */
SensorNoise_EXPORT std::vector<std::vector<float>>
SumProducts(const NoiseResiduals & residuals, std::size_t tile, const std::vector<Lag> & lags);

/** \class LagSummation
 * \brief Makes the sums of a tile, for each lag. y is sum_t r_t(p) r_(t + lag.t)(q), over the freedom.
 *
 * The residuals must outlive the object. */
class SensorNoise_EXPORT LagSummation
{
public:
  LagSummation(const NoiseResiduals & residuals, std::vector<Lag> lags);

  std::vector<LagSums>
  OfTile(std::size_t tile) const;

private:
  /** What pairs count by their place in the tile. */
  struct PlaceWeights
  {
    std::vector<double> columns;
    std::vector<double> rows;
  };

  const NoiseResiduals &    m_Residuals;
  std::vector<Lag>          m_Lags;
  std::vector<PlaceWeights> m_Weights; // of each lag
};

/** The sums of every tile, for each lag: [tile][lag]. */
SensorNoise_EXPORT std::vector<std::vector<LagSums>>
SumLags(const NoiseResiduals & residuals, const std::vector<Lag> & lags, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
