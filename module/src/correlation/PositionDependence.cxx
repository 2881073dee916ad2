// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/ProcessingSigns.h"

#include "base/Eigen.h"
#include "base/Constants.h"
#include "base/Quantiles.h"
#include "correlation/CorrelationSums.h"
#include "correlation/LagSums.h"
#include "correlation/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

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

namespace
{
/** Sums over the pixels at one position along an axis, and over their neighbours, in one intensity bin. */
struct PlaceSums
{
  double pairs{ 0.0 };      // by their flatness
  double product{ 0.0 };    // pixel times neighbour
  double square{ 0.0 };     // pixel squared
  double neighbours{ 0.0 }; // neighbour squared

  PlaceSums &
  operator+=(const PlaceSums & other)
  {
    pairs += other.pairs;
    product += other.product;
    square += other.square;
    neighbours += other.neighbours;
    return *this;
  }
  /** Returns the value that the product would have if both were equal. */
  double
  Scale() const
  {
    return std::sqrt(square * neighbours);
  }
};
using PlaceBins = std::array<PlaceSums, NoiseResiduals::IntensityBins>;

void
AddBins(const PlaceBins & bins, PlaceBins & sum)
{
  for (std::size_t b = 0; b < sum.size(); ++b)
  {
    sum[b] += bins[b];
  }
}

/** Sums by the parity of the line, then by the position along the axis. */
using AxisSums = std::array<std::vector<PlaceBins>, 2>;

constexpr int LargestLag = 2;

/** Sums along both axes at each lag, by the position in a tile. */
struct TraceSums
{
  std::array<AxisSums, 2 * LargestLag> axes;
};

/** Returns the index into TraceSums::axes; \a axis is 0 along x, 1 along y. */
std::size_t
IndexOf(int lag, std::size_t axis)
{
  return 2 * static_cast<std::size_t>(lag - 1) + axis;
}

/** Returns how little the noise variance changes around the pixel (x, y) of a tile, from 0 to 1. A filter weights the
 * variances around an edge, so that coefficients there differ with the place, as behind an enlargement. \a weight has
 * the weights of the tile's pixels, \a side is its width and height. */
double
FlatnessAt(const float * weight, std::size_t side, std::size_t x, std::size_t y)
{
  float low = weight[y * side + x];
  float high = low;
  if (!(low > 0.0F))
  {
    return 0.0;
  }
  for (std::size_t v = y - std::min<std::size_t>(y, 1); v < std::min(side, y + 2); ++v)
  {
    for (std::size_t u = x - std::min<std::size_t>(x, 1); u < std::min(side, x + 2); ++u)
    {
      const float other = weight[v * side + u];
      low = other > 0.0F ? std::min(low, other) : low;
      high = std::max(high, other);
    }
  }
  return std::pow(static_cast<double>(low) / high, InCorrelation.exponentOfFlatness);
}

/** Returns the sums of a tile along one axis. Pairs count by the \a flatness of both pixels. \a squares are the
 * products of its pixels with themselves, \a products with their neighbours \a apart pixels away. */
AxisSums
SumAxis(const NoiseResiduals &      residuals,
        std::size_t                 tile,
        std::size_t                 axis,
        std::size_t                 apart,
        const std::vector<double> & flatness,
        const std::vector<float> &  squares,
        const std::vector<float> &  products)
{
  const std::size_t    side = residuals.GetTiles().side;
  const auto &         origin = residuals.GetTiles().origins[tile];
  const std::size_t    firstLine = axis == 0 ? origin.y : origin.x;
  const float *        weight = residuals.WeightOf(tile);
  const std::uint8_t * bin = residuals.BinOf(tile);
  AxisSums             sums;
  sums.fill(std::vector<PlaceBins>(side));
  for (std::size_t line = 0; line < side; ++line)
  {
    for (std::size_t place = 0; place + apart < side; ++place)
    {
      const std::size_t p = axis == 0 ? line * side + place : place * side + line;
      const std::size_t q = p + apart * (axis == 0 ? 1 : side);
      const double      w = static_cast<double>(weight[p]) * weight[q];
      if (w > 0.0)
      {
        const double flat = flatness[p] * flatness[q];
        sums[(firstLine + line) % 2][place][bin[p]] += { flat,
                                                         flat * products[p] * std::sqrt(w),
                                                         flat * static_cast<double>(squares[p]) * weight[p],
                                                         flat * static_cast<double>(squares[q]) * weight[q] };
      }
    }
  }
  return sums;
}

TraceSums
SumTraces(const NoiseResiduals & residuals, std::size_t tile)
{
  std::vector<Lag> lags{ {} };
  for (int lag = 1; lag <= LargestLag; ++lag)
  {
    lags.push_back({ lag, 0, 0 });
    lags.push_back({ 0, lag, 0 });
  }
  const auto          products = SumProducts(residuals, tile, lags);
  const std::size_t   side = residuals.GetTiles().side;
  std::vector<double> flatness;
  for (std::size_t p = 0; p < side * side; ++p)
  {
    flatness.push_back(FlatnessAt(residuals.WeightOf(tile), side, p % side, p / side));
  }
  TraceSums sums;
  for (std::size_t index = 0; index < sums.axes.size(); ++index)
  {
    const Lag & lag = lags[1 + index];
    const auto  apart = static_cast<std::size_t>(lag.x + lag.y);
    sums.axes[index] = SumAxis(residuals, tile, index % 2, apart, flatness, products[0], products[1 + index]);
  }
  return sums;
}

/** Returns the sums at every position of the frame. */
AxisSums
SumsOfFrame(const NoiseResiduals & residuals, const std::vector<TraceSums> & tiles, std::size_t index)
{
  const SampleTiles & places = residuals.GetTiles();
  const bool          isAlongX = index % 2 == 0;
  std::size_t         extent = 0;
  for (const SampleTiles::Origin & origin : places.origins)
  {
    extent = std::max(extent, (isAlongX ? origin.x : origin.y) + places.side);
  }
  AxisSums frame;
  frame.fill(std::vector<PlaceBins>(extent));
  for (std::size_t i = 0; i < tiles.size(); ++i)
  {
    const std::size_t first = isAlongX ? places.origins[i].x : places.origins[i].y;
    for (std::size_t parity = 0; parity < 2; ++parity)
    {
      for (std::size_t place = 0; place < places.side; ++place)
      {
        AddBins(tiles[i].axes[index][parity][place], frame[parity][first + place]);
      }
    }
  }
  return frame;
}

/** Coefficient at each position, less its typical value at the signal there, and the number of pairs. */
struct PlaceCoefficients
{
  std::vector<double> excess;
  std::vector<double> pairs;
};

/** Returns the coefficients in the lines of one parity. */
PlaceCoefficients
CoefficientsOf(const std::vector<PlaceBins> & sums)
{
  PlaceBins all{};
  for (const PlaceBins & place : sums)
  {
    AddBins(place, all);
  }
  PlaceCoefficients found;
  for (const PlaceBins & place : sums)
  {
    double product = 0.0;
    double scale = 0.0;
    double pairs = 0.0;
    for (std::size_t b = 0; b < all.size(); ++b)
    {
      const double typical = all[b].Scale() > 0.0 ? all[b].product / all[b].Scale() : 0.0;
      product += place[b].product - typical * place[b].Scale();
      scale += place[b].Scale();
      pairs += place[b].pairs;
    }
    found.excess.push_back(scale > 0.0 ? product / scale : 0.0);
    found.pairs.push_back(scale > 0.0 ? pairs : 0.0);
  }
  return found;
}

/** Returns the largest oscillation among the frequencies k / (2 extent) cycles per pixel, if it is significant. */
std::optional<EnlargementTrace>
LargestOscillation(const std::vector<double> & values, const std::vector<double> & pairs)
{
  const std::size_t extent = values.size();
  double            total = 0.0;
  for (const double count : pairs)
  {
    total += count;
  }
  if (!(total > 0.0))
  {
    return std::nullopt;
  }
  const auto   first = static_cast<std::size_t>(2.0 * InCorrelation.leastCyclesPerPixel * static_cast<double>(extent));
  const double pi = std::acos(-1.0);
  std::vector<double> squares;
  for (std::size_t k = first; k <= extent; ++k)
  {
    const std::complex<double> step = std::polar(1.0, pi * static_cast<double>(k) / static_cast<double>(extent));
    std::complex<double>       phase = 1.0;
    std::complex<double>       sum = 0.0;
    for (std::size_t x = 0; x < extent; ++x)
    {
      sum += pairs[x] * values[x] * phase;
      phase *= step;
    }
    squares.push_back(std::norm(sum / total));
  }
  const auto   largest = std::max_element(squares.begin(), squares.end());
  const double peak = *largest;
  const auto   k = first + static_cast<std::size_t>(largest - squares.begin());
  // Without an oscillation, the squared amplitudes are exponentially distributed.
  const double     chance = Quantile(squares, 0.5) / std::log(2.0);
  EnlargementTrace trace;
  trace.cyclesPerPixel = 0.5 * static_cast<double>(k) / static_cast<double>(extent);
  trace.amplitude = (k == extent ? 1.0 : 2.0) * std::sqrt(peak);
  const bool isSeen =
    trace.amplitude > InCorrelation.leastOscillation && peak > InCorrelation.oscillationRatio * chance;
  return isSeen ? std::optional(trace) : std::nullopt;
}
} // namespace

