// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/StaticVariance.h"

#include "base/BoxSum.h"
#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/ParallelWork.h"
#include "base/Quantiles.h"
#include "base/Simd.h"
#include "moments/Constants.h"
#include "moments/DarkFrames.h"
#include "pixels/Constants.h"
#include "pixels/FixedPatternEstimate.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"
#include "sensornoise/Parallel.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
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
  double       excess[InPixels.tileSide]{};
  double       expected[InPixels.tileSide]{};
  double       chance[InPixels.tileSide]{};

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
    InMoments.defectiveNoiseFactor * InMoments.defectiveNoiseFactor * line.lowestDn2 / InCommon.lowestFraction;
  RejectionTile     square;
  double            total = 0.0;
  double            squares = 0.0;
  double            chance = 0.0;
  TileRow           row{ line };
  const std::size_t across = std::min(InPixels.tileSide, geometry.width - left);
  for (std::size_t y = top; y < std::min(top + InPixels.tileSide, geometry.height); ++y)
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
  const std::size_t          across = (geometry.width + InPixels.tileSide - 1) / InPixels.tileSide;
  const std::size_t          down = (geometry.height + InPixels.tileSide - 1) / InPixels.tileSide;
  std::vector<RejectionTile> squares(across * down);
  const std::size_t          oneIn = std::max<std::size_t>(1, squares.size() / InPixels.enoughRejectionTiles);
  parallelFor(down, [&](std::size_t row) {
    for (std::size_t column = row % oneIn; column < across; column += oneIn)
    {
      squares[row * across + column] =
        SumRejectionTile(line, data, projected, column * InPixels.tileSide, row * InPixels.tileSide);
    }
  });
  const auto isTooSmall = [](const RejectionTile & square) {
    return square.pixels < InCommon.leastCoveredFraction * (InPixels.tileSide * InPixels.tileSide);
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
  const std::size_t bins = std::min(InPixels.levelBins, squares.size() / InPixels.tilesPerLevel);
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

namespace
{
/** Fit of single pixels to the rejection model. */
struct PixelFits
{
  std::vector<float>         ratio; // variance over the model [1]; 0 outside the mask and at outliers
  std::vector<std::uint16_t> count; // 1: in the mask and no outlier; Rejected: outlier; 0: outside the mask

  /** More than the pixels of a neighbourhood, so that one sum counts both the pixels that fit and the outliers. */
  static constexpr std::uint16_t Rejected = 1024;
};

PixelFits
TestPixels(const ProjectedVariance &         projected,
           const RejectionModel &            line,
           const std::vector<std::uint8_t> & mask,
           const ParallelFor &               parallelFor)
{
  PixelFits fits{ MakeMap<float>(mask.size(), parallelFor), MakeMap<std::uint16_t>(mask.size(), parallelFor) };
  ForBlocks(mask.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    TestedRun run{};
    ForRuns(begin, end, [&](std::size_t first, std::size_t pixels) {
      CallWithAvx2([&, used = mask.data() + first, ratio = fits.ratio.data() + first] {
        run.Test(projected, line, first, pixels);
        for (std::size_t i = 0; i < pixels; ++i)
        {
          const auto own = static_cast<float>(run.ratio[i]);
          ratio[i] = used[i] != 0 && run.isAbove[i] == 0.0 ? own : 0.0F;
        }
      });
      for (std::size_t i = 0; i < pixels; ++i)
      {
        const int count = run.isAbove[i] == 0.0 ? 1 : PixelFits::Rejected;
        fits.count[first + i] = static_cast<std::uint16_t>(mask[first + i] != 0 ? count : 0);
      }
    });
  });
  return fits;
}

/** Returns a map that is 1 at pixels whose neighbourhood of the half width \a radius does not fit. */
std::vector<std::uint8_t>
FindRejectedCores(const ProjectedVariance & projected,
                  const RejectionModel &    line,
                  const PixelFits &         pixels,
                  std::size_t               radius,
                  const ParallelFor &       parallelFor)
{
  const double              side = 2.0 * static_cast<double>(radius) + 1.0;
  const double              area = side * side;
  const ReferenceFrame &    frame = projected.GetFrame();
  const std::size_t         width = frame.geometry.width;
  const std::size_t         height = frame.geometry.height;
  const auto                dof = static_cast<double>(frame.frames - 1 - projected.GetSquares().GetBasis().Size());
  std::vector<std::uint8_t> core(frame.mean.size());
  ForBoxBands(height, parallelFor, [&](std::size_t first, std::size_t last) {
    BoxRows ratios(RowsOf(pixels.ratio, width), width, height, radius, first, last);
    BoxRows counts(RowsOf(pixels.count, width), width, height, radius, first, last);
    for (std::size_t y = first; y < last; ++y)
    {
      const double * const sums = ratios.Next();
      const double * const counted = counts.Next();
      for (std::size_t x = 0; x < width; ++x)
      {
        const auto   both = static_cast<int>(counted[x]);
        const double crowd = both / PixelFits::Rejected;
        const double count = both % PixelFits::Rejected;
        const double excess = sums[x] / std::max(1.0, count) - 1.0;
        bool         isCore = crowd > InCommon.largestOutlierFraction * area;
        if (excess > InPixels.leastNeighbourhoodExcess && count > InPixels.leastCountedFraction * area)
        {
          const double level = frame.neighbourMean[y * width + x];
          const double own = line.EffectiveDof(dof * projected.DofFractionAtPixel(level), line.At(level));
          isCore = isCore || excess > Significance.manyTests * std::sqrt(2.0 * line.varianceInflation / (own * count));
        }
        core[y * width + x] = isCore ? 1 : 0;
      }
    }
  });
  return core;
}
} // namespace

