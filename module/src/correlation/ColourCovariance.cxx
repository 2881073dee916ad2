// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/ColourCovariance.h"

#include "base/Jackknife.h"
#include "base/Quantiles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sensornoise
{

SampledNoise::SampledNoise(const NoiseResiduals & residuals)
  : tiles(residuals.GetTiles())
  , basis(residuals.GetBasis())
{
  const std::size_t        all = tiles.origins.size();
  const std::size_t        ofTile = tiles.frames * tiles.Pixels();
  const std::size_t        most = std::max(SampleTiles::EnoughTiles, MostValues / std::max<std::size_t>(1, ofTile));
  const std::size_t        kept = std::min(all, most);
  std::vector<std::size_t> chosen;
  std::vector<SampleTiles::Origin> origins;
  for (std::size_t i = 0; i < kept; ++i)
  {
    chosen.push_back(i * all / kept);
    origins.push_back(tiles.origins[chosen.back()]);
  }
  tiles.origins = std::move(origins);
  for (const std::size_t i : chosen)
  {
    values.insert(values.end(), residuals.OfTile(i), residuals.OfTile(i) + ofTile);
    weight.insert(weight.end(), residuals.WeightOf(i), residuals.WeightOf(i) + tiles.Pixels());
    signal.insert(signal.end(), residuals.SignalOf(i), residuals.SignalOf(i) + tiles.Pixels());
  }
}

namespace
{
/** Distance of two pixels in the mosaic [pixel]. */
struct MosaicLag
{
  int x;
  int y;
};

/** One of each pair of opposite neighbours. */
constexpr std::array<MosaicLag, 4> Neighbours{ { { 1, 0 }, { 0, 1 }, { 1, 1 }, { -1, 1 } } };

/** Sums over pairs of pixels: w^2 z times the covariance, and w^2 z^2, whose ratio is the slope of the covariance. */
struct NeighbourProducts
{
  double product{ 0.0 };
  double square{ 0.0 };

  NeighbourProducts &
  operator+=(const NeighbourProducts & other)
  {
    product += other.product;
    square += other.square;
    return *this;
  }
};

/** Sums for each pair of opposite neighbours, in both directions, near and at three times the distance. */
struct NeighbourSums
{
  std::array<std::array<NeighbourProducts, 2 * Neighbours.size()>, 2> pairs{};

  NeighbourSums &
  operator+=(const NeighbourSums & other)
  {
    for (std::size_t far = 0; far < pairs.size(); ++far)
    {
      for (std::size_t k = 0; k < pairs[far].size(); ++k)
      {
        pairs[far][k] += other.pairs[far][k];
      }
    }
    return *this;
  }
  /** Returns the sum of the slopes over the near neighbours, without those over the far ones; 0 without pairs. */
  double
  Slope() const
  {
    double slope = 0.0;
    for (std::size_t far = 0; far < pairs.size(); ++far)
    {
      for (const NeighbourProducts & pair : pairs[far])
      {
        slope += pair.square > 0.0 ? (far == 0 ? 1.0 : -1.0) * pair.product / pair.square : 0.0;
      }
    }
    return slope;
  }
};

using PlaneSums = std::array<NeighbourSums, 4>;

/** A pair of planes at one distance: pixel (x, y) of \a first has the partner (x + shift[0], y + shift[1]) in
 * \a second. */
struct PlanePair
{
  std::size_t        first;
  std::size_t        second;
  std::array<int, 2> shift;
};

PlanePair
PairAt(const SampledPlanes & planes, std::size_t first, const MosaicLag & lag)
{
  const std::array<int, 2> place{ static_cast<int>(planes.corners[first][0]) + lag.x,
                                  static_cast<int>(planes.corners[first][1]) + lag.y };
  PlanePair                pair{ first, first, {} };
  for (std::size_t k = 0; k < planes.corners.size(); ++k)
  {
    const std::array<int, 2> rest{ place[0] - static_cast<int>(planes.corners[k][0]),
                                   place[1] - static_cast<int>(planes.corners[k][1]) };
    if (rest[0] % 2 == 0 && rest[1] % 2 == 0)
    {
      pair.second = k;
      pair.shift = { rest[0] / 2, rest[1] / 2 };
    }
  }
  return pair;
}

/** Returns the pixels of a line of \a side pixels whose partners at \a shift are in the line, too: [first, last). */
std::pair<std::size_t, std::size_t>
WithPartners(int shift, std::size_t side)
{
  const auto reach = static_cast<std::size_t>(std::abs(shift));
  return shift < 0 ? std::pair{ std::min(reach, side), side }
                   : std::pair{ std::size_t{ 0 }, side - std::min(reach, side) };
}

/** Adds the pairs of tile \a tile to the sums of both planes, at [far][k] and [far][k + 1]. \a dof is the expectation
 * of a sum over time for noise of the covariance 1. */
void
AddPairs(const SampledPlanes & planes,
         const PlanePair &     pair,
         std::size_t           tile,
         double                dof,
         std::size_t           far,
         std::size_t           k,
         PlaneSums &           sums)
{
  const SampledNoise & a = *planes.noise[pair.first];
  const SampledNoise & b = *planes.noise[pair.second];
  const SampleTiles &  tiles = a.tiles;
  const auto [firstX, lastX] = WithPartners(pair.shift[0], tiles.side);
  const auto rows = WithPartners(pair.shift[1], tiles.side);
  const auto partner = [&](std::size_t p) {
    return static_cast<std::size_t>(static_cast<int>(p) + pair.shift[1] * static_cast<int>(tiles.side) + pair.shift[0]);
  };
  std::vector<float> products(tiles.side);
  for (std::size_t y = rows.first; y < rows.second; ++y)
  {
    std::fill(products.begin(), products.end(), 0.0F);
    const std::size_t row = y * tiles.side;
    const std::size_t count = lastX - firstX;
    for (std::size_t t = 0; t < tiles.frames; ++t)
    {
      const float * const own = a.values.data() + tiles.PlaceOf(tile, t) + row + firstX;
      const float * const other = b.values.data() + tiles.PlaceOf(tile, t) + partner(row + firstX);
      for (std::size_t i = 0; i < count; ++i)
      {
        products[i] += own[i] * other[i];
      }
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t p = tile * tiles.Pixels() + row + firstX + i;
      const std::size_t q = tile * tiles.Pixels() + partner(row + firstX + i);
      if (a.weight[p] > 0.0F && b.weight[q] > 0.0F)
      {
        const double covariance = static_cast<double>(products[i]) / dof;
        const auto   add = [&](std::size_t plane, std::size_t place, double w, double z) {
          sums[plane].pairs[far][place] += { w * w * z * covariance, w * w * z * z };
        };
        add(pair.first, k, static_cast<double>(a.weight[p]), static_cast<double>(a.signal[p]));
        add(pair.second, k + 1, static_cast<double>(b.weight[q]), static_cast<double>(b.signal[q]));
      }
    }
  }
}

bool
HaveSameTiles(const SampledPlanes & planes)
{
  const SampledNoise & first = *planes.noise.front();
  return !first.tiles.origins.empty() &&
         std::all_of(planes.noise.begin(), planes.noise.end(), [&first](const SampledNoise * noise) {
           return noise->values.size() == first.values.size() && noise->tiles.frames == first.tiles.frames &&
                  noise->basis.rows() == first.basis.rows();
         });
}

/** Returns the trace of the product of the projections on what is left of both planes: the expectation of a sum over
 * time for noise of the covariance 1. */
double
CommonDof(const SampledNoise & a, const SampledNoise & b)
{
  return static_cast<double>(a.basis.rows() - a.basis.cols() - b.basis.cols()) +
         (a.basis.transpose() * b.basis).squaredNorm();
}
} // namespace

std::array<NeighbourCovariance, 4>
MeasureNeighbourCovariance(const SampledPlanes & planes, const ParallelFor & parallelFor)
{
  std::array<NeighbourCovariance, 4> covariances;
  if (!HaveSameTiles(planes))
  {
    covariances.fill({ { 0.0, std::numeric_limits<double>::infinity() }, 0.0 });
    return covariances;
  }
  std::vector<PlaneSums> tiles(planes.noise.front()->tiles.origins.size());
  parallelFor(tiles.size(), [&](std::size_t tile) {
    for (std::size_t plane = 0; plane < planes.noise.size(); ++plane)
    {
      for (std::size_t k = 0; k < Neighbours.size(); ++k)
      {
        for (const int far : { 0, 1 })
        {
          const int       scale = 1 + 2 * far;
          const PlanePair pair = PairAt(planes, plane, { scale * Neighbours[k].x, scale * Neighbours[k].y });
          const double    dof = CommonDof(*planes.noise[pair.first], *planes.noise[pair.second]);
          AddPairs(planes, pair, tile, dof, static_cast<std::size_t>(far), 2 * k, tiles[tile]);
        }
      }
    }
  });
  for (std::size_t plane = 0; plane < covariances.size(); ++plane)
  {
    std::vector<NeighbourSums> ofPlane;
    std::vector<double>        slopes;
    for (const PlaneSums & tile : tiles)
    {
      ofPlane.push_back(tile[plane]);
      slopes.push_back(tile[plane].Slope());
    }
    const JackknifeEstimate estimate =
      Jackknife(ofPlane, [](const NeighbourSums & sum) { return Eigen::VectorXd::Constant(1, sum.Slope()); });
    covariances[plane] = { { estimate.value(0), estimate.StandardError(0) }, QuantileOf(std::move(slopes), 0.5) };
  }
  return covariances;
}

} // namespace sensornoise
