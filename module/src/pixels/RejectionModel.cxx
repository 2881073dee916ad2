// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/StaticVariance.h"

#include "base/Constants.h"
#include "sensornoise/Parallel.h"
#include "base/Quantiles.h"
#include "moments/Constants.h"
#include "moments/DarkFrames.h"
#include "pixels/Constants.h"
#include "pixels/FixedPatternEstimate.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/VarianceLine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
/** Mean excess of the variance over the line in a tile. */
struct RejectionTile
{
  double level{ 0.0 };     // mean level [DN]
  double excess{ 0.0 };    // mean of the variance relative to the line, minus 1 [1]
  double spread{ 0.0 };    // dispersion of the noise variance from pixel to pixel [DN^4]
  double pixels{ 0.0 };    // number of pixels
  double roughness{ 0.0 }; // mean roughness class
};

/** Excess over a line of a row of pixels, computed with SIMD instructions; the sums over the row are not. */
struct TileRow
{
  VarianceLine line;
  double       excess[InPixels.rejectionTileSide]{};
  double       expected[InPixels.rejectionTileSide]{};
  double       chance[InPixels.rejectionTileSide]{};

  void
  Compare(const VarianceData & data, std::size_t first, std::size_t pixels)
  {
    const VarianceLine   own = line; // a copy that no pointer can alias
    const double * const mean = data.mean + first;
    const float * const  dof = data.dof + first;
    data.variance.Fill(first, pixels, excess);
    for (std::size_t i = 0; i < pixels; ++i)
    {
      expected[i] = own.At(mean[i]);
      excess[i] -= expected[i];
      chance[i] = own.SamplingVariance(dof[i], expected[i]);
    }
  }
};

RejectionTile
SumRejectionTile(const VarianceLine &      line,
                 const VarianceData &      data,
                 const ProjectedVariance & projected,
                 std::size_t               left,
                 std::size_t               top)
{
  const FrameGeometry & geometry = projected.GetFrame().geometry;
  const double          reachDn2 =
    InMoments.defectiveNoiseFactor * InMoments.defectiveNoiseFactor * line.lowestDn2 / InPixels.lowestFraction;
  RejectionTile     square;
  double            total = 0.0;
  double            squares = 0.0;
  double            chance = 0.0;
  TileRow           row{ line };
  const std::size_t across = std::min(InPixels.rejectionTileSide, geometry.width - left);
  for (std::size_t y = top; y < std::min(top + InPixels.rejectionTileSide, geometry.height); ++y)
  {
    const std::size_t first = y * geometry.width + left;
    row.Compare(data, first, across);
    for (std::size_t i = 0; i < across; ++i)
    {
      const std::size_t p = first + i;
      if (data.mask[p] != 0 && row.excess[i] < reachDn2 + row.expected[i])
      {
        square.pixels += 1.0;
        square.level += data.mean[p];
        square.roughness += projected.ClassOf(p);
        square.excess += row.excess[i];
        total += row.expected[i];
        squares += row.excess[i] * row.excess[i];
        chance += row.chance[i];
      }
    }
  }
  if (square.pixels > 0.0)
  {
    square.level /= square.pixels;
    square.roughness /= square.pixels;
    square.spread = (squares - chance - square.excess * square.excess / square.pixels) / square.pixels;
    square.excess /= total;
  }
  return square;
}