std::optional<EnlargementTrace>
FindEnlargementTrace(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  std::vector<TraceSums> tiles(residuals.GetTiles().origins.size());
  parallelFor(tiles.size(), [&](std::size_t i) { tiles[i] = SumTraces(residuals, i); });
  std::optional<EnlargementTrace> largest;
  for (int lag = 1; lag <= LargestLag; ++lag)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const AxisSums          sums = SumsOfFrame(residuals, tiles, IndexOf(lag, axis));
      const PlaceCoefficients even = CoefficientsOf(sums[0]);
      const PlaceCoefficients odd = CoefficientsOf(sums[1]);
      for (const bool isAlternating : { false, true })
      {
        std::vector<double> values;
        std::vector<double> pairs;
        for (std::size_t x = 0; x < even.excess.size(); ++x)
        {
          values.push_back(0.5 * (even.excess[x] + (isAlternating ? -1.0 : 1.0) * odd.excess[x]));
          pairs.push_back(std::min(even.pairs[x], odd.pairs[x]));
        }
        auto trace = LargestOscillation(values, pairs);
        if (trace && (!largest || trace->amplitude > largest->amplitude))
        {
          trace->lag = lag;
          trace->isAlongX = axis == 0;
          trace->isAlternating = isAlternating;
          largest = trace;
        }
      }
    }
  }
  return largest;
}

} // namespace sensornoise
