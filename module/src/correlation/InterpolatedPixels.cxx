// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/ProcessingSigns.h"

#include "base/Quantiles.h"
#include "base/Simd.h"
#include "correlation/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
struct Neighbour
{
  int x;
  int y;
};

/** Means of neighbours by which cameras replace pixels: copies, pairs, the nearest four, the corners, and all eight. A
 * copy and its original are alike, and it suffices that one of them is left out: each is compared with the pixel before
 * it alone. */
const std::vector<std::vector<Neighbour>> MeansOfNeighbours{
  { { -1, 0 } },
  { { 0, -1 } },
  { { -1, 0 }, { 1, 0 } },
  { { 0, -1 }, { 0, 1 } },
  { { -1, -1 }, { 1, 1 } },
  { { 1, -1 }, { -1, 1 } },
  { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } },
  { { -1, -1 }, { 1, -1 }, { -1, 1 }, { 1, 1 } },
  { { -1, -1 }, { 0, -1 }, { 1, -1 }, { -1, 0 }, { 1, 0 }, { -1, 1 }, { 0, 1 }, { 1, 1 } },
};

/** Noise of a pixel compared with a mean of its neighbours. */
struct Comparison
{
  float difference{ NotCompared }; ///< mean square of the difference over its value for independent noise [1]
  float sum{ NotCompared };        ///< mean square of the sum over its value for independent noise [1]
  static constexpr float NotCompared = std::numeric_limits<float>::infinity();
};

/** \class TileProducts
 * \brief Sums over frames of the products of two pixels of a tile, at most 2 pixels apart.
 *
 * The tile has a border of zeros, so that every pixel has neighbours. */
class TileProducts
{
public:
  /** Values of the pixels of a tile and of its border. */
  using Values = std::array<float, (SampleTiles::Side + 2) * (SampleTiles::Side + 2)>;

  TileProducts(const NoiseResiduals & residuals, std::size_t i)
    : m_Side(residuals.GetTiles().side)
    , m_Row(m_Side + 2)
    , m_Sums(Lags)
  {
    m_VarianceDn2.fill(std::numeric_limits<float>::infinity());
    for (std::size_t p = 0; p < m_Side * m_Side; ++p)
    {
      m_VarianceDn2[this->PlaceOf(p)] = 1.0F / residuals.WeightOf(i)[p]; // infinite at weight 0
    }
    const SampleTiles & tiles = residuals.GetTiles();
    const std::size_t   frames = std::min(tiles.frames, InCorrelation.framesOfComparison);
    m_Dof = residuals.GetDof() * static_cast<double>(frames) / static_cast<double>(tiles.frames);
    Values values{};
    for (std::size_t k = 0; k < frames; ++k)
    {
      const float * frame = residuals.OfTile(i) + k * tiles.frames / frames * tiles.Pixels();
      for (std::size_t y = 0; y < m_Side; ++y)
      {
        std::copy_n(frame + y * m_Side, m_Side, values.data() + this->PlaceOf(y * m_Side));
      }
      this->AddFrame(values);
    }
  }

