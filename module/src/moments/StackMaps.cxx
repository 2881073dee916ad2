// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMaps.h"

#include "base/ParallelWork.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/FrameGeometry.h"
#include "base/Quantiles.h"
#include "sensornoise/StepResults.h"
#include "sensornoise/Settings.h"
#include "moments/Constants.h"
#include "moments/TemporalMoments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** The highest or the lowest value of a stack, and the number of pixels whose extreme over time it is. */
struct StackEnd
{
  double      outwards{ -std::numeric_limits<double>::infinity() }; ///< the highest value, or minus the lowest [DN]
  std::size_t pixels{ 0 };

  void
  Add(double otherOutwards, std::size_t otherPixels)
  {
    if (otherOutwards >= outwards)
    {
      pixels = otherPixels + (otherOutwards == outwards ? pixels : 0);
      outwards = otherOutwards;
    }
  }
};

/** Lowest and highest levels of a stack, over the finite pixels. The order in which pixels are added has no effect. */
struct StackEnds
{
  StackEnd low;
  StackEnd high;
  bool     areWhole{ true }; ///< all extremes are whole numbers that DnHistogram has room for

  /** Adds the pixels [begin, end). */
  template <typename TPixel>
  void
  AddPixels(const TemporalMaps<TPixel> & maps, std::size_t begin, std::size_t end)
  {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (maps.IsMeasured(p))
      {
        low.Add(-maps.GetMinimum(p), 1);
        high.Add(maps.GetMaximum(p), 1);
        areWhole = areWhole && DnHistogram::Accepts(maps.GetMinimum(p)) && DnHistogram::Accepts(maps.GetMaximum(p));
      }
    }
  }

  void
  Add(const StackEnds & other)
  {
    low.Add(other.low.outwards, other.low.pixels);
    high.Add(other.high.outwards, other.high.pixels);
    areWhole = areWhole && other.areWhole;
  }
};

/** Returns the distance of the end \a level of a stack from the mean of the pixels that attain it, see ExtremeDepths.
 */
template <typename TPixel>
double
MedianDepth(const TemporalMaps<TPixel> & maps, OutermostLevels::End end, const StackEnd & level)
{
  const bool          isHigh = end == OutermostLevels::End::High;
  std::vector<double> depths;
  for (std::size_t p = 0; p < maps.GetNumberOfPixels(); ++p)
  {
    if (level.outwards == (isHigh ? maps.GetMaximum(p) : -maps.GetMinimum(p)) && maps.IsMeasured(p))
    {
      const double distanceDn = level.outwards - (isHigh ? maps.mean[p] : -maps.mean[p]);
      depths.push_back(maps.variance[p] > 0.0 ? distanceDn / std::sqrt(maps.variance[p]) : 0.0);
    }
  }
  return Quantile(depths, 0.5);
}

/** Returns the levels next to an end of a stack. */
template <typename TPixel>
OutermostLevels
LevelsAt(OutermostLevels::End end, const TemporalMaps<TPixel> & maps)
{
  OutermostLevels levels(end);
  const auto      add = [&](std::size_t p) {
    if (maps.IsMeasured(p))
    {
      levels.Add(end == OutermostLevels::End::High ? maps.GetMaximum(p) : maps.GetMinimum(p));
    }
  };
  // Pixels from the whole frame come first: most of the others are then rejected at once, because they lie inside of
  // the levels kept.
  const std::size_t pixels = maps.GetNumberOfPixels();
  const std::size_t stride = std::max<std::size_t>(1, pixels / 8192);
  for (std::size_t first = 0; first < pixels; first += stride)
  {
    add(first);
  }
  for (std::size_t first = 0; first < pixels; first += stride)
  {
    for (std::size_t p = first + 1; p < std::min(first + stride, pixels); ++p)
    {
      add(p);
    }
  }
  return levels;
}

/** Returns the median temporal variance of the pixels that vary [DN^2], from a sample of some thousand evenly spaced
 * pixels. Clipped pixels do not vary, and may be the majority. */
template <typename TPixel>
double
TypicalVariance(const TemporalMaps<TPixel> & maps)
{
  const std::size_t   pixels = maps.GetNumberOfPixels();
  std::vector<double> variances;
  for (std::size_t p = 0; p < pixels; p += std::max<std::size_t>(1, pixels / 8192))
  {
    if (maps.IsMeasured(p) && maps.variance[p] > 0.0)
    {
      variances.push_back(maps.variance[p]);
    }
  }
  return variances.empty() ? 0.0 : Quantile(variances, 0.5);
}

