// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/CorrelationSums.h"

#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/Jackknife.h"
#include "base/Quantiles.h"
#include "correlation/Constants.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sensornoise
{

namespace
{
/** Returns the lags from 2 to half of a tile along \a unit, and one more: those before the first and after the last
 * possible echo are for comparison. */
std::vector<Lag>
LagsAlong(const Lag & unit, std::size_t side)
{
  std::vector<Lag> lags;
  for (int k = 2; k <= static_cast<int>(side) / 2 + 1; ++k)
  {
    lags.push_back({ k * unit.x, k * unit.y, 0 });
  }
  return lags;
}

/** Returns the sums at \a lags of every n-th tile. */
std::vector<TileSums>
SumFewTiles(const NoiseResiduals &        residuals,
            const std::vector<TileSums> & tiles,
            const std::vector<Lag> &      lags,
            const ParallelFor &           parallelFor)
{
  const std::size_t     step = (tiles.size() + InCorrelation.tilesOfFirstLook - 1) / InCorrelation.tilesOfFirstLook;
  std::vector<TileSums> few((tiles.size() + step - 1) / step);
  const LagSummation    summation(residuals, lags);
  parallelFor(few.size(), [&](std::size_t i) {
    few[i].shared = tiles[i * step].shared;
    few[i].lags = summation.OfTile(i * step);
  });
  return few;
}

/** Returns the correlation coefficients of the lags, without the noise that is common to all pixels [1]. */
Eigen::VectorXd
CoefficientsOf(const TileSums & sums, const CommonNoise & common, const std::vector<Lag> & lags)
{
  Eigen::VectorXd found = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(lags.size()));
  for (std::size_t k = 0; k < lags.size(); ++k)
  {
    const PairSums total = common.Subtract(sums.lags[k], lags[k]).Total();
    found(static_cast<Eigen::Index>(k)) = total.pairs > 0.0 ? total.covariance / total.pairs : 0.0;
  }
  return found;
}
} // namespace

std::vector<Lag>
FindEchoes(const NoiseResiduals &        residuals,
           const std::vector<TileSums> & tiles,
           const Lag &                   unit,
           const ParallelFor &           parallelFor)
{
  const std::vector<Lag>      lags = LagsAlong(unit, residuals.GetTiles().side);
  const std::vector<TileSums> few = SumFewTiles(residuals, tiles, lags, parallelFor);
  const JackknifeEstimate     all =
    Jackknife(few, [&](const TileSums & sums) { return CoefficientsOf(sums, FindCommonNoise(sums.shared), lags); });
  TileSums total;
  for (const TileSums & own : few)
  {
    total += own;
  }
  const CommonNoise            common = FindCommonNoise(total.shared);
  std::vector<Eigen::VectorXd> ofTiles;
  std::transform(few.begin(), few.end(), std::back_inserter(ofTiles), [&](const TileSums & own) {
    return CoefficientsOf(own, common, lags);
  });
  std::vector<Lag> echoes;
  for (Eigen::Index k = 1; k + 1 < all.value.size(); ++k)
  {
    const MeasuredNumber own{ all.value(k), all.StandardError(k) };
    const double         beside = std::max(std::abs(all.value(k - 1)), std::abs(all.value(k + 1)));
    if (!own.Exceeds(InCorrelation.leastCoefficient, Significance.manyTests) || beside > 0.5 * std::abs(own.value))
    {
      continue;
    }
    std::vector<double> relative; // to the mean of all tiles: an echo is everywhere, motion and light are in places
    std::transform(ofTiles.begin(), ofTiles.end(), std::back_inserter(relative), [&](const Eigen::VectorXd & ofTile) {
      return ofTile(k) / own.value;
    });
    if (Quantile(relative, 0.5) > InCorrelation.leastTypical)
    {
      echoes.push_back(lags[static_cast<std::size_t>(k)]);
    }
  }
  return echoes;
}

} // namespace sensornoise
