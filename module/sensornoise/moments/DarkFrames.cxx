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
#include "sensornoise/moments/DarkFrames.h"

#include "sensornoise/base/ChiSquare.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/moments/CodeRange.h"
#include "sensornoise/moments/CodeSettings.h"
#include "sensornoise/moments/KnownOffset.h"
#include "sensornoise/moments/StackMaps.h"
#include "sensornoise/moments/TemporalMoments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

namespace
{

/** What is used of dark frames. */
struct DarkPixels
{
  std::vector<double> levels;        ///< means [DN]
  std::vector<double> variances;     ///< [DN^2]
  double              stepDn{ 0.0 }; ///< spacing of the codes
};

/** The pixels that are used. Throws std::invalid_argument if they do not tell the offset. */
template <typename TPixel>
DarkPixels
UsablePixelsOf(const TemporalMoments<TPixel> &   moments,
               const CodeSettings &              codes,
               const std::vector<std::uint8_t> & mask,
               const ParallelFor &               parallelFor)
{
  const std::size_t         pixels = moments.GetNumberOfPixels();
  const auto                frames = static_cast<double>(moments.GetNumberOfFrames());
  std::vector<double>       mean(pixels);
  std::vector<double>       variance(pixels);
  std::vector<std::uint8_t> valid(pixels);
  const CodeRange           range =
    MakeStackMaps<TPixel>(moments, codes, parallelFor, mean.data(), variance.data(), valid.data()).codes;
  DarkPixels  used;
  std::size_t clipped = 0;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    const bool isMasked = !mask.empty() && mask[p] == 0;
    if (!isMasked && valid[p] != 0)
    {
      used.levels.push_back(mean[p]);
      used.variances.push_back(variance[p]);
    }
    clipped += !isMasked && valid[p] == 0 && moments.IsFinite(p) ? 1 : 0;
  }
  // Some dead pixels do no harm, nor does a sample in a thousand: cutting it off moves the mean by 0.003 sigma.
  const double clippedFraction = static_cast<double>(clipped) / static_cast<double>(clipped + used.levels.size());
  if (clippedFraction > std::max(0.01, 1.0 - std::pow(0.999, frames)))
  {
    throw std::invalid_argument(std::to_string(100.0 * clippedFraction) +
                                " % of the pixels of the dark frames reach a clip level, " +
                                (range.clipLowDn ? std::to_string(*range.clipLowDn) : "none") + " or " +
                                (range.clipHighDn ? std::to_string(*range.clipHighDn) : "none") +
                                " DN; expected at most 1 %: their black level is cut off, or they are not dark");
  }
  if (used.levels.size() < 30)
  {
    throw std::invalid_argument("only " + std::to_string(used.levels.size()) +
                                " pixels of the dark frames are usable; expected at least 30");
  }
  used.stepDn = range.quantisationStepDn;
  return used;
}

/** The mean variance, from those below a limit that one in a thousand would pass by chance. Reorders \a variances. */
DarkVariance
VarianceOf(std::vector<double> & variances, double frames)
{
  constexpr double   beyond = 1e-3;
  const double       dof = frames - 1.0;
  const double       limit = ChiSquareUpperQuantile(beyond, dof);
  const double       unit = Quantile(variances, 0.9) / ChiSquareQuantile(0.9, dof);
  const MeanOfPixels below = MeanWithin(variances, 0.0, unit * limit);
  const double       share = ChiSquareCdf(limit, dof + 2.0) / (1.0 - beyond); // of the mean below the limit
  return { below.value / share, below.standardError / share };
}

/** What rounding to codes hides of a level whose noise and fixed pattern have the variance \a spreadDn2. A mean of
 * codes is off by up to step/pi exp(-2 pi^2 spread/step^2): nothing once the spread is half a step. */
double
RoundingErrorDn(double step, double spreadDn2)
{
  constexpr double pi = 3.14159265358979323846;
  const double     hidden = std::max(0.0, spreadDn2 - step * step / 12.0);
  return step > 0.0 ? step / pi * std::exp(-2.0 * pi * pi * hidden / (step * step)) : 0.0;
}

} // namespace

MeanOfPixels
MeanWithin(const std::vector<double> & values, double low, double high)
{
  double n = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : values)
  {
    if (value >= low && value <= high)
    {
      n += 1.0;
      sum += value - low;
      squares += (value - low) * (value - low);
    }
  }
  return { low + sum / n, std::sqrt(std::max(0.0, squares - sum * sum / n) / (n * (n - 1.0))) };
}

template <typename TPixel>
KnownOffset
MeasureDarkFrames(const TemporalMoments<TPixel> &   moments,
                  const CodeSettings &              codes,
                  const std::vector<std::uint8_t> & mask,
                  const ParallelFor &               parallelFor)
{
  DarkPixels         pixels = UsablePixelsOf<TPixel>(moments, codes, mask, parallelFor);
  const double       low = Quantile(pixels.levels, 0.16);
  const double       high = Quantile(pixels.levels, 0.84);
  const double       median = Quantile(pixels.levels, 0.5);
  const double       reach = 3.0 * std::max(high - low, pixels.stepDn);
  const MeanOfPixels level = MeanWithin(pixels.levels, median - reach, median + reach);
  double             spreadDn2 = 0.25 * (high - low) * (high - low);
  KnownOffset        dark;
  dark.valueDn = level.value;
  dark.darkFrames = moments.GetNumberOfFrames();
  if (dark.darkFrames > 1)
  {
    dark.variance = VarianceOf(pixels.variances, static_cast<double>(dark.darkFrames));
    spreadDn2 += dark.variance->valueDn2;
  }
  dark.standardErrorDn = std::hypot(level.standardError, RoundingErrorDn(pixels.stepDn, spreadDn2));
  return dark;
}

template SensorNoise_EXPORT KnownOffset
MeasureDarkFrames<unsigned char>(const TemporalMoments<unsigned char> &,
                                 const CodeSettings &,
                                 const std::vector<std::uint8_t> &,
                                 const ParallelFor &);
template SensorNoise_EXPORT KnownOffset
MeasureDarkFrames<unsigned short>(const TemporalMoments<unsigned short> &,
                                  const CodeSettings &,
                                  const std::vector<std::uint8_t> &,
                                  const ParallelFor &);
template SensorNoise_EXPORT KnownOffset
MeasureDarkFrames<short>(const TemporalMoments<short> &,
                         const CodeSettings &,
                         const std::vector<std::uint8_t> &,
                         const ParallelFor &);
template SensorNoise_EXPORT KnownOffset
MeasureDarkFrames<float>(const TemporalMoments<float> &,
                         const CodeSettings &,
                         const std::vector<std::uint8_t> &,
                         const ParallelFor &);
template SensorNoise_EXPORT KnownOffset
MeasureDarkFrames<double>(const TemporalMoments<double> &,
                          const CodeSettings &,
                          const std::vector<std::uint8_t> &,
                          const ParallelFor &);

} // namespace sensornoise