/** Finds the digital numbers of a stack of integers, from the extremes of every finite pixel. */
template <typename TPixel>
DnRange
FindDnRangeOfIntegers(const TemporalMaps<TPixel> & maps, const DnSettings & settings, const ParallelFor & parallelFor)
{
  DnHistogram   minima;
  DnHistogram   maxima;
  ExtremeDepths depths;
  ForAll(2, parallelFor, [&](std::size_t isHigh) {
    DnHistogram & extremes = isHigh == 1 ? maxima : minima;
    for (std::size_t p = 0; p < maps.GetNumberOfPixels(); ++p)
    {
      if (maps.IsMeasured(p))
      {
        extremes.Add(isHigh == 1 ? maps.GetMaximum(p) : maps.GetMinimum(p));
      }
    }
  });
  const double spacingDn = FindSpacingDn(minima, maxima, settings);
  ForAll(2, parallelFor, [&](std::size_t isHigh) {
    const auto   end = isHigh == 1 ? OutermostLevels::End::High : OutermostLevels::End::Low;
    const double level = FindEndOfDnRange(isHigh == 1 ? maxima : minima, isHigh == 1, spacingDn);
    (isHigh == 1 ? depths.high : depths.low) = MedianDepth(maps, end, { isHigh == 1 ? level : -level, 0 });
  });
  DnRange dnRange = FindDnRange(minima, maxima, TypicalVariance(maps), settings, depths);
  if (!settings.clipLowDn && dnRange.clipLowDn == 0.0 && minima.Count(0) > 0 &&
      AreCountsFromZero(maps, std::max(1.0, dnRange.quantisationStepDn)))
  {
    // Counts have no value below 0, so that none is clipped there, and counts are not rounded.
    dnRange.clipLowDn.reset();
    dnRange.SetClipSources("none", dnRange.clipSource == "code range" ? "code range" : "pile-up");
    dnRange.quantisationStepDn = settings.quantisationStepDn.value_or(0.0);
  }
  // A signed 16-bit number ends at 32767, for any bit depth.
  const double largest = std::numeric_limits<TPixel>::max();
  dnRange.clipHighDn = std::min(dnRange.clipHighDn.value_or(largest), largest);
  return dnRange;
}

/** Returns the spacing of the levels of a floating-point stack whose digital numbers were multiplied by one number
 * [DN]; 0: there is none. It is found if all of some thousand minima of pixels lie on one grid. A grid that is not much
 * wider than the last digits of the type is the grid of the type itself. */
template <typename TPixel>
double
FindStepOfFloating(const TemporalMaps<TPixel> & maps)
{
  const std::size_t   pixels = maps.GetNumberOfPixels();
  std::vector<double> levels;
  for (std::size_t p = 0; p < pixels; p += std::max<std::size_t>(1, pixels / 8192))
  {
    if (maps.IsMeasured(p))
    {
      levels.push_back(maps.GetMinimum(p));
    }
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  if (levels.size() < InMoments.fewestLevelsOfGrid)
  {
    return 0.0;
  }
  const double digits = std::numeric_limits<TPixel>::epsilon() * std::max(std::abs(levels.front()), levels.back());
  const double range = levels.back() - levels.front();
  std::vector<double> spacings; // larger than the rounding of the levels
  for (std::size_t i = 1; i < levels.size(); ++i)
  {
    const double spacing = levels[i] - levels[i - 1];
    if (spacing > InMoments.leastStepInDigits * digits)
    {
      spacings.push_back(spacing);
    }
  }
  if (spacings.size() + 1 < InMoments.fewestLevelsOfGrid)
  {
    return 0.0;
  }
  const double least = *std::min_element(spacings.begin(), spacings.end());
  double       steps = 0.0; // counted from level to level, because the digits round the smallest spacing
  for (const double spacing : spacings)
  {
    steps += std::round(spacing / least);
  }
  const double step = range / steps;
  const bool   isGrid = std::all_of(levels.begin(), levels.end(), [&](double level) {
    const double places = (level - levels.front()) / step;
    return std::abs(places - std::round(places)) < InMoments.largestOffGrid;
  });
  return isGrid ? step : 0.0;
}

/** Finds the clip levels of a floating-point stack, from the extremes of every finite pixel. */
template <typename TPixel>
DnRange
FindLevelsOfFloating(const TemporalMaps<TPixel> & maps, const DnSettings & settings, const ParallelFor & parallelFor)
{
  const double    stepDn = settings.quantisationStepDn.value_or(FindStepOfFloating(maps));
  OutermostLevels minima(OutermostLevels::End::Low);
  OutermostLevels maxima(OutermostLevels::End::High);
  ExtremeDepths   depths;
  parallelFor(2, [&](std::size_t isHigh) {
    const auto        end = isHigh == 1 ? OutermostLevels::End::High : OutermostLevels::End::Low;
    OutermostLevels & levels = isHigh == 1 ? maxima : minima;
    levels = LevelsAt(end, maps);
    levels.LeaveOutStray(stepDn > 0.0 ? stepDn : levels.Step());
    if (levels.Pixels() >= InMoments.fewestPixelsOfClipLevel)
    {
      const double outwards = isHigh == 1 ? levels.Level() : -levels.Level();
      (isHigh == 1 ? depths.high : depths.low) = MedianDepth(maps, end, { outwards, levels.Pixels() });
    }
  });
  DnRange range = FindLevels(minima, maxima, TypicalVariance(maps), settings, depths);
  range.quantisationStepDn = stepDn;
  return range;
}

template <typename TPixel>
StackEnds
FindEnds(const TemporalMaps<TPixel> & maps, const ParallelFor & parallelFor)
{
  const std::size_t      pixels = maps.GetNumberOfPixels();
  std::vector<StackEnds> blocks((pixels + PixelsPerBlock - 1) / PixelsPerBlock);
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    StackEnds block;
    block.AddPixels(maps, begin, end);
    blocks[begin / PixelsPerBlock] = block;
  });
  StackEnds ends;
  for (const StackEnds & block : blocks)
  {
    ends.Add(block);
  }
  return ends;
}

} // namespace

