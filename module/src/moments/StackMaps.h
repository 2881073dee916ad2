// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackMaps_h
#define sensornoise_moments_StackMaps_h

#include "sensornoise/StepResults.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "moments/TemporalMoments.h"
#include "SensorNoiseExport.h"
#include "moments/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Summarises a stack with these \a maps. The codes and clip levels are given or found, see FindCodes() and
 * FindLevels().
 * \param valid has room for the pixels of a frame; it receives 1 where a pixel is finite and never at a clip level,
 * else 0
 *
 * Throws std::invalid_argument if the data exceed the given bit depth. */
template <typename TPixel>
SensorNoise_EXPORT StackSummary
SummariseStack(const TemporalMaps<TPixel> & maps,
               const CodeSettings &         settings,
               const ParallelFor &          parallelFor,
               std::uint8_t *               valid);

/** Maps of a stack, of a frame's size, and their summary. */
struct StackMaps
{
  StackSummary              summary;
  std::vector<double>       mean;     ///< mean over time [DN]; NaN where a pixel was not finite in a frame
  std::vector<double>       variance; ///< unbiased variance over time [DN^2]; 0 for a single frame
  std::vector<std::uint8_t> valid;    ///< see SummariseStack()
};

/** Makes the maps from the moments, which are consumed: mean and variance take the memory of the sums. */
template <typename TPixel>
SensorNoise_EXPORT StackMaps
MakeStackMaps(TemporalMoments<TPixel> moments, const CodeSettings & settings, const ParallelFor & parallelFor);

/** Returns whether the values of a stack are counts, so that 0 means no event and not a clip level.
 *
 * The variance of counts is proportional to their mean, down to a fraction of one. A sensor whose offset is near 0 has
 * read noise and quantization noise there, clipped at 0, so that the ratio of variance to mean changes. The ratio is
 * compared between pixels with a mean below one step, of 1 to 3, of 3 to 10, and above 10 steps. \a stepDn is the
 * quantization step [DN]. */
template <typename TPixel>
bool
AreCountsFromZero(const TemporalMaps<TPixel> & maps, double stepDn)
{
  constexpr std::size_t      groups = 4;
  std::array<double, groups> mean{};
  std::array<double, groups> variance{};
  std::array<double, groups> squares{}; // sum of the squared variances
  std::array<double, groups> pixels{};
  const std::size_t          stride = std::max<std::size_t>(1, maps.GetNumberOfPixels() / InMoments.pixelsOfCounts);
  for (std::size_t p = 0; p < maps.GetNumberOfPixels(); p += stride)
  {
    const double steps = maps.mean[p] / stepDn;
    if (maps.IsFinite(p) && maps.GetMinimum(p) >= 0.0 && steps > InMoments.leastCount && steps < InMoments.largestCount)
    {
      const std::size_t group = steps < 1.0 ? 0 : steps < 3.0 ? 1 : steps < 10.0 ? 2 : 3;
      mean[group] += steps;
      const double ofSteps = maps.variance[p] / (stepDn * stepDn);
      variance[group] += ofSteps;
      squares[group] += ofSteps * ofSteps;
      pixels[group] += 1.0;
    }
  }
  // The standard error of the mean variance of a group is sqrt(spread) / pixels.
  double      least = 0.0;
  double      largest = 0.0;
  std::size_t reliable = 0;
  for (std::size_t k = 0; k < groups; ++k)
  {
    const double spread = squares[k] - variance[k] * variance[k] / std::max(1.0, pixels[k]);
    if (variance[k] > 0.0 && std::sqrt(std::max(0.0, spread)) < InMoments.errorOfCountRatio * variance[k])
    {
      const double ratio = variance[k] / mean[k];
      least = reliable == 0 ? ratio : std::min(least, ratio);
      largest = reliable == 0 ? ratio : std::max(largest, ratio);
      ++reliable;
    }
  }
  return reliable >= 2 && largest < (1.0 + InMoments.largestCountRatio) * least;
}

} // namespace sensornoise

#endif