std::vector<std::uint8_t>
RejectNeighbourhoods(const ProjectedVariance &         projected,
                     const RejectionModel &            line,
                     const std::vector<std::uint8_t> & mask,
                     const ParallelFor &               parallelFor)
{
  const std::size_t         radius = InPixels.neighbourhoodRadius;
  const std::size_t         width = projected.GetFrame().geometry.width;
  const std::size_t         height = projected.GetFrame().geometry.height;
  const PixelFits           pixels = TestPixels(projected, line, mask, parallelFor);
  std::vector<std::uint8_t> core = FindRejectedCores(projected, line, pixels, radius, parallelFor);
  if (std::find(core.begin(), core.end(), std::uint8_t{ 1 }) == core.end())
  {
    return core;
  }
  std::vector<std::uint8_t> rejected(mask.size());
  const auto                cores = [&] { return RowsOf(core, width); };
  ForBoxRows(cores, width, height, (2 * radius + 1) / 3, parallelFor, [&](std::size_t y, const double * near) {
    std::transform(near, near + width, rejected.data() + y * width, [](double count) {
      return static_cast<std::uint8_t>(count > 0.5);
    });
  });
  return rejected;
}

std::vector<std::uint8_t>
FindQuietPixels(const ProjectedVariance &         projected,
                const VarianceLine &              line,
                const std::vector<std::uint8_t> & mask,
                const ParallelFor &               parallelFor)
{
  const VarianceData  data = projected.GetData(mask);
  std::vector<double> levels = data.SampleLevels();
  if (levels.empty())
  {
    return {};
  }
  // No pixel has more signal than its level above the darkest one.
  const double darkestDn = QuantileOf(std::move(levels), InCommon.darkestQuantile);
  // The ratio that chance does not make is the larger, the more degrees of freedom there are.
  const double mostDof = static_cast<double>(projected.GetFrame().frames);
  const double byChance = 0.5 * std::erfc(Significance.severalTests / std::sqrt(2.0));
  const double largest = std::min(InPixels.largestQuietVariance, ChiSquareQuantile(byChance, mostDof) / mostDof);
  const auto   isQuiet = [&](std::size_t p) {
    const double level =
      std::min<double>(data.mean[p], data.neighbourMean[p]); // beside an edge, neighbours may be brighter
    const double shotDn2 = line.gain * (level - darkestDn);
    const double variance = data.variance[p];
    if (data.mask[p] == 0 || !(variance < largest * shotDn2))
    {
      return false;
    }
    const double dof = line.EffectiveDof(data.dof[p], line.At(level));
    return dof > 0.0 && ChiSquareCdf(dof * variance / shotDn2, dof) < byChance;
  };
  std::vector<std::uint8_t> quiet(data.pixels);
  ForPixels(data.pixels, parallelFor, [&](std::size_t p) { quiet[p] = isQuiet(p) ? 1 : 0; });
  const auto number = std::count(quiet.begin(), quiet.end(), std::uint8_t{ 1 });
  const auto used = std::count_if(mask.begin(), mask.end(), [](std::uint8_t own) { return own != 0; });
  const bool areFew = static_cast<double>(number) < InPixels.leastQuietFraction * static_cast<double>(used);
  return areFew ? std::vector<std::uint8_t>() : quiet;
}

} // namespace sensornoise
