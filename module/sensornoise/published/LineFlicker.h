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
#ifndef sensornoise_published_LineFlicker_h
#define sensornoise_published_LineFlicker_h

#include "sensornoise/published/FlickerSums.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sensornoise
{

/** v^*(y, t) for every frame and line, (3.28), where the bright set reaches. */
struct LineRatios
{
  double                    sigmaLines{ 0.0 }; ///< sigma_y that was used [lines]
  std::vector<double>       ratio;             ///< frame by frame, line by line; 1 where not known
  std::vector<std::uint8_t> known;             ///< per line: the line set has pixels within sigma_y of it
};

namespace detail
{
/** Gaussian weights of (3.28) at distances 0, 1, ... up to 4 sigma. */
inline std::vector<double>
LineKernel(double sigmaLines)
{
  std::vector<double> kernel(static_cast<std::size_t>(4.0 * sigmaLines) + 1);
  for (std::size_t d = 0; d < kernel.size(); ++d)
  {
    const double distance = static_cast<double>(d) / sigmaLines;
    kernel[d] = std::exp(-0.5 * distance * distance);
  }
  return kernel;
}

/** The smoothed ratio of \a line in frame \a t, without the line itself if \a leaveOut. NaN: no weight within reach. */
inline double
SmoothedRatio(const FlickerSums &         sums,
              const std::vector<double> & kernel,
              std::size_t                 t,
              std::size_t                 line,
              bool                        leaveOut)
{
  const std::size_t reach = kernel.size() - 1;
  const std::size_t first = line > reach ? line - reach : 0;
  const std::size_t last = std::min(sums.GetNumberOfLines() - 1, line + reach);
  double            sum = 0.0;
  double            weights = 0.0;
  for (std::size_t other = first; other <= last; ++other)
  {
    if (!(leaveOut && other == line))
    {
      const double weight = kernel[other > line ? other - line : line - other];
      sum += weight * sums.GetLineSum(t, other);
      weights += weight * sums.GetLineWeight(other);
    }
  }
  return weights > 0.0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
}

/** Mean squared error of predicting each line's ratio from the other lines', weighted by the lines' weights, over every
 * \a stride th frame. An infinite sigma predicts by the whole frame. */
inline double
CrossValidationError(const FlickerSums & sums, double sigmaLines, std::size_t stride)
{
  const bool                wholeFrame = std::isinf(sigmaLines);
  const std::vector<double> kernel = wholeFrame ? std::vector<double>() : LineKernel(sigmaLines);
  double                    error = 0.0;
  for (std::size_t t = 0; t < sums.GetNumberOfFrames(); t += stride)
  {
    double ratio = 0.0;
    for (std::size_t line = 0; line < sums.GetNumberOfLines(); ++line)
    {
      ratio += sums.GetLineSum(t, line);
    }
    for (std::size_t line = 0; line < sums.GetNumberOfLines(); ++line)
    {
      const double weight = sums.GetLineWeight(line);
      if (weight > 0.0 && weight < 1.0)
      {
        const double own = sums.GetLineSum(t, line);
        double predicted = wholeFrame ? (ratio - own) / (1.0 - weight) : SmoothedRatio(sums, kernel, t, line, true);
        if (std::isnan(predicted))
        {
          predicted = (ratio - own) / (1.0 - weight);
        }
        const double deviation = own / weight - predicted;
        error += weight * deviation * deviation;
      }
    }
  }
  return error;
}
} // namespace detail

/** Chooses sigma_y by leave-one-line-out cross-validation; 0 means that the flicker is the same in all lines.
 *
 * Section 3.5 of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035) takes 50 rows and leaves the choice to future
 * work. Here each line's v^* is predicted from the other lines' with the weights of (3.28), and the sigma_y that
 * predicts best over all frames wins. Lines are modelled only if that beats the whole frame's v^* by more than 1 %
 * of the squared error: below, what a line's own flicker adds to the variance of a pixel is under 1 % of its noise.
 * A first look at 16 frames and three widths spares a stack without line flicker the search. */
inline double
ChooseLineSigma(const FlickerSums & sums)
{
  constexpr double  infinity = std::numeric_limits<double>::infinity();
  constexpr double  gain = 0.99;
  const std::size_t stride = std::max<std::size_t>(1, sums.GetNumberOfFrames() / 16);
  const double      wholeFrame16 = detail::CrossValidationError(sums, infinity, stride);
  double            best16 = infinity;
  for (const double sigma : { 4.0, 16.0, 64.0 })
  {
    best16 = std::min(best16, detail::CrossValidationError(sums, sigma, stride));
  }
  if (!(best16 < gain * wholeFrame16))
  {
    return 0.0;
  }
  double error = gain * detail::CrossValidationError(sums, infinity, 1);
  double chosen = 0.0;
  for (const double sigma : { 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 50.0, 75.0, 100.0, 150.0 })
  {
    const double candidate = detail::CrossValidationError(sums, sigma, 1);
    if (candidate < error)
    {
      error = candidate;
      chosen = sigma;
    }
  }
  return chosen;
}

/** v^*(y, t) with the width \a sigmaLines. A line farther than sigma_y from any pixel of the line set is not known: the
 * kernel would extrapolate there. */
inline LineRatios
SmoothLineRatios(const FlickerSums & sums, double sigmaLines)
{
  const std::size_t         lines = sums.GetNumberOfLines();
  const std::vector<double> kernel = detail::LineKernel(sigmaLines);
  LineRatios                result;
  result.sigmaLines = sigmaLines;
  result.ratio.assign(sums.GetNumberOfFrames() * lines, 1.0);
  result.known.assign(lines, 0);
  const auto reach = static_cast<std::size_t>(sigmaLines);
  for (std::size_t line = 0; line < lines; ++line)
  {
    const std::size_t last = std::min(lines - 1, line + reach);
    for (std::size_t other = line > reach ? line - reach : 0; other <= last; ++other)
    {
      if (sums.GetLineWeight(other) > 0.0)
      {
        result.known[line] = 1;
      }
    }
    for (std::size_t t = 0; t < sums.GetNumberOfFrames() && result.known[line] != 0; ++t)
    {
      result.ratio[t * lines + line] = detail::SmoothedRatio(sums, kernel, t, line, false);
    }
  }
  return result;
}

} // namespace sensornoise

#endif
