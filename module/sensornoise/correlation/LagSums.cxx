// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/correlation/LagSums.h"

#include "sensornoise/base/WideVectors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Weights of \a count places in a row that fall off at both ends, so that places two, three or four apart sum up
 * alike wherever one begins: noise of binned or doubled pixels has such a period. */
std::vector<double>
PeriodlessWeights(std::size_t count)
{
  std::vector<double> weights{ 1.0 };
  const auto          blur = [&weights](std::size_t length) {
    std::vector<double> wider(weights.size() + length - 1, 0.0);
    for (std::size_t k = 0; k < weights.size() * length; ++k)
    {
      wider[k / length + k % length] += weights[k / length] / static_cast<double>(length);
    }
    weights = std::move(wider);
  };
  for (const std::size_t period : { 2U, 3U, 4U })
  {
    if (weights.size() + period <= count)
    {
      blur(period);
    }
  }
  blur(count + 1 - weights.size());
  const double top = *std::max_element(weights.begin(), weights.end());
  std::transform(weights.begin(), weights.end(), weights.begin(), [top](double weight) { return weight / top; });
  return weights;
}

LagSums
SumPairs(const NoiseResiduals & residuals, std::size_t tile, const Lag & lag, const std::vector<float> & products)
{
  const auto           side = static_cast<int>(residuals.GetTiles().side);
  const float *        light = residuals.LightOf(tile);
  const float *        weight = residuals.WeightOf(tile);
  const std::uint8_t * bin = residuals.BinOf(tile);
  const double         inverseFreedom = 1.0 / residuals.GetFreedom();
  const auto           ofColumns = PeriodlessWeights(static_cast<std::size_t>(side - std::abs(lag.x)));
  const auto           ofRows = PeriodlessWeights(static_cast<std::size_t>(side - std::abs(lag.y)));
  const int            firstX = std::max(0, -lag.x);
  const int            firstY = std::max(0, -lag.y);
  LagSums              sums;
  for (int y = firstY; y < side - std::max(0, lag.y); ++y)
  {
    for (int x = firstX; x < side - std::max(0, lag.x); ++x)
    {
      const double share =
        ofRows[static_cast<std::size_t>(y - firstY)] * ofColumns[static_cast<std::size_t>(x - firstX)];
      const int    p = y * side + x;
      const int    q = p + lag.y * side + lag.x;
      const double w = static_cast<double>(weight[p]) * weight[q];
      if (w > 0.0)
      {
        const double inverse = share * std::sqrt(w);
        const double z = 0.5 * (static_cast<double>(light[p]) + light[q]);
        PairSums &   sum = sums.bins[bin[p]];
        sum.pairs += share;
        sum.covariance += inverseFreedom * products[static_cast<std::size_t>(p)] * inverse;
        sum.constant += inverse;
        sum.light += z * inverse;
        sum.square += z * z * inverse;
      }
    }
  }
  return sums;
}
} // namespace

void
SumProducts(const NoiseResiduals & residuals, std::size_t tile, const Lag & lag, std::vector<float> & products)
{
  const SampleTiles &  tiles = residuals.GetTiles();
  const std::size_t    size = tiles.Pixels();
  const float *        values = residuals.OfTile(tile);
  const auto           later = static_cast<std::size_t>(lag.t);
  const std::ptrdiff_t shift = static_cast<std::ptrdiff_t>(lag.y) * static_cast<std::ptrdiff_t>(tiles.side) + lag.x;
  const std::size_t    first = shift < 0 ? static_cast<std::size_t>(-shift) : 0;
  const std::size_t    last = shift < 0 ? size : size - static_cast<std::size_t>(shift);
  products.assign(size, 0.0F);
  const auto add = [&](std::size_t t, auto together) {
    const float * here = values + t * size;
    const float * there = values + (t + later) * size + shift;
    for (std::size_t p = first; p < last; ++p)
    {
      float sum = products[p];
      for (std::size_t k = 0; k < together; ++k)
      {
        sum += here[p + k * size] * there[p + k * size];
      }
      products[p] = sum;
    }
  };
  using Four = std::integral_constant<std::size_t, 4>;
  using One = std::integral_constant<std::size_t, 1>;
  const std::size_t frames = tiles.frames > later ? tiles.frames - later : 0;
  WithWideVectors([&] {
    std::size_t t = 0;
    for (; t + Four::value <= frames; t += Four::value) // in order; the sums are loaded and stored a quarter as often
    {
      add(t, Four());
    }
    for (; t < frames; ++t)
    {
      add(t, One());
    }
  });
}

PairSums &
PairSums::operator+=(const PairSums & other)
{
  pairs += other.pairs;
  covariance += other.covariance;
  constant += other.constant;
  light += other.light;
  square += other.square;
  return *this;
}

LagSums &
LagSums::operator+=(const LagSums & other)
{
  for (std::size_t b = 0; b < bins.size(); ++b)
  {
    bins[b] += other.bins[b];
  }
  return *this;
}

PairSums
LagSums::Total() const
{
  PairSums total;
  for (const PairSums & bin : bins)
  {
    total += bin;
  }
  return total;
}

std::vector<std::vector<LagSums>>
SumLags(const NoiseResiduals & residuals, const std::vector<Lag> & lags, const ParallelFor & parallelFor)
{
  const SampleTiles &               tiles = residuals.GetTiles();
  std::vector<std::vector<LagSums>> sums(tiles.origins.size(), std::vector<LagSums>(lags.size()));
  parallelFor(tiles.origins.size(), [&](std::size_t i) {
    std::vector<float> products;
    for (std::size_t k = 0; k < lags.size(); ++k)
    {
      SumProducts(residuals, i, lags[k], products);
      sums[i][k] = SumPairs(residuals, i, lags[k], products);
    }
  });
  return sums;
}

} // namespace sensornoise
