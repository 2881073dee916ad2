// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/BlockPhases.h"

#include "base/Eigen.h"
#include "base/Significance.h"
#include "correlation/Jackknife.h"
#include "correlation/LagSums.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

namespace
{
/** Returns the correlation coefficient of each phase, less the mean of the coefficients along the same axis. */
Eigen::VectorXd
Differences(const BlockPhases & sums)
{
  constexpr auto  period = static_cast<Eigen::Index>(BlockPhases::Period);
  Eigen::VectorXd coefficients(2 * period);
  for (Eigen::Index k = 0; k < coefficients.size(); ++k)
  {
    const double pairs = sums.pairs[static_cast<std::size_t>(k)];
    coefficients(k) = pairs > 0.0 ? sums.covariance[static_cast<std::size_t>(k)] / pairs : 0.0;
  }
  coefficients.head(period).array() -= coefficients.head(period).mean();
  coefficients.tail(period).array() -= coefficients.tail(period).mean();
  return coefficients;
}

/** Adds the pairs of neighbours along \a axis (0: columns, 1: rows) of a tile to \a sums. \a products are the products
 * of the tile's pixels with these neighbours, as returned by SumProducts(). */
void
AddAxis(const NoiseResiduals &     residuals,
        std::size_t                tile,
        std::size_t                axis,
        const std::vector<float> & products,
        BlockPhases &              sums)
{
  const SampleTiles &         tiles = residuals.GetTiles();
  const std::size_t           size = tiles.Pixels();
  const std::size_t           shift = axis == 0 ? 1 : tiles.side;
  const float *               weight = residuals.WeightOf(tile);
  const SampleTiles::Origin & origin = tiles.origins[tile];
  for (std::size_t p = 0; p + shift < size; ++p)
  {
    const std::size_t x = p % tiles.side;
    const double      w = static_cast<double>(weight[p]) * weight[p + shift];
    if (w > 0.0 && (axis == 1 || x + 1 < tiles.side))
    {
      const std::size_t at = axis == 0 ? origin.x + x : origin.y + p / tiles.side;
      const std::size_t k = axis * BlockPhases::Period + at % BlockPhases::Period;
      sums.covariance[k] += products[p] * std::sqrt(w) / residuals.GetDof();
      sums.pairs[k] += 1.0;
    }
  }
}
} // namespace

BlockPhases &
BlockPhases::operator+=(const BlockPhases & other)
{
  for (std::size_t k = 0; k < pairs.size(); ++k)
  {
    covariance[k] += other.covariance[k];
    pairs[k] += other.pairs[k];
  }
  return *this;
}

std::vector<BlockPhases>
SumBlockPhases(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  std::vector<BlockPhases> sums(residuals.GetTiles().origins.size());
  parallelFor(sums.size(), [&](std::size_t i) {
    const auto products = SumProducts(residuals, i, { Lag{ 1, 0, 0 }, Lag{ 0, 1, 0 } });
    AddAxis(residuals, i, 0, products[0], sums[i]);
    AddAxis(residuals, i, 1, products[1], sums[i]);
  });
  return sums;
}

double
RmsOfPhases(const std::vector<BlockPhases> & tiles)
{
  const JackknifeEstimate estimate = Jackknife(tiles, Differences);
  const Eigen::VectorXd   variances = estimate.covariance.diagonal();
  const double chance = variances.sum() + Significance.severalTests * std::sqrt(2.0 * variances.squaredNorm());
  return std::sqrt(std::max(0.0, estimate.value.squaredNorm() - chance) / static_cast<double>(estimate.value.size()));
}

} // namespace sensornoise
