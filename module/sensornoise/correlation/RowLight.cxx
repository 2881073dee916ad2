// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/correlation/RowLight.h"

#include "sensornoise/base/WideVectors.h"
#include "sensornoise/correlation/Constants.h"
#include "sensornoise/correlation/Jackknife.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sensornoise
{

namespace
{
/** Parts of a row of a tile; those that are not neighbours share no noise of neighbours. */
constexpr std::size_t PartsOfRow = 4;

/** Products of sums over two parts of a row, with y a residual, w = 1 / V, and z the light. */
struct RowProducts
{
  double noise{ 0.0 };      ///< of w y: a covariance that does not depend on the light ...
  double constant{ 0.0 };   ///< ... times this
  double mixed{ 0.0 };      ///< of w z: what each makes of the other
  double lightNoise{ 0.0 }; ///< of w z y: a covariance in proportion to the lights' product ...
  double square{ 0.0 };     ///< ... times this

  RowProducts &
  operator+=(const RowProducts & other)
  {
    noise += other.noise;
    constant += other.constant;
    mixed += other.mixed;
    lightNoise += other.lightNoise;
    square += other.square;
    return *this;
  }

  /** The part in proportion to the lights' product. */
  double
  OfLight() const
  {
    const double determinant = constant * square - mixed * mixed;
    return determinant > InCorrelation.leastSpread * constant * square
             ? (constant * lightNoise - mixed * noise) / determinant
             : std::numeric_limits<double>::quiet_NaN();
  }
};

using Parts = std::array<double, PartsOfRow>;

/** Of all pairs of parts that are no neighbours. */
double
ProductOfParts(const Parts & sums)
{
  return sums[0] * (sums[2] + sums[3]) + sums[1] * sums[3];
}

template <typename TFunction>
Parts
SumParts(std::size_t length, TFunction valueOf)
{
  Parts sums{};
  for (std::size_t s = 0; s < PartsOfRow; ++s)
  {
    for (std::size_t x = s * length; x < (s + 1) * length; ++x)
    {
      sums[s] += valueOf(x);
    }
  }
  return sums;
}

RowProducts
ProductsOfTile(const NoiseResiduals & residuals, std::size_t tile)
{
  const std::size_t side = residuals.GetTiles().side;
  const std::size_t frames = residuals.GetTiles().frames;
  const std::size_t length = side / PartsOfRow;
  RowProducts       products;
  for (std::size_t y = 0; y < side; ++y)
  {
    const float * const w = residuals.WeightOf(tile) + y * side;
    const float * const z = residuals.LightOf(tile) + y * side;
    products.constant += ProductOfParts(SumParts(length, [=](std::size_t x) { return w[x]; }));
    products.mixed += ProductOfParts(SumParts(length, [=](std::size_t x) { return w[x] * z[x]; }));
    products.square +=
      ProductOfParts(SumParts(length, [=](std::size_t x) { return static_cast<double>(w[x]) * z[x] * z[x]; }));
    for (std::size_t t = 0; t < frames; ++t)
    {
      const float * const values = residuals.OfTile(tile) + (t * side + y) * side;
      const auto          noise = SumParts(length, [=](std::size_t x) { return w[x] * values[x]; });
      const auto          light = SumParts(length, [=](std::size_t x) { return w[x] * z[x] * values[x]; });
      products.noise += ProductOfParts(noise) / residuals.GetFreedom();
      products.lightNoise += ProductOfParts(light) / residuals.GetFreedom();
    }
  }
  return products;
}
} // namespace

MeasuredNumber
FindRowLight(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  // Every n-th tile: the tiles are all over the frame, and some tell enough.
  const std::size_t        tiles = residuals.GetTiles().origins.size();
  const std::size_t        step = (tiles + InCorrelation.mostTilesOfRowLight - 1) / InCorrelation.mostTilesOfRowLight;
  std::vector<RowProducts> products((tiles + step - 1) / step);
  parallelFor(products.size(),
              [&](std::size_t i) { WithWideVectors([&] { products[i] = ProductsOfTile(residuals, i * step); }); });
  const JackknifeEstimate estimate =
    Jackknife(products, [](const RowProducts & sum) { return Eigen::VectorXd::Constant(1, sum.OfLight()); });
  const MeasuredNumber square{ estimate.value(0), estimate.StandardError(0) };
  return std::isfinite(square.value) && std::isfinite(square.standardError)
           ? square
           : MeasuredNumber{ 0.0, std::numeric_limits<double>::infinity() };
}

} // namespace sensornoise
