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
#ifndef sensornoise_moments_Codes_h
#define sensornoise_moments_Codes_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

/** What the user says about the codes of the data; what is not said is found. */
struct CodeSettings
{
  std::optional<int>    bitDepth;           ///< bits of the sensor's codes, 1 to 16
  std::optional<double> clipLowDn;          ///< lowest level that the sensor attains [DN]
  std::optional<double> clipHighDn;         ///< highest level that the sensor attains [DN]
  std::optional<double> quantisationStepDn; ///< spacing of the codes [DN]
};

/** Settings from plain numbers: a bit depth or step of 0, and a clip level of NaN, is to be found. */
inline CodeSettings
MakeCodeSettings(unsigned int bitDepth, double clipLowDn, double clipHighDn, double quantisationStepDn)
{
  CodeSettings settings;
  if (bitDepth > 0)
  {
    settings.bitDepth = static_cast<int>(bitDepth);
  }
  if (!std::isnan(clipLowDn))
  {
    settings.clipLowDn = clipLowDn;
  }
  if (!std::isnan(clipHighDn))
  {
    settings.clipHighDn = clipHighDn;
  }
  if (quantisationStepDn > 0.0)
  {
    settings.quantisationStepDn = quantisationStepDn;
  }
  return settings;
}

/** Throws std::invalid_argument if what the user says of the codes is out of range. */
inline void
ValidateCodeSettings(const CodeSettings & codes)
{
  if (codes.bitDepth && (*codes.bitDepth < 1 || *codes.bitDepth > 16))
  {
    throw std::invalid_argument("the bit depth is " + std::to_string(*codes.bitDepth) + "; expected 1 to 16");
  }
  if (codes.clipLowDn && codes.clipHighDn && !(*codes.clipLowDn < *codes.clipHighDn))
  {
    throw std::invalid_argument("the clip levels are " + std::to_string(*codes.clipLowDn) + " and " +
                                std::to_string(*codes.clipHighDn) + " DN; expected low < high");
  }
  if (codes.quantisationStepDn && !(*codes.quantisationStepDn > 0.0))
  {
    throw std::invalid_argument("the code step is " + std::to_string(*codes.quantisationStepDn) +
                                " DN; expected a positive number");
  }
}

/** What is known about the codes of the data. */
struct CodeRange
{
  std::optional<int>    bitDepth;                  ///< null for floating-point data
  std::string           bitDepthSource{ "none" };  ///< "given", "data" or "none"
  double                quantisationStepDn{ 0.0 }; ///< spacing of the codes [DN]; 0: the data have no codes
  bool                  isRegular{ true };         ///< false: rescaled data, the spacing varies
  std::optional<double> clipLowDn;                 ///< a pixel that attains it is clipped [DN]; null: none
  std::optional<double> clipHighDn;                ///< a pixel that attains it is clipped [DN]; null: none
  std::string           clipSource{ "none" }; ///< "given", "pile-up", "code range", "none", or "low: ..., high: ..."

  bool
  IsClipped(double minimumDn, double maximumDn) const
  {
    return (clipLowDn && minimumDn <= *clipLowDn) || (clipHighDn && maximumDn >= *clipHighDn);
  }
};

/** How many pixels have which code as their extreme over time. */
class CodeHistogram
{
public:
  CodeHistogram()
    : m_Counts(LowestCode + 65536, 0)
  {}
  void
  Add(double code)
  {
    ++m_Counts[static_cast<std::size_t>(static_cast<std::int32_t>(code) + LowestCode)];
  }
  std::uint32_t
  Count(std::int32_t code) const
  {
    const std::int32_t i = code + LowestCode;
    return i < 0 || i >= static_cast<std::int32_t>(m_Counts.size()) ? 0 : m_Counts[static_cast<std::size_t>(i)];
  }
  /** The codes that occur, ascending. */
  std::vector<std::int32_t>
  Occupied() const
  {
    std::vector<std::int32_t> codes;
    for (std::size_t i = 0; i < m_Counts.size(); ++i)
    {
      if (m_Counts[i] > 0)
      {
        codes.push_back(static_cast<std::int32_t>(i) - LowestCode);
      }
    }
    return codes;
  }

private:
  static constexpr std::int32_t LowestCode = 32768; // room for signed and unsigned 16-bit codes
  std::vector<std::uint32_t>    m_Counts;
};

/** The spacing of the codes: the majority of the distances between neighbouring codes that occur.
 *
 * 12 bits left-aligned in 16 have the spacing 16. Data that were rescaled (for example by 65535/4095) have spacings of
 * 16 and 17, so that their codes drift through all remainders: more than 2 % of the codes off the grid, and \a regular
 * is false. A few stray codes do not matter. */
inline double
FindQuantisationStep(const std::vector<std::int32_t> & codes, bool & regular)
{
  regular = true;
  std::map<std::int32_t, std::size_t> spacings;
  for (std::size_t i = 1; i < codes.size(); ++i)
  {
    ++spacings[codes[i] - codes[i - 1]];
  }
  const auto majority = std::max_element(
    spacings.begin(), spacings.end(), [](const auto & a, const auto & b) { return a.second < b.second; });
  if (majority == spacings.end())
  {
    return 1.0;
  }
  std::int32_t step = majority->first;
  if (2 * majority->second < codes.size())
  {
    // No majority: few codes, far apart. What all spacings are multiples of is a step.
    step = 0;
    for (const auto & spacing : spacings)
    {
      step = std::gcd(step, spacing.first);
    }
  }
  std::map<std::int32_t, std::size_t> remainders;
  for (const std::int32_t code : codes)
  {
    ++remainders[((code % step) + step) % step];
  }
  std::size_t onGrid = 0;
  for (const auto & remainder : remainders)
  {
    onGrid = std::max(onGrid, remainder.second);
  }
  regular = static_cast<double>(codes.size() - onGrid) <= 0.02 * static_cast<double>(codes.size()) + 2.0;
  return step;
}

