// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/ImageNoise.h"

#include "base/NothingToMeasure.h"
#include "base/Quantiles.h"
#include "base/Text.h"
#include "moments/StackMaps.h"
#include "single/Constants.h"
#include "single/LevelSums.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

namespace sensornoise
{
namespace
{
/** Positions of a tile along x and y. Chosen for the caches: a tile and its surroundings take 250 kB. */
constexpr std::size_t TileWidth = 128;
constexpr std::size_t TileHeight = 64;

/** Pixels by which scale and digital numbers are found, at most. Chosen for the time: 4 % of a frame of 24 megapixels.
 */
constexpr std::size_t MostSampledPixels = std::size_t{ 1 } << 20;

/** The tiles that cover all positions of a plane. */
class PlaneTiles
{
public:
  PlaneTiles(std::size_t width, std::size_t height)
    : m_Columns(width)
    , m_Rows(height)
  {}
  std::size_t
  Size() const
  {
    return this->Along(m_Columns, TileWidth) * this->Along(m_Rows, TileHeight);
  }
  TileOfPositions
  At(std::size_t k) const
  {
    const std::size_t across = this->Along(m_Columns, TileWidth);
    const std::size_t x = k % across * TileWidth;
    const std::size_t y = k / across * TileHeight;
    return { x, y, std::min(TileWidth, m_Columns - x), std::min(TileHeight, m_Rows - y) };
  }

private:
  static std::size_t
  Along(std::size_t positions, std::size_t size)
  {
    return (positions + size - 1) / size;
  }