DnRange
StackSummary::AttainedRange() const
{
  DnRange attained = dnRange;
  attained.clipLowDn = clippedLow > 0 ? dnRange.clipLowDn : std::nullopt;
  attained.clipHighDn = clippedHigh > 0 ? dnRange.clipHighDn : std::nullopt;
  return attained;
}

template <typename TPixel>
StackSummary
SummariseStack(const TemporalMaps<TPixel> & maps,
               const DnSettings &           settings,
               const ParallelFor &          parallelFor,
               std::uint8_t *               valid)
{
  const std::size_t pixels = maps.GetNumberOfPixels();
  const StackEnds   ends = FindEnds(maps, parallelFor);
  StackSummary      summary;
  // Integers are digital numbers, even if they are stored as floating-point numbers.
  const bool areIntegers = std::is_integral_v<TPixel> || (ends.high.pixels > 0 && ends.areWhole);
  summary.dnRange = areIntegers ? FindDnRangeOfIntegers(maps, settings, parallelFor)
                                : FindLevelsOfFloating(maps, settings, parallelFor);

  std::vector<StackSummary> counts((pixels + PixelsPerBlock - 1) / PixelsPerBlock);
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    StackSummary & count = counts[begin / PixelsPerBlock];
    for (std::size_t p = begin; p < end; ++p)
    {
      const bool        finite = maps.IsFinite(p);
      const bool        isLow = finite && summary.dnRange.IsClippedLow(maps.GetMinimum(p));
      const bool        isHigh = finite && summary.dnRange.IsClippedHigh(maps.GetMaximum(p));
      const std::size_t one = maps.mask == nullptr || maps.mask[p] != 0 ? 1 : 0;
      valid[p] = finite && !isLow && !isHigh ? 1 : 0;
      count.clipped += isLow || isHigh ? one : 0;
      count.clippedLow += isLow ? one : 0;
      count.clippedHigh += isHigh ? one : 0;
      count.notFinite += finite ? 0 : one;
    }
  });
  for (const StackSummary & count : counts)
  {
    summary.clipped += count.clipped;
    summary.clippedLow += count.clippedLow;
    summary.clippedHigh += count.clippedHigh;
    summary.notFinite += count.notFinite;
  }
  return summary;
}

namespace
{
/** Pixels around a pixel of \a maps, which is not at the border. */
template <typename TPixel>
class Surroundings
{
public:
  Surroundings(const TemporalMaps<TPixel> & maps, std::size_t width, std::size_t p)
    : m_Maps(maps)
  {
    std::size_t i = 0;
    for (const std::size_t row : { p - width, p, p + width })
    {
      for (const std::size_t own : { row - 1, row, row + 1 })
      {
        if (own != p)
        {
          m_Pixels[i++] = own;
        }
      }
    }
  }

