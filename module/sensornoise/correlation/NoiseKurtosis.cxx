// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/correlation/NoiseKurtosis.h"

#include "sensornoise/base/WideVectors.h"
#include "sensornoise/correlation/Constants.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
/** Of every pixel of a tile: sums over time of the squares and fourth powers of the alternating sum of the \a X by \a Y
 * pixels that begin there. Where these run over the end of a row they mean nothing. */
struct PowerSums
{
  using OfPixels = std::array<float, SampleTiles::Side * SampleTiles::Side>;
  OfPixels squares;
  OfPixels fourths;
};

template <std::size_t X, std::size_t Y>
PowerSums
SumPowers(const SampleTiles & tiles, const float * values)
{
  PowerSums         powers{};
  const std::size_t side = tiles.side;
  const std::size_t frames = tiles.frames;
  const std::size_t last = side * side - (Y - 1) * side - (X - 1);
  WithWideVectors([&powers, values, side, frames, last] {
    // No pointer can point into them: the loop over pixels becomes vector instructions.
    PowerSums::OfPixels squares{};
    PowerSums::OfPixels fourths{};
    for (std::size_t t = 0; t < frames; ++t)
    {
      const float * frame = values + t * side * side;
      for (std::size_t p = 0; p < last; ++p)
      {
        float sum = 0.0F;
        for (std::size_t y = 0; y < Y; ++y)
        {
          for (std::size_t x = 0; x < X; ++x)
          {
            const float value = frame[p + y * side + x];
            sum += (x + y) % 2 == 0 ? value : -value;
          }
        }
        const float square = sum * sum;
        squares[p] += square;
        fourths[p] += square * square;
      }
    }
    powers = { squares, fourths };
  });
  return powers;
}

template <std::size_t X, std::size_t Y>
bool
AllAreTaken(const float * weight, std::size_t side, std::size_t p)
{
  if (p % side + X > side || p / side + Y > side)
  {
    return false;
  }
  for (std::size_t k = 0; k < X * Y; ++k)
  {
    if (!(weight[p + k / X * side + k % X] > 0.0F))
    {
      return false;
    }
  }
  return true;
}

/** Adds the ratios of one kind of series of tile \a i; \a normal: of sum r^4 over (sum r^2)^2, of normal noise. */
template <std::size_t X, std::size_t Y>
void
AddRatios(const NoiseResiduals & residuals, std::size_t i, double normal, std::size_t kind, KurtosisSums & sums)
{
  const SampleTiles & tiles = residuals.GetTiles();
  const PowerSums     powers = SumPowers<X, Y>(tiles, residuals.OfTile(i));
  const float *       weight = residuals.WeightOf(i);
  const auto          least = InCorrelation.leastNoise * static_cast<float>(residuals.GetFreedom());
  for (std::size_t p = 0; p < tiles.Pixels(); ++p)
  {
    // Of pixels that are copies of each other nothing is left but rounding.
    if (powers.squares[p] * weight[p] > least && AllAreTaken<X, Y>(weight, tiles.side, p))
    {
      const double square = powers.squares[p];
      sums.series[kind] += 1.0;
      sums.ratio[kind] += powers.fourths[p] / (square * square) / normal;
    }
  }
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
  const double              freedom = residuals.GetFreedom();
  const Eigen::ArrayXd      kept = 1.0 - residuals.GetBasis().array().square().rowwise().sum();
  const double              normal = 3.0 * kept.square().sum() / (freedom * (freedom + 2.0));
  std::vector<KurtosisSums> sums(residuals.GetTiles().origins.size());
  parallelFor(sums.size(), [&](std::size_t i) {
    AddRatios<1, 1>(residuals, i, normal, 0, sums[i]);
    AddRatios<2, 1>(residuals, i, normal, 1, sums[i]);
    AddRatios<1, 2>(residuals, i, normal, 2, sums[i]);
    AddRatios<2, 2>(residuals, i, normal, 3, sums[i]);
    AddRatios<8, 1>(residuals, i, normal, 4, sums[i]);
    AddRatios<1, 8>(residuals, i, normal, 5, sums[i]);
  });
  return sums;
}

} // namespace sensornoise
