/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "sensornoise/moments/StackMaps.h"

#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/moments/CodeRange.h"
#include "sensornoise/moments/CodeSettings.h"
#include "sensornoise/moments/Codes.h"
#include "sensornoise/moments/TemporalMoments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace sensornoise
{

namespace
{

/** See ExtremeDepths. */
template <typename TMoments>
ExtremeDepths
FindExtremeDepths(const TMoments & moments, const double * mean, const double * variance)
{
  double lowest = moments.GetMinimum(0);
  double highest = moments.GetMaximum(0);
  for (std::size_t p = 1; p < moments.GetNumberOfPixels(); ++p)
  {
    lowest = std::min(lowest, moments.GetMinimum(p));
    highest = std::max(highest, moments.GetMaximum(p));
  }
  std::vector<double> low;
  std::vector<double> high;
  for (std::size_t p = 0; p < moments.GetNumberOfPixels(); ++p)
  {
    const double sd = std::sqrt(variance[p]);
    if (moments.GetMinimum(p) == lowest)
    {
      low.push_back(sd > 0.0 ? (mean[p] - lowest) / sd : 0.0);
    }
    if (moments.GetMaximum(p) == highest)
    {
      high.push_back(sd > 0.0 ? (highest - mean[p]) / sd : 0.0);
    }
  }
  return { Quantile(low, 0.5), Quantile(high, 0.5) };
}

/** The codes of an integer stack, from every pixel's extremes. */
template <typename TPixel>
CodeRange
FindCodesOfStack(const TemporalMoments<TPixel> & moments,
                 const CodeSettings &            settings,
                 const double *                  mean,
                 const double *                  variance)
{
  const std::size_t pixels = moments.GetNumberOfPixels();
  CodeHistogram     minima;
  CodeHistogram     maxima;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    minima.Add(moments.GetMinimum(p));
    maxima.Add(moments.GetMaximum(p));
  }
  // Some thousand pixels, evenly spread, tell the typical noise.
  std::vector<double> variances;
  for (std::size_t p = 0; p < pixels; p += std::max<std::size_t>(1, pixels / 8192))
  {
    variances.push_back(variance[p]);
  }
  CodeRange codes =
    FindCodes(minima, maxima, Quantile(variances, 0.5), settings, FindExtremeDepths(moments, mean, variance));
  // A signed 16-bit number ends at 32767, whatever 16 bits would hold.
  const double largest = std::numeric_limits<TPixel>::max();
  codes.clipHighDn = std::min(codes.clipHighDn.value_or(largest), largest);
  return codes;
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
  const std::size_t block = 4096;
  const std::size_t blocks = (pixels + block - 1) / block;
  parallelFor(blocks, [&](std::size_t b) {
    for (std::size_t p = b * block; p < std::min(pixels, (b + 1) * block); ++p)
    {
      mean[p] = moments.GetMean(p);
      variance[p] = moments.GetVariance(p);
    }
  });

  StackSummary summary;
  if constexpr (std::is_integral_v<TPixel>)
  {
    summary.codes = FindCodesOfStack<TPixel>(moments, settings, mean, variance);
  }
  else
  {
    summary.codes = GivenCodes(settings);
  }

  std::vector<StackSummary> counts(blocks);
  parallelFor(blocks, [&](std::size_t b) {
    for (std::size_t p = b * block; p < std::min(pixels, (b + 1) * block); ++p)
    {
      const bool finite = moments.IsFinite(p);
      const bool clipped = finite && summary.codes.IsClipped(moments.GetMinimum(p), moments.GetMaximum(p));
      valid[p] = finite && !clipped ? 1 : 0;
      counts[b].clipped += clipped ? 1 : 0;
      counts[b].notFinite += finite ? 0 : 1;
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
