// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/correlation/NoiseKurtosis.h"

#include "sensornoise/correlation/Constants.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
/** Pixels that are added with alternating signs: \a x by \a y of them. */
struct Alternation
{
  std::size_t x;
  std::size_t y;
};
constexpr std::array<Alternation, KurtosisSums::Kinds> Alternations{
  { { 1, 1 }, { 2, 1 }, { 1, 2 }, { 2, 2 }, { 8, 1 }, { 1, 8 } }
};

/** Adds the alternating sum of one frame of a tile, for every pixel at which one begins. */
void
Alternate(const float * values, std::size_t side, const Alternation & of, std::vector<float> & sums)
{
  std::fill(sums.begin(), sums.end(), 0.0F);
  const std::size_t last = side * side - (of.y - 1) * side - (of.x - 1);
  for (std::size_t y = 0; y < of.y; ++y)
  {
    for (std::size_t x = 0; x < of.x; ++x)
    {
      const float   sign = (x + y) % 2 == 0 ? 1.0F : -1.0F;
      const float * there = values + y * side + x;
      for (std::size_t p = 0; p < last; ++p)
      {
        sums[p] += sign * there[p];
      }
    }
  }
}

bool
AllAreTaken(const float * weight, std::size_t side, const Alternation & of, std::size_t p)
{
  if (p % side + of.x > side || p / side + of.y > side)
  {
    return false;
  }
  for (std::size_t k = 0; k < of.x * of.y; ++k)
  {
    if (!(weight[p + k / of.x * side + k % of.x] > 0.0F))
    {
      return false;
    }
  }
  return true;
}
} // namespace

KurtosisSums &
KurtosisSums::operator+=(const KurtosisSums & other)
{
  for (std::size_t k = 0; k < Kinds; ++k)
  {
    series[k] += other.series[k];
    ratio[k] += other.ratio[k];
  }
  return *this;
}

std::vector<KurtosisSums>
SumKurtosis(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  const SampleTiles &       tiles = residuals.GetTiles();
  const std::size_t         size = tiles.Pixels();
  const double              freedom = residuals.GetFreedom();
  const Eigen::ArrayXd      kept = 1.0 - residuals.GetBasis().array().square().rowwise().sum();
  const double              normal = 3.0 * kept.square().sum() / (freedom * (freedom + 2.0));
  std::vector<KurtosisSums> sums(tiles.origins.size());
  parallelFor(sums.size(), [&](std::size_t i) {
    std::vector<float> values(size);
    std::vector<float> squares(size);
    std::vector<float> fourths(size);
    for (std::size_t k = 0; k < KurtosisSums::Kinds; ++k)
    {
      std::fill(squares.begin(), squares.end(), 0.0F);
      std::fill(fourths.begin(), fourths.end(), 0.0F);
      for (std::size_t t = 0; t < tiles.frames; ++t)
      {
        Alternate(residuals.OfTile(i) + t * size, tiles.side, Alternations[k], values);
        for (std::size_t p = 0; p < size; ++p)
        {
          const float square = values[p] * values[p];
          squares[p] += square;
          fourths[p] += square * square;
        }
      }
      for (std::size_t p = 0; p < size; ++p)
      {
        // Of pixels that are copies of each other nothing is left but rounding.
        const bool isNoise =
          squares[p] * residuals.WeightOf(i)[p] > InCorrelation.leastNoise * static_cast<float>(freedom);
        if (isNoise && AllAreTaken(residuals.WeightOf(i), tiles.side, Alternations[k], p))
        {
          const double square = squares[p];
          sums[i].series[k] += 1.0;
          sums[i].ratio[k] += fourths[p] / (square * square) / normal;
        }
      }
    }
  });
  return sums;
}

} // namespace sensornoise