  /** Returns the place of pixel \a p of the tile among the values. */
  std::size_t
  PlaceOf(std::size_t p) const
  {
    return (p / m_Side + 1) * m_Row + p % m_Side + 1;
  }
  /** Returns the typical noise variance of the pixels; infinite on the border, and at pixels that are left out [DN^2].
   */
  const Values &
  GetVarianceDn2() const
  {
    return m_VarianceDn2;
  }
  /** Returns the degrees of freedom of the sums. */
  double
  GetDof() const
  {
    return m_Dof;
  }
  /** Adds \a factor times the product of the pixels at the distances \a a and \a b from each pixel to \a sum. */
  void
  AddProduct(Neighbour a, Neighbour b, float factor, Values & sum) const
  {
    if (b.y < a.y || (b.y == a.y && b.x < a.x))
    {
      std::swap(a, b);
    }
    this->AddShifted(m_Sums[LagOf(b.x - a.x, b.y - a.y)], a, factor, sum);
  }
  /** Adds \a factor times the values of the pixels at the distance \a a to \a sum. */
  void
  AddShifted(const Values & values, Neighbour a, float factor, Values & sum) const
  {
    const float * shifted = values.data() + this->StepTo(a);
    for (std::size_t p = m_Row + 1; p + 1 < m_Row * (m_Side + 1); ++p)
    {
      sum[p] += factor * shifted[p];
    }
  }

private:
  /** The lags of a half plane: three along the row, and five in each of the next two rows. */
  static constexpr std::size_t Lags = 13;
  static std::size_t
  LagOf(int x, int y)
  {
    return static_cast<std::size_t>(y == 0 ? x : 5 * y + x);
  }
  std::ptrdiff_t
  StepTo(Neighbour a) const
  {
    return static_cast<std::ptrdiff_t>(m_Row) * a.y + a.x;
  }
  void
  AddFrame(const Values & values)
  {
    CallWithAvx2([this, &values] {
      for (int y = 0; y <= 2; ++y)
      {
        for (int x = y == 0 ? 0 : -2; x <= 2; ++x)
        {
          const auto        step = static_cast<std::size_t>(this->StepTo({ x, y }));
          Values &          sums = m_Sums[LagOf(x, y)];
          const std::size_t last = m_Row * m_Row - step;
          for (std::size_t p = 0; p < last; ++p)
          {
            sums[p] += values[p] * values[p + step];
          }
        }
      }
    });
  }

  std::size_t         m_Side;
  std::size_t         m_Row;
  double              m_Dof{ 0.0 };
  std::vector<Values> m_Sums; // by LagOf()
  Values              m_VarianceDn2{};
};

/** Compares the pixels of a tile of \a pixels pixels with a mean of \a neighbours. */
std::vector<Comparison>
CompareTile(const TileProducts & products, std::size_t pixels, const std::vector<Neighbour> & neighbours)
{
  const float          part = 1.0F / static_cast<float>(neighbours.size());
  const Neighbour      itself{ 0, 0 };
  TileProducts::Values own{};      // square of the pixel plus square of the mean
  TileProducts::Values both{};     // twice their product
  TileProducts::Values expected{}; // variance of the pixel plus variance of the mean
  CallWithAvx2([&] {
    products.AddProduct(itself, itself, 1.0F, own);
    products.AddShifted(products.GetVarianceDn2(), itself, 1.0F, expected);
    for (const Neighbour & neighbour : neighbours)
    {
      products.AddProduct(itself, neighbour, 2.0F * part, both);
      products.AddShifted(products.GetVarianceDn2(), neighbour, part * part, expected);
      for (const Neighbour & other : neighbours)
      {
        products.AddProduct(neighbour, other, part * part, own);
      }
    }
  });
  std::vector<Comparison> compared(pixels);
  for (std::size_t p = 0; p < pixels; ++p)
  {
    const std::size_t place = products.PlaceOf(p);
    if (std::isfinite(expected[place])) // the pixel and all neighbours are used
    {
      const float ofNoise = static_cast<float>(products.GetDof()) * expected[place];
      compared[p] = { (own[place] - both[place]) / ofNoise, (own[place] + both[place]) / ofNoise };
    }
  }
  return compared;
}

/** Comparisons of all pixels of the sample with one mean. */
using OfSample = std::vector<std::vector<Comparison>>;

/** Returns the median of \a member over the compared pixels [1]; 0 if there are none. */
double
MedianOf(const OfSample & sample, float Comparison::* member)
{
  std::vector<double> values;
  for (const std::vector<Comparison> & tile : sample)
  {
    for (const Comparison & own : tile)
    {
      if (own.*member != Comparison::NotCompared)
      {
        values.push_back(own.*member);
      }
    }
  }
  return values.empty() ? 0.0 : QuantileOf(std::move(values), 0.5);
}

/** Smallest ratios of a pixel over all means, to the median of the ratios of the sample [1]. */
struct SmallestRatios
{
  std::vector<float> differences;
  std::vector<float> sums;
};

