// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/LocalMotion.h"

#include "base/Eigen.h"
#include "correlation/Jackknife.h"
#include "correlation/LagSums.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
/** Sums of a regression over pairs of neighbours: y is their noise covariance, x the product of their slopes, both
 * relative to the variance. */
struct SlopeSums
{
  double xx{ 0.0 }; ///< of x, less its mean for a lag in a tile
  double xy{ 0.0 };
  double pixels{ 0.0 };
  double roughness{ 0.0 }; ///< squared slope over the variance

  SlopeSums &
  operator+=(const SlopeSums & other)
  {
    xx += other.xx;
    xy += other.xy;
    pixels += other.pixels;
    roughness += other.roughness;
    return *this;
  }
};

/** Returns the slopes of the signal along x and y at the inner pixels of a tile, over the standard deviation of the
 * noise; 0 at the other pixels. */
Eigen::ArrayX2d
SlopesOf(const NoiseResiduals & residuals, std::size_t tile)
{
  const std::size_t   side = residuals.GetTiles().side;
  const float * const light = residuals.LightOf(tile);
  const float * const weight = residuals.WeightOf(tile);
  Eigen::ArrayX2d     slopes = Eigen::ArrayX2d::Zero(static_cast<Eigen::Index>(side * side), 2);
  for (std::size_t y = 1; y + 1 < side; ++y)
  {
    for (std::size_t x = 1; x + 1 < side; ++x)
    {
      const std::size_t p = y * side + x;
      const double      root = std::sqrt(static_cast<double>(weight[p]));
      slopes.row(static_cast<Eigen::Index>(p)) << 0.5 * root * (static_cast<double>(light[p + 1]) - light[p - 1]),
        0.5 * root * (static_cast<double>(light[p + side]) - light[p - side]);
    }
  }
  return slopes;
}

SlopeSums
SumsOf(const NoiseResiduals & residuals, std::size_t tile)
{
  const std::vector<Lag> lags{ { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
  const auto             products = SumProducts(residuals, tile, lags);
  const Eigen::ArrayX2d  slopes = SlopesOf(residuals, tile);
  const float * const    weight = residuals.WeightOf(tile);
  const std::size_t      side = residuals.GetTiles().side;
  const double           inverseDof = 1.0 / residuals.GetDof();
  SlopeSums              sums;
  sums.roughness = slopes.square().sum();
  sums.pixels = static_cast<double>((slopes.square().rowwise().sum() > 0.0).count());
  for (std::size_t k = 0; k < lags.size(); ++k)
  {
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t row = 1; row + 2 < side; ++row)
    {
      for (std::size_t column = 2; column + 2 < side; ++column)
      {
        const std::size_t p = row * side + column;
        const std::size_t q = p + static_cast<std::size_t>(lags[k].y) * side +
                              static_cast<std::size_t>(static_cast<std::ptrdiff_t>(lags[k].x));
        const double root = std::sqrt(static_cast<double>(weight[p]) * weight[q]);
        if (root > 0.0)
        {
          x.push_back((slopes.row(static_cast<Eigen::Index>(p)) * slopes.row(static_cast<Eigen::Index>(q))).sum());
          y.push_back(inverseDof * static_cast<double>(products[k][p]) * root);
        }
      }
    }
    if (x.empty())
    {
      continue;
    }
    const auto                       count = static_cast<Eigen::Index>(x.size());
    Eigen::Map<const Eigen::ArrayXd> ofX(x.data(), count);
    const Eigen::VectorXd            own = ofX - ofX.mean();
    sums.xx += own.squaredNorm();
    sums.xy += own.dot(Eigen::Map<const Eigen::VectorXd>(y.data(), count));
  }
  return sums;
}
} // namespace

MeasuredNumber
FindLocalMotion(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  std::vector<SlopeSums> tiles(residuals.GetTiles().origins.size());
  parallelFor(tiles.size(), [&](std::size_t i) { tiles[i] = SumsOf(residuals, i); });
  const JackknifeEstimate estimate = Jackknife(tiles, [](const SlopeSums & all) {
    const bool isTold = all.xx > 0.0 && all.pixels > 0.0;
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, isTold ? all.xy / all.xx * all.roughness / all.pixels : 0.0));
  });
  return { estimate.value(0), estimate.StandardError(0) };
}

} // namespace sensornoise