/** Returns the tiles with enough pixels, sorted by their levels. */
std::vector<RejectionTile>
MakeRejectionTiles(const VarianceLine &      line,
                   const VarianceData &      data,
                   const ProjectedVariance & projected,
                   const ParallelFor &       parallelFor)
{
  const FrameGeometry &      geometry = projected.GetFrame().geometry;
  const std::size_t          across = (geometry.width + InPixels.rejectionTileSide - 1) / InPixels.rejectionTileSide;
  const std::size_t          down = (geometry.height + InPixels.rejectionTileSide - 1) / InPixels.rejectionTileSide;
  std::vector<RejectionTile> squares(across * down);
  const std::size_t          oneIn = std::max<std::size_t>(1, squares.size() / InPixels.enoughRejectionTiles);
  parallelFor(down, [&](std::size_t row) {
    for (std::size_t column = row % oneIn; column < across; column += oneIn)
    {
      squares[row * across + column] =
        SumRejectionTile(line, data, projected, column * InPixels.rejectionTileSide, row * InPixels.rejectionTileSide);
    }
  });
  const auto isTooSmall = [](const RejectionTile & square) {
    return square.pixels < InPixels.leastPixelsOfRejectionTile;
  };
  squares.erase(std::remove_if(squares.begin(), squares.end(), isTooSmall), squares.end());
  std::stable_sort(squares.begin(), squares.end(), [](const auto & a, const auto & b) { return a.level < b.level; });
  return squares;
}

double
MedianOf(const std::vector<RejectionTile> & squares,
         std::size_t                        first,
         std::size_t                        last,
         double RejectionTile::* member)
{
  std::vector<double> values;
  for (std::size_t i = first; i < last; ++i)
  {
    values.push_back(squares[i].*member);
  }
  return Quantile(values, 0.5);
}
} // namespace

RejectionModel
FitRejectionModel(const VarianceLine &              line,
                  const ProjectedVariance &         projected,
                  const std::vector<std::uint8_t> & mask,
                  double                            blackDn,
                  const ParallelFor &               parallelFor)
{
  RejectionModel             model{ line, {}, {} };
  const VarianceData         data = projected.GetData(mask);
  std::vector<RejectionTile> squares = MakeRejectionTiles(line, data, projected, parallelFor);
  if (!squares.empty())
  {
    const double patternDn2 =
      EstimateFixedPattern(projected.GetFrame(), data, line, blackDn, parallelFor).OffsetVarianceDn2();
    const double darkest = line.At(squares.front().level);
    model.byNeighbours = line.gain * line.gain * patternDn2 > InPixels.largestDsnuEffect * darkest * darkest;
  }
  const std::size_t bins = std::min(InPixels.mostRejectionLevels, squares.size() / InPixels.tilesPerLevel);
  bool              deviates = false;
  for (std::size_t b = 0; b < bins; ++b)
  {
    const std::size_t first = b * squares.size() / bins;
    const std::size_t end = (b + 1) * squares.size() / bins;
    const auto        at = [&](std::size_t i) { return squares.begin() + static_cast<std::ptrdiff_t>(i); };
    std::stable_sort(at(first), at(end), [](const auto & a, const auto & c) { return a.roughness < c.roughness; });
    const std::size_t   last = first + (end - first + 1) / 2;
    const double        excess = MedianOf(squares, first, last, &RejectionTile::excess);
    std::vector<double> distance;
    for (std::size_t i = first; i < last; ++i)
    {
      distance.push_back(std::abs(squares[i].excess - excess));
    }
    // 1.5 median deviations are a standard deviation; a median has 1.25 times the standard error of a mean.
    const double error = 1.25 * 1.5 * Quantile(distance, 0.5) / std::sqrt(static_cast<double>(last - first));
    deviates = deviates || std::abs(excess) > InPixels.leastDeviation + Significance.hint * error;
    const double level = MedianOf(squares, first, last, &RejectionTile::level);
    if (model.levels.empty() || level > model.levels.back())
    {
      model.levels.push_back(level);
      model.ratios.push_back(std::max(InCommon.leastVarianceRatio, 1.0 + excess));
    }
  }
  if (deviates)
  {
    const std::size_t dark = std::max(InPixels.tilesPerLevel, squares.size() / InPixels.darkTilesOneIn);
    model.line.noiseDispersionDn4 = std::max(0.0, MedianOf(squares, 0, dark, &RejectionTile::spread));
  }
  else
  {
    model.levels.clear();
    model.ratios.clear();
  }
  return model;
}

} // namespace sensornoise
