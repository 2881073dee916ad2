// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ImageScale.h"

#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <type_traits>

namespace sensornoise::tools
{
namespace
{
/** Limits for the signal of the median pixel divided by the largest mean signal in the report [1]. Above
 * ImpossibleSignal the frame is rejected: multiplication of the grey values by 16 exceeds it in all but the darkest
 * frames. Above DoubtfulSignal there is a warning. Both are chosen empirically, without a systematic study. */
constexpr double ImpossibleSignal = 8.0;
constexpr double DoubtfulSignal = 2.0;
/** Fraction of pixels with a negative argument of the square root, above which there is a warning [1]. In a dark
 * frame, noise alone gives 8 % at a read noise of 1 e-, and less than 0.1 % from 10 e- on. */
constexpr double DoubtfulFraction = 0.01;
/** Number of distinct grey values from which on their spacing is tested. */
constexpr std::size_t LeastGreyValues = 16;

std::string
Name(double level)
{
  return Text(level) + " DN";
}

[[noreturn]] void
Refuse(const std::string & image, const std::string & found, const NoiseModelFile & report)
{
  throw std::runtime_error(image + " is on another scale than the report " + report.name + ": " + found +
                           "; expected a frame of the same camera at the same setting, its levels as they were");
}

template <typename TPixel>
void
RequireFinite(const std::vector<TPixel> & levels, const std::string & image)
{
  const auto bad = std::count_if(levels.begin(), levels.end(), [](TPixel level) { return !std::isfinite(level); });
  if (bad > 0)
  {
    throw std::runtime_error(image + " has " + std::to_string(bad) +
                             " pixels that are NaN or infinite; expected finite levels");
  }
}

/** Returns the greatest common divisor of the distances between grey values [DN]; 0 if there are fewer than
 * LeastGreyValues grey values. */
template <typename TPixel>
std::int32_t
FindGreyValueStep(const std::vector<TPixel> & levels)
{
  constexpr std::int32_t lowest = std::numeric_limits<TPixel>::lowest();
  std::vector<bool>      seen(static_cast<std::size_t>(std::numeric_limits<TPixel>::max() - lowest) + 1, false);
  for (const TPixel level : levels)
  {
    seen[static_cast<std::size_t>(level - lowest)] = true;
  }
  std::int32_t step = 0;
  std::int32_t last = -1;
  std::size_t  greyValues = 0;
  for (std::size_t greyValue = 0; greyValue < seen.size(); ++greyValue)
  {
    if (seen[greyValue])
    {
      const auto here = static_cast<std::int32_t>(greyValue);
      step = last < 0 ? 0 : std::gcd(step, here - last);
      last = here;
      ++greyValues;
    }
  }
  return greyValues < LeastGreyValues ? 0 : step;
}

template <typename TPixel>
void
RequireGreyValueStep(const std::vector<TPixel> & levels, const NoiseModelFile & report, const std::string & image)
{
  if (!report.quantisationStepDn || !(*report.quantisationStepDn >= 1.0))
  {
    return;
  }
  const std::int32_t step = FindGreyValueStep(levels);
  // in a frame of few grey values a multiple of the step may occur by chance, but never a smaller step
  if (step >= 4.0 * *report.quantisationStepDn || (step > 0 && 2.0 * step <= *report.quantisationStepDn))
  {
    Refuse(image,
           "its digital numbers are multiples of " + std::to_string(step) + ", the report's of " +
             Text(*report.quantisationStepDn),
           report);
  }
}

template <typename TPixel>
double
Median(std::vector<TPixel> levels)
{
  const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
  std::nth_element(levels.begin(), middle, levels.end());
  return static_cast<double>(*middle);
}

/** Returns the signal of the median pixel divided by the largest mean signal in the report [1]; 0 if the report has
 * no such level. Throws std::runtime_error if the median is outside the range that the report permits. */
double
RequireMedian(double median, const NoiseModelFile & report, const std::string & image)
{
  const double zero = report.ZeroLevelDn();
  const double lowest = zero - 0.375 * report.model.varianceSlopeDn; // below this level the transform gives 0
  if (median < lowest)
  {
    Refuse(image,
           "half of its pixels are at or below " + Name(median) + ", the level of zero signal is " + Name(zero),
           report);
  }
  if (report.clipHighDn && median > *report.clipHighDn)
  {
    Refuse(image,
           "half of its pixels are at or above " + Name(median) + ", the sensor attains " + Name(*report.clipHighDn),
           report);
  }
  const double signal =
    report.highestDn && *report.highestDn > zero ? (median - zero) / (*report.highestDn - zero) : 0.0;
  if (signal > ImpossibleSignal)
  {
    Refuse(image,
           "half of its pixels are at or above " + Name(median) + ", the brightest that were measured had " +
             Name(*report.highestDn),
           report);
  }
  return signal;
}
} // namespace

template <typename TPixel>
std::string
RequireScale(const std::vector<TPixel> & levels, const NoiseModelFile & report, const std::string & image)
{
  if constexpr (std::is_floating_point_v<TPixel>)
  {
    RequireFinite(levels, image);
  }
  else
  {
    RequireGreyValueStep(levels, report, image);
  }
  const double median = Median(levels);
  if (RequireMedian(median, report, image) > DoubtfulSignal)
  {
    return image + " is far brighter than what was measured: half of its pixels are at or above " + Name(median) +
           ", the brightest in the report " + report.name + " had " + Name(*report.highestDn);
  }
  const double lowest = report.ZeroLevelDn() - 0.375 * report.model.varianceSlopeDn;
  const auto   below = static_cast<double>(std::count_if(
    levels.begin(), levels.end(), [lowest](TPixel level) { return static_cast<double>(level) < lowest; }));
  const double fraction = below / static_cast<double>(levels.size());
  if (fraction > DoubtfulFraction)
  {
    return image + ": " + Text(std::round(1000.0 * fraction) / 10.0) + " % of the pixels are below " + Name(lowest) +
           ", where the model of the report " + report.name +
           " has no variance; in the dark noise alone does that, else the report is of another camera or setting";
  }
  return "";
}

template std::string
RequireScale(const std::vector<unsigned char> &, const NoiseModelFile &, const std::string &);
template std::string
RequireScale(const std::vector<unsigned short> &, const NoiseModelFile &, const std::string &);
template std::string
RequireScale(const std::vector<short> &, const NoiseModelFile &, const std::string &);
template std::string
RequireScale(const std::vector<float> &, const NoiseModelFile &, const std::string &);
template std::string
RequireScale(const std::vector<double> &, const NoiseModelFile &, const std::string &);

} // namespace sensornoise::tools
