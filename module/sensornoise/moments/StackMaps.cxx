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
#include "sensornoise/moments/FloatingMoments.h"
#include "sensornoise/moments/IntegerMoments.h"
#include "sensornoise/moments/OutermostLevels.h"
#include "sensornoise/moments/PileUp.h"
#include "sensornoise/moments/StackEnds.h"
#include "sensornoise/moments/TemporalMoments.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sensornoise
{

namespace
{

/** The median temporal variance [DN^2] of the pixels that vary: some thousand, evenly spread, tell the typical noise.
 * Pixels that a clip level holds fast do not vary, and may be most of them. */
template <typename TMoments>
double
TypicalVariance(const TMoments & moments, const double * variance)
{
  const std::size_t   pixels = moments.GetNumberOfPixels();
  std::vector<double> variances;
  for (std::size_t p = 0; p < pixels; p += std::max<std::size_t>(1, pixels / 8192))
  {
    if (moments.IsFinite(p) && variance[p] > 0.0)
    {
      variances.push_back(variance[p]);
    }
  }
  return variances.empty() ? 0.0 : Quantile(variances, 0.5);
}

/** The codes of an integer stack, from every pixel's extremes. */
template <typename TPixel>
CodeRange
FindCodesOfStack(const IntegerMoments<TPixel> & moments,
                 const StackEnds &              ends,
                 const CodeSettings &           settings,
                 const ParallelFor &            parallelFor,
                 const double *                 mean,
                 const double *                 variance)
{
  CodeHistogram minima;
  CodeHistogram maxima;
  ExtremeDepths depths;
  ForAll(2, parallelFor, [&](std::size_t isHigh) {
    CodeHistogram & extremes = isHigh == 1 ? maxima : minima;
    for (std::size_t p = 0; p < moments.GetNumberOfPixels(); ++p)
    {
      extremes.Add(isHigh == 1 ? moments.GetMaximum(p) : moments.GetMinimum(p));
    }
    const auto end = isHigh == 1 ? OutermostLevels::End::High : OutermostLevels::End::Low;
    (isHigh == 1 ? depths.high : depths.low) =
      MedianDepth(moments, end, isHigh == 1 ? ends.high : ends.low, mean, variance);
  });
  CodeRange codes = FindCodes(minima, maxima, TypicalVariance(moments, variance), settings, depths);
  // A signed 16-bit number ends at 32767, whatever 16 bits would hold.
  const double largest = std::numeric_limits<TPixel>::max();
  codes.clipHighDn = std::min(codes.clipHighDn.value_or(largest), largest);
  return codes;
}

/** The clip levels of a floating-point stack, from every finite pixel's extremes. */
template <typename TPixel>
CodeRange
FindCodesOfStack(const FloatingMoments<TPixel> & moments,
                 const StackEnds &               ends,
                 const CodeSettings &            settings,
                 const ParallelFor &             parallelFor,
                 const double *                  mean,
                 const double *                  variance)
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
      (isHigh == 1 ? maxima : minima) = LevelsAt(end, moments);
      (isHigh == 1 ? depths.high : depths.low) = MedianDepth(moments, end, level, mean, variance);
    }
  });
  return FindLevels(minima, maxima, TypicalVariance(moments, variance), settings, depths);
}

/** Fills the maps, and finds the ends of the stack on the way. */
template <typename TPixel>
StackEnds
FillMeanAndVariance(const TemporalMoments<TPixel> & moments,
                    const ParallelFor &             parallelFor,
                    double *                        mean,
                    double *                        variance)
{
  const std::size_t      pixels = moments.GetNumberOfPixels();
  const bool             hasVariance = moments.GetNumberOfFrames() > 1;
  std::vector<StackEnds> blocks((pixels + PixelsPerBlock - 1) / PixelsPerBlock);
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      mean[p] = moments.GetMean(p);
      variance[p] = hasVariance ? moments.GetVariance(p) : 0.0 * mean[p]; // not finite: NaN
    }
    StackEnds block;
    block.AddPixels(moments, begin, end);
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
MakeStackMaps(const TemporalMoments<TPixel> & moments,
              const CodeSettings &            settings,
              const ParallelFor &             parallelFor,
              double *                        mean,
              double *                        variance,
              std::uint8_t *                  valid)
{
  const std::size_t pixels = moments.GetNumberOfPixels();
  const StackEnds   ends = FillMeanAndVariance<TPixel>(moments, parallelFor, mean, variance);

  StackSummary summary;
  summary.codes = FindCodesOfStack(moments, ends, settings, parallelFor, mean, variance);

  std::vector<StackSummary> counts((pixels + PixelsPerBlock - 1) / PixelsPerBlock);
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    StackSummary & count = counts[begin / PixelsPerBlock];
    for (std::size_t p = begin; p < end; ++p)
    {
      const bool finite = moments.IsFinite(p);
      const bool clipped = finite && summary.codes.IsClipped(moments.GetMinimum(p), moments.GetMaximum(p));
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

template SensorNoise_EXPORT StackSummary
MakeStackMaps<unsigned char>(const TemporalMoments<unsigned char> &,
                             const CodeSettings &,
                             const ParallelFor &,
                             double *,
                             double *,
                             std::uint8_t *);
template SensorNoise_EXPORT StackSummary
MakeStackMaps<unsigned short>(const TemporalMoments<unsigned short> &,
                              const CodeSettings &,
                              const ParallelFor &,
                              double *,
                              double *,
                              std::uint8_t *);
template SensorNoise_EXPORT StackSummary
MakeStackMaps<short>(const TemporalMoments<short> &,
                     const CodeSettings &,
                     const ParallelFor &,
                     double *,
                     double *,
                     std::uint8_t *);
template SensorNoise_EXPORT StackSummary
MakeStackMaps<float>(const TemporalMoments<float> &,
                     const CodeSettings &,
                     const ParallelFor &,
                     double *,
                     double *,
                     std::uint8_t *);
template SensorNoise_EXPORT StackSummary
MakeStackMaps<double>(const TemporalMoments<double> &,
                      const CodeSettings &,
                      const ParallelFor &,
                      double *,
                      double *,
                      std::uint8_t *);

} // namespace sensornoise
