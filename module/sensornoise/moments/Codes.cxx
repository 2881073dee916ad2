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
#include "sensornoise/moments/Codes.h"

#include "sensornoise/moments/CodeRange.h"
#include "sensornoise/moments/CodeSettings.h"
#include "sensornoise/moments/PileUp.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

CodeHistogram::CodeHistogram()
  : m_Counts(LowestCode + 65536, 0)
{}

std::vector<std::int32_t>
CodeHistogram::Occupied() const
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

double
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

namespace
{

/** Whether the extreme code \a end is a pile-up; \a inwards is -step at the upper end and +step at the lower. */
bool
CodePilesUp(const CodeHistogram & extremes, std::int32_t end, std::int32_t inwards)
{
  std::uint32_t inside = 0;
  for (std::int32_t k = 1; k <= LevelsInsidePileUp; ++k)
  {
    inside = std::max(inside, extremes.Count(end + k * inwards));
  }
  return IsPileUp(extremes.Count(end), inside);
}

/** The codes that are an extreme of a pixel, ascending. */
std::vector<std::int32_t>
OccupiedCodes(const CodeHistogram & minima, const CodeHistogram & maxima)
{
  std::vector<std::int32_t>       codes = minima.Occupied();
  const std::vector<std::int32_t> upper = maxima.Occupied();
  codes.insert(codes.end(), upper.begin(), upper.end());
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  return codes;
}

/** Sets the bit depth, given or found, and returns where the codes end [DN]. */
double
SetBitDepth(std::int32_t highest, double step, const CodeSettings & settings, CodeRange & range)
{
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
  return top;
}

/** The extremes of the pixels, and what tells whether they may be trusted, see FindCodes(). */
struct Extremes
{
  const CodeHistogram & minima;
  const CodeHistogram & maxima;
  std::int32_t          lowest;
  std::int32_t          highest;
  double                typicalVarianceDn2;
  const ExtremeDepths & depths;
};

/** Sets the clip levels, given or found; the codes end at \a top. */
void
SetClipLevels(const Extremes & extremes, double step, double top, const CodeSettings & settings, CodeRange & range)
{
  const std::int32_t lowest = extremes.lowest;
  const std::int32_t highest = extremes.highest;
  const double       variance = extremes.typicalVarianceDn2;
  const auto         stride = static_cast<std::int32_t>(step);
  std::string        lowSource = "given";
  std::string        highSource = "given";
  range.clipLowDn = settings.clipLowDn;
  range.clipHighDn = settings.clipHighDn;
  if (!range.clipLowDn)
  {
    const bool found = lowest < highest && lowest != 0 && CanTellPileUp(variance, step, extremes.depths.low) &&
                       CodePilesUp(extremes.minima, lowest, stride);
    range.clipLowDn = found ? lowest : (lowest < 0 ? -32768.0 : 0.0);
    lowSource = found ? "pile-up" : "code range";
  }
  if (!range.clipHighDn)
  {
    const bool found = lowest < highest && highest < top && CanTellPileUp(variance, step, extremes.depths.high) &&
                       CodePilesUp(extremes.maxima, highest, -stride);
    range.clipHighDn = found ? highest : top;
    highSource = found ? "pile-up" : "code range";
  }
  range.SetClipSources(lowSource, highSource);
}

} // namespace

CodeRange
FindCodes(const CodeHistogram & minima,
          const CodeHistogram & maxima,
          double                typicalVarianceDn2,
          const CodeSettings &  settings,
          const ExtremeDepths & depths)
{
  const std::vector<std::int32_t> codes = OccupiedCodes(minima, maxima);
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

  const double top = SetBitDepth(highest, step, settings, range);
  SetClipLevels({ minima, maxima, lowest, highest, typicalVarianceDn2, depths }, step, top, settings, range);
  return range;
}

CodeRange
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
