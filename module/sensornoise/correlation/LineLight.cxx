// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/correlation/LineLight.h"

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
/** Parts of a line of a tile; those that are not neighbours share no noise of neighbours. */
constexpr std::size_t PartsOfLine = 4;

/** Products of sums over two parts of a line, with y a residual, w = 1 / V, and z the light. */
struct LineLightProducts
{
  double noise{ 0.0 };      ///< of w y: a covariance that does not depend on the light ...
  double constant{ 0.0 };   ///< ... times this
  double mixed{ 0.0 };      ///< of w z: what each makes of the other
  double lightNoise{ 0.0 }; ///< of w z y: a covariance in proportion to the lights' product ...
  double square{ 0.0 };     ///< ... times this

  LineLightProducts &
  operator+=(const LineLightProducts & other)
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

using Parts = std::array<double, PartsOfLine>;

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
  for (std::size_t s = 0; s < PartsOfLine; ++s)
  {
    for (std::size_t x = s * length; x < (s + 1) * length; ++x)
    {
      sums[s] += valueOf(x);
    }
  }
  return sums;
}

LineLightProducts
ProductsOfTile(const NoiseResiduals & residuals, std::size_t tile, LineAxis axis)
{
  const SampleTiles & tiles = residuals.GetTiles();
  const std::size_t   length = tiles.side / PartsOfLine;
  const float * const w = residuals.WeightOf(tile);
  const float * const z = residuals.LightOf(tile);
  LineLightProducts   products;
  for (std::size_t line = 0; line < tiles.side; ++line)
  {
    const auto place = [=, &tiles](std::size_t k) { return tiles.InTile(axis, line, k); };
    products.constant += ProductOfParts(SumParts(length, [=](std::size_t k) { return w[place(k)]; }));
    products.mixed += ProductOfParts(SumParts(length, [=](std::size_t k) { return w[place(k)] * z[place(k)]; }));
    products.square += ProductOfParts(
      SumParts(length, [=](std::size_t k) { return static_cast<double>(w[place(k)]) * z[place(k)] * z[place(k)]; }));
    for (std::size_t t = 0; t < tiles.frames; ++t)
    {
      const float * const values = residuals.OfTile(tile) + t * tiles.Pixels();
      const auto          noise = SumParts(length, [=](std::size_t k) { return w[place(k)] * values[place(k)]; });
      const auto light = SumParts(length, [=](std::size_t k) { return w[place(k)] * z[place(k)] * values[place(k)]; });
      products.noise += ProductOfParts(noise) / residuals.GetFreedom();
      products.lightNoise += ProductOfParts(light) / residuals.GetFreedom();
    }
  }
  return products;
}
} // namespace

MeasuredNumber
FindLineLight(const NoiseResiduals & residuals, LineAxis axis, const ParallelFor & parallelFor)
{
  // Every n-th tile: the tiles are all over the frame, and some tell enough.
  const std::size_t tiles = residuals.GetTiles().origins.size();
  const std::size_t step = (tiles + InCorrelation.mostTilesOfLineLight - 1) / InCorrelation.mostTilesOfLineLight;
  std::vector<LineLightProducts> products((tiles + step - 1) / step);
  parallelFor(products.size(), [&](std::size_t i) {
    WithWideVectors([&] { products[i] = ProductsOfTile(residuals, i * step, axis); });
  });
  const JackknifeEstimate estimate =
    Jackknife(products, [](const LineLightProducts & sum) { return Eigen::VectorXd::Constant(1, sum.OfLight()); });
  const MeasuredNumber square{ estimate.value(0), estimate.StandardError(0) };
  return std::isfinite(square.value) && std::isfinite(square.standardError)
           ? square
           : MeasuredNumber{ 0.0, std::numeric_limits<double>::infinity() };
}

} // namespace sensornoise