/** Whether the extreme code \a end is a pile-up: a level that the sensor cannot pass.
 *
 * Noise alone puts few pixels' extremes on the outermost code, fewer than on the codes inside of it. A clip level
 * gathers the extremes of all pixels that would have passed it: at least 8 pixels, and 3 times as many as any of the 16
 * codes inside. \a inwards is -step at the upper end and +step at the lower. */
inline bool
IsPileUp(const CodeHistogram & extremes, std::int32_t end, std::int32_t inwards)
{
  std::uint32_t inside = 0;
  for (std::int32_t k = 1; k <= 16; ++k)
  {
    inside = std::max(inside, extremes.Count(end + k * inwards));
  }
  return extremes.Count(end) >= std::max<std::uint32_t>(8, 3 * inside + 1);
}

/** How far the outermost codes lie from the mean of the pixels that attain them, in these pixels' temporal standard
 * deviations, as a median. What a clip level cuts off is near the mean or beyond it; where it is just rare noise, or
 * codes as coarse as the noise, that is some standard deviations away. */
struct ExtremeDepths
{
  double low{ 0.0 };
  double high{ 0.0 };
};

/** Finds bit depth, code step and clip levels of integer data from every pixel's extremes over time.
 *
 * Given values win. The bit depth is the smallest of 8, 10, 12, 14 and 16 that holds the codes. A clip level is a
 * pile-up of the extremes, else the end of the code range (design: a sensor that saturates at 3,400 of 4,095, or rests
 * on a floor above 0, is common). \a typicalVarianceDn2 is the median temporal variance: where the noise is below half
 * a step, every level piles up and only the code range is trusted. So it is where \a depths exceed 2.5.
 *
 * Throws std::invalid_argument if the data pass what was given. */
inline CodeRange
FindCodes(const CodeHistogram & minima,
          const CodeHistogram & maxima,
          double                typicalVarianceDn2,
          const CodeSettings &  settings,
          const ExtremeDepths & depths = {})
{
  std::vector<std::int32_t>       codes = minima.Occupied();
  const std::vector<std::int32_t> upper = maxima.Occupied();
  codes.insert(codes.end(), upper.begin(), upper.end());
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  if (codes.empty())
  {
    throw std::invalid_argument("the stack holds no pixel");
  }
  const std::int32_t lowest = codes.front();
  const std::int32_t highest = codes.back();

  CodeRange range;
  range.quantisationStepDn = FindQuantisationStep(codes, range.isRegular);
  if (settings.quantisationStepDn)
  {
    range.quantisationStepDn = *settings.quantisationStepDn;
  }
  const double step = range.quantisationStepDn > 0.0 ? range.quantisationStepDn : 1.0;

  range.bitDepthSource = settings.bitDepth ? "given" : "data";
  range.bitDepth = settings.bitDepth.value_or(16);
  for (const int bits : { 8, 10, 12, 14 })
  {
    if (!settings.bitDepth && range.bitDepth == 16 && highest <= (std::exp2(bits) - 1.0) * step)
    {
      range.bitDepth = bits;
    }
  }
  const double top = (std::exp2(*range.bitDepth) - 1.0) * step;
  if (highest > top)
  {
    throw std::invalid_argument("the data hold the level " + std::to_string(highest) + " DN, but " +
                                std::to_string(*range.bitDepth) + " bits with a code step of " +
                                std::to_string(static_cast<int>(step)) + " DN end at " +
                                std::to_string(static_cast<int>(top)) + " DN; give a larger bit depth");
  }

  constexpr double largestDepth = 2.5;
  const bool       trusted = typicalVarianceDn2 >= 0.25 * step * step && lowest < highest;
  const auto       stride = static_cast<std::int32_t>(step);
  std::string      lowSource = "given";
  std::string      highSource = "given";
  range.clipLowDn = settings.clipLowDn;
  range.clipHighDn = settings.clipHighDn;
  if (!range.clipLowDn)
  {
    const bool found = trusted && lowest != 0 && depths.low < largestDepth && IsPileUp(minima, lowest, stride);
    range.clipLowDn = found ? lowest : (lowest < 0 ? -32768.0 : 0.0);
    lowSource = found ? "pile-up" : "code range";
  }
  if (!range.clipHighDn)
  {
    const bool found = trusted && highest < top && depths.high < largestDepth && IsPileUp(maxima, highest, -stride);
    range.clipHighDn = found ? highest : top;
    highSource = found ? "pile-up" : "code range";
  }
  range.clipSource = lowSource == highSource ? lowSource : "low: " + lowSource + ", high: " + highSource;
  return range;
}

/** Floating-point data have no codes: only what is given. */
inline CodeRange
GivenCodes(const CodeSettings & settings)
{
  CodeRange range;
  range.bitDepth = settings.bitDepth;
  range.bitDepthSource = settings.bitDepth ? "given" : "none";
  range.quantisationStepDn = settings.quantisationStepDn.value_or(0.0);
  range.clipLowDn = settings.clipLowDn;
  range.clipHighDn = settings.clipHighDn;
  range.clipSource = settings.clipLowDn || settings.clipHighDn ? "given" : "none";
  return range;
}

} // namespace sensornoise

#endif
