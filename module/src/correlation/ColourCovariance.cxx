// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/ColourCovariance.h"

#include "base/Jackknife.h"
#include "base/Quantiles.h"
#include "correlation/LagSums.h"

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

/** Sums over pairs of pixels: w^2 z times the covariance, and w^2 z^2, whose ratio is the slope of the covariance.
 * There is a row for each neighbour, and a column for the near neighbours and for those at three times the distance. */
struct NeighbourSums
{
  static constexpr int Directions = 2 * static_cast<int>(Neighbours.size());
  using Pairs = Eigen::Array<double, Directions, 2>;

  Pairs products = Pairs::Zero();
  Pairs squares = Pairs::Zero();

  NeighbourSums &
  operator+=(const NeighbourSums & other)
  {
    products += other.products;
    squares += other.squares;
    return *this;
  }
  /** Returns the sum of the slopes over the near neighbours, without those over the far ones; 0 without pairs. */
  double
  Slope() const
  {
    const Eigen::Array<double, 1, 2> slopes = (squares > 0.0).select(products / squares, 0.0).colwise().sum();
    return slopes(0) - slopes(1);
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
  Eigen::Index       direction; ///< row of NeighbourSums, for the first plane; the next one is for the second
  Eigen::Index       distance;  ///< column of NeighbourSums
  double             dof;       ///< expectation of a sum over time for noise of the covariance 1
};

/** Returns the trace of the product of the projections on what is left of both planes. */
double
CommonDof(const SampledNoise & a, const SampledNoise & b)
{
  return static_cast<double>(a.basis.rows() - a.basis.cols() - b.basis.cols()) +
         (a.basis.transpose() * b.basis).squaredNorm();
}

/** Returns the pair of plane \a first with the plane of the pixel at \a lag. */
PlanePair
PairAt(const SampledPlanes & planes, std::size_t first, const MosaicLag & lag)
{
  const std::array<int, 2> place{ static_cast<int>(planes.corners[first][0]) + lag.x,
                                  static_cast<int>(planes.corners[first][1]) + lag.y };
  PlanePair                pair{ first, first, {}, 0, 0, 0.0 };
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
  pair.dof = CommonDof(*planes.noise[pair.first], *planes.noise[pair.second]);
  return pair;
}

/** Returns the pairs of every plane with all neighbours in one direction, near and far. */
std::vector<PlanePair>
PairsOf(const SampledPlanes & planes)
{
  std::vector<PlanePair> pairs;
  for (std::size_t plane = 0; plane < planes.noise.size(); ++plane)
  {
    for (std::size_t k = 0; k < Neighbours.size(); ++k)
    {
      for (const int far : { 0, 1 })
      {
        const int scale = 1 + 2 * far;
        pairs.push_back(PairAt(planes, plane, { scale * Neighbours[k].x, scale * Neighbours[k].y }));
        pairs.back().direction = static_cast<Eigen::Index>(2 * k);
        pairs.back().distance = far;
      }
    }
  }
  return pairs;
}

/** Returns the pixels of a line of \a side pixels whose partners at \a shift are in the line, too: [first, last). */
std::pair<std::size_t, std::size_t>
WithPartners(int shift, std::size_t side)
{
  const auto reach = static_cast<std::size_t>(std::abs(shift));
  return shift < 0 ? std::pair{ std::min(reach, side), side }
                   : std::pair{ std::size_t{ 0 }, side - std::min(reach, side) };
}

/** Adds the pairs of tile \a tile to the sums of both planes. */
void
AddPairs(const SampledPlanes & planes, const PlanePair & pair, std::size_t tile, PlaneSums & sums)
{
  const SampledNoise & a = *planes.noise[pair.first];
  const SampledNoise & b = *planes.noise[pair.second];
  const SampleTiles &  tiles = a.tiles;
  const auto           shift = static_cast<std::ptrdiff_t>(pair.shift[1]) * static_cast<std::ptrdiff_t>(tiles.side) +
                     static_cast<std::ptrdiff_t>(pair.shift[0]);
  const std::size_t        begin = tiles.PlaceOf(tile, 0);
  const std::vector<float> products = SumProducts(a.values.data() + begin, b.values.data() + begin, tiles, shift);
  const auto               add = [&](std::size_t plane, Eigen::Index direction, double w, double z, double covariance) {
    sums[plane].products(direction, pair.distance) += w * w * z * covariance;
    sums[plane].squares(direction, pair.distance) += w * w * z * z;
  };
  const auto columns = WithPartners(pair.shift[0], tiles.side);
  const auto rows = WithPartners(pair.shift[1], tiles.side);
  for (std::size_t y = rows.first; y < rows.second; ++y)
  {
    for (std::size_t x = columns.first; x < columns.second; ++x)
    {
      const std::size_t inTile = y * tiles.side + x;
      const std::size_t p = tile * tiles.Pixels() + inTile;
      const auto        q = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) + shift);
      if (a.weight[p] > 0.0F && b.weight[q] > 0.0F)
      {
        const double covariance = static_cast<double>(products[inTile]) / pair.dof;
        add(pair.first, pair.direction, static_cast<double>(a.weight[p]), static_cast<double>(a.signal[p]), covariance);
        add(pair.second,
            pair.direction + 1,
            static_cast<double>(b.weight[q]),
            static_cast<double>(b.signal[q]),
            covariance);
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
  std::vector<PlaneSums>       tiles(planes.noise.front()->tiles.origins.size());
  const std::vector<PlanePair> pairs = PairsOf(planes);
  parallelFor(tiles.size(), [&](std::size_t tile) {
    for (const PlanePair & pair : pairs)
    {
      AddPairs(planes, pair, tile, tiles[tile]);
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
