// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/moments/StackMaps.h"

#include "sensornoise/base/ForAll.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/moments/CodeRange.h"
#include "sensornoise/moments/CodeSettings.h"
#include "sensornoise/moments/Codes.h"
#include "sensornoise/moments/Constants.h"
#include "sensornoise/moments/FloatingLevels.h"
#include "sensornoise/moments/OutermostLevels.h"
#include "sensornoise/moments/PileUp.h"
#include "sensornoise/moments/StackEnds.h"
#include "sensornoise/moments/TemporalMaps.h"
#include "sensornoise/moments/TemporalMoments.h"

#include <algorithm>
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

/** The median temporal variance [DN^2] of the pixels that vary: some thousand, evenly spread, tell the typical noise.
 * Pixels that a clip level holds fast do not vary, and may be most of them. */
template <typename TPixel>
double
TypicalVariance(const TemporalMaps<TPixel> & maps)
{
  const std::size_t   pixels = maps.GetNumberOfPixels();
  std::vector<double> variances;
  for (std::size_t p = 0; p < pixels; p += std::max<std::size_t>(1, pixels / 8192))
  {
    if (maps.IsFinite(p) && maps.variance[p] > 0.0)
    {
      variances.push_back(maps.variance[p]);
    }
  }
  return variances.empty() ? 0.0 : Quantile(variances, 0.5);
}

/** The codes of an integer stack, from every pixel's extremes. */
template <typename TPixel>
CodeRange
FindCodesOfIntegers(const TemporalMaps<TPixel> & maps,
                    const StackEnds &            ends,
                    const CodeSettings &         settings,
                    const ParallelFor &          parallelFor)
{
  CodeHistogram minima;
  CodeHistogram maxima;
  ExtremeDepths depths;
  ForAll(2, parallelFor, [&](std::size_t isHigh) {
    CodeHistogram & extremes = isHigh == 1 ? maxima : minima;
    for (std::size_t p = 0; p < maps.GetNumberOfPixels(); ++p)
    {
      extremes.Add(isHigh == 1 ? maps.GetMaximum(p) : maps.GetMinimum(p));
    }
    const auto end = isHigh == 1 ? OutermostLevels::End::High : OutermostLevels::End::Low;
    (isHigh == 1 ? depths.high : depths.low) = MedianDepth(maps, end, isHigh == 1 ? ends.high : ends.low);
  });
  CodeRange codes = FindCodes(minima, maxima, TypicalVariance(maps), settings, depths);
  // A signed 16-bit number ends at 32767, whatever 16 bits would hold.
  const double largest = std::numeric_limits<TPixel>::max();
  codes.clipHighDn = std::min(codes.clipHighDn.value_or(largest), largest);
  return codes;
}

/** The clip levels of a floating-point stack, from every finite pixel's extremes. */
template <typename TPixel>
CodeRange
FindLevelsOfFloating(const TemporalMaps<TPixel> & maps,
                     const StackEnds &            ends,
                     const CodeSettings &         settings,
                     const ParallelFor &          parallelFor)
{
  // An end with fewer pixels, as nearly always without a clip level, needs no second look.
  OutermostLevels minima(OutermostLevels::End::Low);
  OutermostLevels maxima(OutermostLevels::End::High);
  ExtremeDepths   depths;
  parallelFor(2, [&](std::size_t isHigh) {
    const auto       end = isHigh == 1 ? OutermostLevels::End::High : OutermostLevels::End::Low;
    const StackEnd & level = isHigh == 1 ? ends.high : ends.low;
    if (level.pixels >= InMoments.fewestPixelsOfPileUp)
    {
      (isHigh == 1 ? maxima : minima) = LevelsAt(end, maps);
      (isHigh == 1 ? depths.high : depths.low) = MedianDepth(maps, end, level);
    }
  });
  return FindLevels(minima, maxima, TypicalVariance(maps), settings, depths);
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

template <typename TPixel>
StackSummary
SummariseStack(const TemporalMaps<TPixel> & maps,
               const CodeSettings &         settings,
               const ParallelFor &          parallelFor,
               std::uint8_t *               valid)
{
  const std::size_t pixels = maps.GetNumberOfPixels();
  const StackEnds   ends = FindEnds(maps, parallelFor);
  StackSummary      summary;
  if constexpr (std::is_integral_v<TPixel>)
  {
    summary.codes = FindCodesOfIntegers(maps, ends, settings, parallelFor);
  }
  else
  {
    summary.codes = FindLevelsOfFloating(maps, ends, settings, parallelFor);
  }

  std::vector<StackSummary> counts((pixels + PixelsPerBlock - 1) / PixelsPerBlock);
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    StackSummary & count = counts[begin / PixelsPerBlock];
    for (std::size_t p = begin; p < end; ++p)
    {
      const bool finite = maps.IsFinite(p);
      const bool clipped = finite && summary.codes.IsClipped(maps.GetMinimum(p), maps.GetMaximum(p));
      valid[p] = finite && !clipped ? 1 : 0;
      count.clipped += clipped ? 1 : 0;
      count.notFinite += finite ? 0 : 1;
    }
  });
  for (const StackSummary & count : counts)
  {
    summary.clipped += count.clipped;
    summary.notFinite += count.notFinite;
  }
  return summary;
}

template <typename TPixel>
StackMaps
MakeStackMaps(TemporalMoments<TPixel> moments, const CodeSettings & settings, const ParallelFor & parallelFor)
{
  TemporalMaps<TPixel> ofStack = moments.TakeMaps(parallelFor);
  StackMaps            maps;
  maps.valid.resize(ofStack.GetNumberOfPixels());
  maps.summary = SummariseStack(ofStack, settings, parallelFor, maps.valid.data());
  maps.mean = std::move(ofStack.mean);
  maps.variance = std::move(ofStack.variance);
  return maps;
}

template SensorNoise_EXPORT StackSummary
SummariseStack<unsigned char>(const TemporalMaps<unsigned char> &,
                              const CodeSettings &,
                              const ParallelFor &,
                              std::uint8_t *);
template SensorNoise_EXPORT StackSummary
SummariseStack<unsigned short>(const TemporalMaps<unsigned short> &,
                               const CodeSettings &,
                               const ParallelFor &,
                               std::uint8_t *);
template SensorNoise_EXPORT StackSummary
SummariseStack<short>(const TemporalMaps<short> &, const CodeSettings &, const ParallelFor &, std::uint8_t *);
template SensorNoise_EXPORT StackSummary
SummariseStack<float>(const TemporalMaps<float> &, const CodeSettings &, const ParallelFor &, std::uint8_t *);
template SensorNoise_EXPORT StackSummary
SummariseStack<double>(const TemporalMaps<double> &, const CodeSettings &, const ParallelFor &, std::uint8_t *);

template SensorNoise_EXPORT StackMaps
MakeStackMaps<unsigned char>(TemporalMoments<unsigned char>, const CodeSettings &, const ParallelFor &);
template SensorNoise_EXPORT StackMaps
MakeStackMaps<unsigned short>(TemporalMoments<unsigned short>, const CodeSettings &, const ParallelFor &);
template SensorNoise_EXPORT StackMaps
MakeStackMaps<short>(TemporalMoments<short>, const CodeSettings &, const ParallelFor &);
template SensorNoise_EXPORT StackMaps
MakeStackMaps<float>(TemporalMoments<float>, const CodeSettings &, const ParallelFor &);
template SensorNoise_EXPORT StackMaps
MakeStackMaps<double>(TemporalMoments<double>, const CodeSettings &, const ParallelFor &);

} // namespace sensornoise