SmallestRatios
CompareWithNeighbours(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  const std::size_t count = residuals.GetTiles().origins.size();
  const std::size_t size = residuals.GetTiles().Pixels();
  SmallestRatios    smallest{ std::vector<float>(count * size, 1.0F), std::vector<float>(count * size, 1.0F) };
  OfSample          sample(count);
  std::vector<std::optional<TileProducts>> products(count);
  parallelFor(count, [&](std::size_t i) { products[i].emplace(residuals, i); });
  for (const std::vector<Neighbour> & neighbours : MeansOfNeighbours)
  {
    parallelFor(count, [&](std::size_t i) { sample[i] = CompareTile(*products[i], size, neighbours); });
    std::array<double, 2> medians{};
    parallelFor(medians.size(), [&](std::size_t k) {
      medians[k] = MedianOf(sample, k == 0 ? &Comparison::difference : &Comparison::sum);
    });
    const auto lower = [](float own, double median, float & ratio) {
      ratio = own < ratio * median ? own / static_cast<float>(median) : ratio;
    };
    parallelFor(count, [&](std::size_t i) {
      for (std::size_t p = 0; p < size; ++p)
      {
        lower(sample[i][p].difference, medians[0], smallest.differences[i * size + p]);
        lower(sample[i][p].sum, medians[1], smallest.sums[i * size + p]);
      }
    });
  }
  return smallest;
}

/** Returns the largest ratio up to InCorrelation.largestDifference at which few of the pixels below it are so by chance
 * [1]; 0: there is none. Independent noise has as small sums as differences. */
float
LargestRatio(const SmallestRatios & smallest)
{
  const auto below = [](const std::vector<float> & ratios, float limit) {
    return static_cast<double>(
      std::count_if(ratios.begin(), ratios.end(), [limit](float ratio) { return ratio < limit; }));
  };
  for (float limit = InCorrelation.largestDifference; limit > InCorrelation.smallestDifference; limit *= 0.8F)
  {
    if (below(smallest.sums, limit) < InCorrelation.mostByChance * below(smallest.differences, limit))
    {
      return limit;
    }
  }
  return 0.0F;
}
} // namespace

void
InterpolatedPixels::LeaveOutOf(std::vector<std::uint8_t> & take) const
{
  for (const std::vector<std::size_t> * const left : { &pixels, &notCompared })
  {
    for (const std::size_t p : *left)
    {
      take[p] = 0;
    }
  }
}

InterpolatedPixels
FindInterpolatedPixels(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  const SampleTiles &  tiles = residuals.GetTiles();
  const SmallestRatios smallest = CompareWithNeighbours(residuals, parallelFor);
  const float          limit = LargestRatio(smallest);
  InterpolatedPixels   found;
  double               lost = 0.0;
  for (std::size_t i = 0; i < tiles.origins.size(); ++i)
  {
    for (std::size_t p = 0; p < tiles.Pixels(); ++p)
    {
      if (smallest.differences[i * tiles.Pixels() + p] < limit)
      {
        found.pixels.push_back(residuals.PixelOf(i, p));
        lost += 1.0 - residuals.SquaresOf(i)[p] * residuals.WeightOf(i)[p] / residuals.GetDof();
      }
      const std::size_t x = p % tiles.side;
      const std::size_t y = p / tiles.side;
      const bool        isInside = std::min(x, y) > 0 && std::max(x, y) + 1 < tiles.side;
      if (!isInside)
      {
        found.notCompared.push_back(residuals.PixelOf(i, p));
      }
    }
  }
  const auto used = static_cast<double>(std::max<std::size_t>(1, residuals.GetNumberOfPixels()));
  found.fraction = static_cast<double>(found.pixels.size()) / used;
  found.lostVariance = lost / used;
  const bool isSome =
    found.fraction > InCorrelation.leastInterpolated && found.fraction < InCorrelation.mostInterpolated;
  return isSome ? found : InterpolatedPixels{};
}

} // namespace sensornoise