  /** Returns the median of a number of the pixels, of the finite ones; NaN: none is finite. */
  template <typename TNumberOf>
  double
  MedianOf(TNumberOf numberOf) const
  {
    std::vector<double> numbers;
    for (const std::size_t p : m_Pixels)
    {
      if (m_Maps.IsFinite(p))
      {
        numbers.push_back(numberOf(p));
      }
    }
    return numbers.empty() ? std::numeric_limits<double>::quiet_NaN() : Quantile(numbers, 0.5);
  }

private:
  const TemporalMaps<TPixel> & m_Maps;
  std::array<std::size_t, 8>   m_Pixels{};
};

/** Returns whether one value of pixel \a p moves the means of the neighbours by more than their noise, see
 * MakeStackMaps(). \a frames is 3 or more. */
template <typename TPixel>
bool
MovesNeighbours(const TemporalMaps<TPixel> & maps, double frames, std::size_t width, std::size_t p)
{
  const double above = maps.GetMaximum(p) - maps.mean[p];
  const double below = maps.mean[p] - maps.GetMinimum(p);
  const bool   isHigh = above > below;
  const double distance = std::max(above, below);
  // An eighth of the mean of the pixel is in the mean of its neighbour.
  const double noise = distance / (8.0 * frames);
  const double others = (frames - 1.0) * maps.variance[p] - distance * distance * frames / (frames - 1.0);
  if (!(noise * noise * (frames - 2.0) > others))
  {
    return false;
  }
  const Surroundings<TPixel> around(maps, width, p);
  const double               varianceOfThese = around.MedianOf([&](std::size_t q) { return maps.variance[q]; });
  const double               extremeOfThese =
    around.MedianOf([&](std::size_t q) { return isHigh ? maps.GetMaximum(q) : -maps.GetMinimum(q); });
  const double beyond = (isHigh ? maps.GetMaximum(p) : -maps.GetMinimum(p)) - extremeOfThese;
  return noise * noise > varianceOfThese && beyond > 8.0 * frames * std::sqrt(varianceOfThese);
}

/** Takes the pixels that are not measured out of the means, see MakeStackMaps(). */
template <typename TPixel>
void
ReplaceSpikes(TemporalMaps<TPixel> & maps, std::size_t frames, std::size_t width, const ParallelFor & parallelFor)
{
  const std::size_t height = width > 0 ? maps.GetNumberOfPixels() / width : 0;
  if (frames < 3 || height < 3)
  {
    return;
  }
  std::vector<std::vector<std::pair<std::size_t, double>>> ofRows(height); // pixels, and the means of their neighbours
  parallelFor(height - 2, [&](std::size_t inner) {
    const std::size_t y = inner + 1;
    for (std::size_t p = y * width + 1; p + 1 < (y + 1) * width; ++p)
    {
      if (maps.IsFinite(p) && MovesNeighbours(maps, static_cast<double>(frames), width, p))
      {
        const Surroundings<TPixel> around(maps, width, p);
        ofRows[y].emplace_back(p, around.MedianOf([&](std::size_t q) { return maps.mean[q]; }));
      }
    }
  });
  for (const auto & row : ofRows)
  {
    for (const auto & [p, mean] : row)
    {
      maps.mean[p] = mean;
      maps.variance[p] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}
} // namespace

template <typename TPixel>
StackMaps
MakeStackMaps(TemporalMoments<TPixel>           moments,
              const DnSettings &                settings,
              const ParallelFor &               parallelFor,
              const std::vector<std::uint8_t> & mask,
              std::size_t                       width)
{
  const std::size_t    frames = moments.GetNumberOfFrames();
  TemporalMaps<TPixel> ofStack = moments.TakeMaps(parallelFor);
  StackMaps            maps;
  const bool           hasMeasured = std::any_of(mask.begin(), mask.end(), [](std::uint8_t own) { return own != 0; });
  ofStack.mask = hasMeasured ? mask.data() : nullptr; // without any, the report says what the whole frames are
  maps.valid.resize(ofStack.GetNumberOfPixels());
  maps.summary = SummariseStack(ofStack, settings, parallelFor, maps.valid.data());
  if constexpr (std::is_floating_point_v<TPixel>)
  {
    ReplaceSpikes(ofStack, frames, width, parallelFor);
  }
  maps.mean = std::move(ofStack.mean);
  maps.variance = std::move(ofStack.variance);
  return maps;
}

#define SensorNoise_INSTANTIATE(TPixel)                            \
  template SensorNoise_EXPORT StackSummary SummariseStack<TPixel>( \
    const TemporalMaps<TPixel> &, const DnSettings &, const ParallelFor &, std::uint8_t *)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

#define SensorNoise_INSTANTIATE(TPixel)                        \
  template SensorNoise_EXPORT StackMaps MakeStackMaps<TPixel>( \
    TemporalMoments<TPixel>, const DnSettings &, const ParallelFor &, const std::vector<std::uint8_t> &, std::size_t)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