  std::size_t m_Columns;
  std::size_t m_Rows;
};

/** Calls function(value) for pixels of evenly spread rows that are finite and not masked. */
template <typename TPixel, typename TFunction>
void
ForSampledPixels(const PlaneOfFrame<TPixel> & plane, TFunction function)
{
  const std::size_t width = plane.layout.width;
  const std::size_t rows =
    std::clamp<std::size_t>(MostSampledPixels / std::max<std::size_t>(1, width), 1, plane.height);
  for (std::size_t k = 0; k < rows; ++k)
  {
    const std::size_t y = k * plane.height / rows;
    for (std::size_t x = 0; x < width; ++x)
    {
      const std::size_t at = plane.layout.At(x, y);
      const auto        value = static_cast<double>(plane.pixels[at]);
      if ((plane.mask == nullptr || plane.mask[at] != 0) && std::isfinite(value))
      {
        function(value);
      }
    }
  }
}

/** A frame with the unit of its levels: the range of nearly all of its pixels. */
template <typename TPixel>
SingleFrame<TPixel>
ScaleFrame(const PlaneOfFrame<TPixel> & plane)
{
  constexpr double    outermost = 0.002; // fraction of the pixels beyond an end: defects do not set the unit
  std::vector<double> values;
  ForSampledPixels(plane, [&values](double value) { values.push_back(value); });
  if (values.empty())
  {
    throw NothingToMeasure("no pixel is finite and inside of the mask. Give other frames, or another mask");
  }
  const double low = Quantile(values, outermost);
  const double high = Quantile(values, 1.0 - outermost);
  if (!(high > low))
  {
    throw NothingToMeasure("nearly all pixels have the level " + Rounded(low) +
                           " DN. Record a frame between the clip levels, with dark and bright areas");
  }
  return { plane.pixels, plane.layout, plane.height, plane.mask, low, high - low };
}

template <typename TPixel>
PlaneTiles
TilesOf(const PlaneOfFrame<TPixel> & plane)
{
  const std::size_t columns = SingleFrame<TPixel>::PositionsAlong(plane.layout.width);
  const std::size_t rows = SingleFrame<TPixel>::PositionsAlong(plane.height);
  if (columns == 0 || rows == 0)
  {
    throw NothingToMeasure("the frame has " + std::to_string(plane.layout.width) + " x " +
                           std::to_string(plane.height) +
                           " pixels; expected at least 24 x 24 (48 x 48 of a mosaic). Give a larger part of "
                           "the frame");
  }
  return { columns, rows };
}

template <typename TPixel>
std::vector<BandTile>
MakeSample(const SingleFrame<TPixel> & frame, const PlaneTiles & tiles, const ParallelFor & parallelFor)
{
  const std::size_t     most = InSingle.samplePositions / (TileWidth * TileHeight);
  const std::size_t     size = std::min(most, tiles.Size());
  std::vector<BandTile> sample(size);
  parallelFor(size,
              [&](std::size_t k) { sample[k].Compute(frame, tiles.At((2 * k + 1) * tiles.Size() / (2 * size))); });
  return sample;
}

StartingGroups
RequireGroups(const std::vector<BandTile> & sample)
{
  StartingGroups groups = MakeStartingGroups(sample);
  if (groups.groups.empty() || !(groups.high > groups.low))
  {
    throw NothingToMeasure(
      "too few windows of 24 x 24 pixels are finite and of different levels. Give a larger part of "
      "the frame, or another mask");
  }
  return groups;
}

/** The smallest variance that frames of these levels can show [DN^2], by quantization, else by rounding. */
double
LeastVariance(const LevelLimits & limits, double unitDn)
{
  constexpr double rounding = 1e-12; // fraction of the squared range: 24 bits of a float, squared, with a margin
  return std::max(limits.stepDn * limits.stepDn / 12.0, rounding * unitDn * unitDn);
}

/** Makes the grid of a line, with no variance below \a leastDn2. */
LevelGrid
MakeGrid(const StartingGroups & groups,
         const CentredLine &    line,
         const LevelLimits &    limits,
         double                 leastDn2,
         double                 originDn,
         double                 unitDn)
{
  LevelGrid grid;
  grid.low = groups.low;
  grid.perLevel = static_cast<double>(InSingle.levelSets) / (groups.high - groups.low);
  grid.variance.resize(InSingle.levelSets);
  for (std::size_t k = 0; k < grid.variance.size(); ++k)
  {
    const double levelDn = originDn + unitDn * grid.CentreOf(k);
    grid.variance[k] =
      static_cast<float>(ClippedAtMean(levelDn, line, limits.clip, leastDn2).varianceDn2 / (unitDn * unitDn));
  }
  return grid;
}

/** Returns the sums over the tiles of a sample: LevelSums or DetailCorrelation. */
template <typename TSums>
TSums
SumSample(const std::vector<BandTile> & sample, const LevelGrid & grid, const ParallelFor & parallelFor)
{
  std::vector<TSums> parts(sample.size());
  parallelFor(sample.size(), [&](std::size_t k) { parts[k].Add(sample[k], grid); });
  TSums sums;
  for (const TSums & part : parts)
  {
    sums.Add(part);
  }
  return sums;
}

template <typename TPixel>
LevelSums
SumFrame(const SingleFrame<TPixel> & frame,
         const PlaneTiles &          tiles,
         const LevelGrid &           grid,
         const ParallelFor &         parallelFor)
{
  // Each strand of tiles allocates its memory once.
  constexpr std::size_t  perStrand = 8;
  const std::size_t      size = tiles.Size();
  std::vector<LevelSums> parts((size + perStrand - 1) / perStrand);
  parallelFor(parts.size(), [&](std::size_t strand) {
    BandTile tile;
    for (std::size_t k = strand * perStrand; k < std::min(size, (strand + 1) * perStrand); ++k)
    {
      tile.Compute(frame, tiles.At(k));
      parts[strand].Add(tile, grid);
    }
  });
  LevelSums sums;
  for (const LevelSums & part : parts)
  {
    sums.Add(part);
  }
  return sums;
}
} // namespace

LevelLimits
LimitsOf(const DnRange & dnRange)
{
  LevelLimits limits;
  limits.clip.lowDn = dnRange.clipLowDn.value_or(limits.clip.lowDn);
  limits.clip.highDn = dnRange.clipHighDn.value_or(limits.clip.highDn);
  limits.stepDn = dnRange.quantisationStepDn;
  return limits;
}

template <typename TPixel>
DnRange
FindDnRangeOfFrame(const PlaneOfFrame<TPixel> & plane, const DnSettings & settings, const ParallelFor & parallelFor)
{
  const PlaneTiles          tiles = TilesOf(plane);
  const SingleFrame<TPixel> frame = ScaleFrame(plane);
  const StartingGroups      groups = RequireGroups(MakeSample(frame, tiles, parallelFor));
  const double              typicalDn2 = frame.unitDn * frame.unitDn * groups.medianVariance;
  if constexpr (std::is_integral_v<TPixel>)
  {
    DnHistogram histogram;
    ForSampledPixels(plane, [&](double value) { histogram.Add(value); });
    return FindDnRange(histogram, histogram, typicalDn2, settings);
  }
  else
  {
    OutermostLevels minima(OutermostLevels::End::Low);
    OutermostLevels maxima(OutermostLevels::End::High);
    ForSampledPixels(plane, [&](double value) {
      minima.Add(value);
      maxima.Add(value);
    });
    return FindLevels(minima, maxima, typicalDn2, settings);
  }
}

template <typename TPixel>
ImageNoise
MeasureFrame(const PlaneOfFrame<TPixel> & plane, const LevelLimits & limits, const ParallelFor & parallelFor)
{
  const PlaneTiles            tiles = TilesOf(plane);
  const SingleFrame<TPixel>   frame = ScaleFrame(plane);
  const std::vector<BandTile> sample = MakeSample(frame, tiles, parallelFor);
  const StartingGroups        groups = RequireGroups(sample);
  const double                leastDn2 = LeastVariance(limits, frame.unitDn);
  const double                medianDn2 = groups.medianVariance * frame.unitDn * frame.unitDn;
  CentredLine                 line = FitStartingLine(groups, limits, frame.originDn, frame.unitDn);
  const auto                  gridOf = [&](double atLeastDn2) {
    return MakeGrid(groups, line, limits, std::max(leastDn2, atLeastDn2), frame.originDn, frame.unitDn);
  };
  const auto setsOf = [&](const LevelSums & sums, const LevelGrid & grid, DetailBand band) {
    return MakeLevelSets(sums, grid, band, frame.originDn, frame.unitDn);
  };
  LevelGrid grid = gridOf(InSingle.leastStartingVariance * medianDn2);
  for (int i = 0; i < InCommon.roundsOfFit; ++i)
  {
    const LevelSums sums = SumSample<LevelSums>(sample, grid, parallelFor);
    const NoiseLine fit = FitNoiseLine(setsOf(sums, grid, DetailBand::Diagonal), limits.clip, leastDn2, line);
    if (!fit.isDetermined)
    {
      break;
    }
    line = fit.line;
    grid = gridOf(0.0);
  }
  const LevelSums sums = SumFrame(frame, tiles, grid, parallelFor);
  ImageNoise      noise;
  noise.correlation = SumSample<DetailCorrelation>(sample, grid, parallelFor);
  noise.diagonal = setsOf(sums, grid, DetailBand::Diagonal);
  noise.sides = setsOf(sums, grid, DetailBand::Sides);
  noise.line = FitNoiseLine(noise.diagonal, limits.clip, leastDn2, line);
  noise.finite = sums.finite;
  noise.even = sums.even;
  return noise;
}

#define SensorNoise_INSTANTIATE(TPixel)                                                                          \
  template DnRange    FindDnRangeOfFrame(const PlaneOfFrame<TPixel> &, const DnSettings &, const ParallelFor &); \
  template ImageNoise MeasureFrame(const PlaneOfFrame<TPixel> &, const LevelLimits &, const ParallelFor &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
