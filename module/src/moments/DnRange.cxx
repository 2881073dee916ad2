// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMaps.h"

#include "sensornoise/Settings.h"
#include "base/Text.h"
#include "sensornoise/StepResults.h"
#include "moments/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

DnSettings
MakeDnSettings(unsigned int bitDepth, double clipLowDn, double clipHighDn, double quantisationStepDn)
{
  DnSettings settings;
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

void
ValidateDnSettings(const DnSettings & settings)
{
  if (settings.bitDepth && (*settings.bitDepth < 1 || *settings.bitDepth > 16))
  {
    throw std::invalid_argument("the bit depth is " + std::to_string(*settings.bitDepth) + "; expected 1 to 16");
  }
  for (const std::optional<double> & level : { settings.clipLowDn, settings.clipHighDn })
  {
    if (level && !(std::abs(*level) <= LargestLevelDn))
    {
      throw std::invalid_argument("a clip level is " + Text(*level) + " DN; expected a level within " +
                                  Text(LargestLevelDn) + " DN of 0");
    }
  }
  if (settings.clipLowDn && settings.clipHighDn && !(*settings.clipLowDn < *settings.clipHighDn))
  {
    throw std::invalid_argument("the clip levels are " + Text(*settings.clipLowDn) + " and " +
                                Text(*settings.clipHighDn) + " DN; expected low < high");
  }
  if (settings.quantisationStepDn &&
      !(*settings.quantisationStepDn > 0.0 && *settings.quantisationStepDn <= LargestStepDn))
  {
    throw std::invalid_argument("the quantization step is " + Text(*settings.quantisationStepDn) +
                                " DN; expected a positive number, at most " + Text(LargestStepDn));
  }
}

namespace
{

/** Returns whether the extreme number \a end is a saturation level. \a inwards is -step at the upper end and +step at
 * the lower end [DN]. */
bool
IsSaturationLevel(const DnHistogram & extremes, std::int32_t end, std::int32_t inwards)
{
  std::uint32_t inside = 0;
  for (std::int32_t k = 1; k <= InMoments.levelsInsideClip; ++k)
  {
    inside = std::max(inside, extremes.Count(end + k * inwards));
  }
  return IsClipLevel(extremes.Count(end), inside);
}

/** Returns whether the extreme number \a end of companded data is a saturation level. Their digital numbers are not
 * evenly spaced, so that it is compared with the next \a occupied digital numbers inside. */
bool
CompandedClipLevel(const DnHistogram &               extremes,
                   const std::vector<std::int32_t> & occupied,
                   std::int32_t                      end,
                   bool                              isHigh)
{
  std::uint32_t inside = 0;
  auto          level = std::lower_bound(occupied.begin(), occupied.end(), end);
  for (int k = 1; k <= InMoments.levelsInsideClip; ++k)
  {
    if (isHigh ? level == occupied.begin() : std::next(level) == occupied.end())
    {
      break;
    }
    level += isHigh ? -1 : 1;
    inside = std::max(inside, extremes.Count(*level));
  }
  return IsClipLevel(extremes.Count(end), inside);
}

/** Returns the digital numbers that are an extreme of a pixel, ascending. */
std::vector<std::int32_t>
OccupiedDn(const DnHistogram & minima, const DnHistogram & maxima)
{
  std::vector<std::int32_t>       valuesDn = minima.Occupied();
  const std::vector<std::int32_t> upper = maxima.Occupied();
  valuesDn.insert(valuesDn.end(), upper.begin(), upper.end());
  std::sort(valuesDn.begin(), valuesDn.end());
  valuesDn.erase(std::unique(valuesDn.begin(), valuesDn.end()), valuesDn.end());
  return valuesDn;
}

std::vector<DnCount>
WithCounts(const std::vector<std::int32_t> & valuesDn, const DnHistogram & minima, const DnHistogram & maxima)
{
  std::vector<DnCount> seen(valuesDn.size());
  std::transform(valuesDn.begin(), valuesDn.end(), seen.begin(), [&](std::int32_t valueDn) {
    return DnCount{ valueDn, minima.Count(valueDn) + maxima.Count(valueDn) };
  });
  return seen;
}

/** Returns the greatest common divisor of all distances between the digital numbers [DN]; at least 1. */
double
CommonDivisor(const std::vector<std::int32_t> & valuesDn)
{
  std::int32_t divisor = 0;
  for (const std::int32_t valueDn : valuesDn)
  {
    divisor = std::gcd(divisor, valueDn - valuesDn.front());
  }
  return std::max(divisor, 1);
}

/** Sets the bit depth, given or found, and returns the largest digital number [DN]. Throws std::invalid_argument if \a
 * highest exceeds it. */
double
SetBitDepth(std::int32_t highest, double step, const DnSettings & settings, DnRange & range)
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
                                std::to_string(*range.bitDepth) + " bits with a quantization step of " + Text(step) +
                                " DN end at " + Text(top) + " DN; give a larger bit depth");
  }
  return top;
}

/** Returns the distance of two digital numbers, at least 1, that a quantization step is [DN]. */
std::int32_t
StrideOf(double step)
{
  return std::max<std::int32_t>(1, static_cast<std::int32_t>(step));
}

} // namespace

std::int32_t
FindEndOfDnRange(const DnHistogram & extremes, bool isHigh, double step)
{
  std::vector<std::int32_t> valuesDn = extremes.Occupied();
  const std::int32_t        stride = StrideOf(step);
  if (isHigh)
  {
    std::reverse(valuesDn.begin(), valuesDn.end());
  }
  const std::int32_t inwards = isHigh ? -stride : stride;
  std::int32_t       end = valuesDn.front();
  double             beyond = extremes.Count(end);
  for (std::size_t i = 1; i < valuesDn.size(); ++i)
  {
    const auto pixels = static_cast<double>(extremes.Count(valuesDn[i]));
    const bool isApart = std::abs(valuesDn[i] - valuesDn[i - 1]) > InMoments.levelsOutsideClip * stride;
    if (isApart && beyond <= InMoments.largestStrayFraction * pixels &&
        IsSaturationLevel(extremes, valuesDn[i], inwards))
    {
      end = valuesDn[i];
    }
    beyond += pixels;
  }
  return end;
}

namespace
{
/** The extremes of the pixels, and the quantities that decide whether they are evidence of clipping, see FindDnRange().
 */
struct Extremes
{
  const DnHistogram &       minima;
  const DnHistogram &       maxima;
  std::vector<std::int32_t> occupied; ///< digital numbers that occur, ascending
  std::int32_t              low;      ///< ends of the digital numbers, see FindEndOfDnRange() [DN]
  std::int32_t              high;
  double                    typicalVarianceDn2;
  const ExtremeDepths &     depths;
};

/** Returns whether an end of the digital numbers is a saturation level. \a step is their quantization step [DN]. */
bool
IsClipEnd(const Extremes & extremes, bool isHigh, double step, const QuantisationSteps & steps)
{
  const DnHistogram & histogram = isHigh ? extremes.maxima : extremes.minima;
  const std::int32_t  end = isHigh ? extremes.high : extremes.low;
  const double        depth = isHigh ? extremes.depths.high : extremes.depths.low;
  if (steps.IsCompanded())
  {
    return IsClipEvidence(extremes.typicalVarianceDn2, steps.StepAt(end), depth) &&
           CompandedClipLevel(histogram, extremes.occupied, end, isHigh);
  }
  const std::int32_t stride = StrideOf(step);
  return IsClipEvidence(extremes.typicalVarianceDn2, step, depth) &&
         IsSaturationLevel(histogram, end, isHigh ? -stride : stride);
}

/** Sets the clip levels, given or found. \a top is the largest digital number [DN]. */
void
SetClipLevels(const Extremes & extremes, double step, double top, const DnSettings & settings, DnRange & range)
{
  const std::int32_t lowest = extremes.low;
  const std::int32_t highest = extremes.high;
  std::string        lowSource = "given";
  std::string        highSource = "given";
  range.clipLowDn = settings.clipLowDn;
  range.clipHighDn = settings.clipHighDn;
  if (!range.clipLowDn)
  {
    const bool found = lowest < highest && lowest != 0 && IsClipEnd(extremes, false, step, range.steps);
    // Negative digital numbers end where their integer type does, which is no level of the sensor.
    const bool isSigned = extremes.occupied.front() < 0;
    range.clipLowDn = found ? std::optional<double>(lowest) : isSigned ? std::nullopt : std::optional<double>(0.0);
    lowSource = found ? "pile-up" : isSigned ? "none" : "code range";
  }
  if (!range.clipHighDn)
  {
    const bool found = lowest < highest && highest < top && IsClipEnd(extremes, true, step, range.steps);
    range.clipHighDn = found ? highest : top;
    highSource = found ? "pile-up" : "code range";
  }
  range.SetClipSources(lowSource, highSource);
}

/** Sets the quantization step of \a range, given or found, and returns the spacing of the digital numbers \a valuesDn
 * [DN]. */
double
SetStep(const std::vector<std::int32_t> & valuesDn,
        const DnHistogram &               minima,
        const DnHistogram &               maxima,
        const DnSettings &                settings,
        DnRange &                         range)
{
  range.quantisationStepDn = FindQuantisationStep(valuesDn, range.isRegular);
  if (settings.quantisationStepDn)
  {
    range.quantisationStepDn = *settings.quantisationStepDn;
  }
  else
  {
    range.steps = FindLocalSteps(WithCounts(valuesDn, minima, maxima));
  }
  if (!range.steps.IsCompanded())
  {
    return range.quantisationStepDn > 0.0 ? range.quantisationStepDn : 1.0;
  }
  range.isRegular = true;
  range.quantisationStepDn = range.steps.GetTable().front().stepDn;
  return CommonDivisor(valuesDn);
}

} // namespace

double
FindSpacingDn(const DnHistogram & minima, const DnHistogram & maxima, const DnSettings & settings)
{
  DnRange range;
  return SetStep(OccupiedDn(minima, maxima), minima, maxima, settings, range);
}

DnRange
FindDnRange(const DnHistogram &   minima,
            const DnHistogram &   maxima,
            double                typicalVarianceDn2,
            const DnSettings &    settings,
            const ExtremeDepths & depths)
{
  const std::vector<std::int32_t> valuesDn = OccupiedDn(minima, maxima);
  if (valuesDn.empty())
  {
    throw std::invalid_argument("the stack holds no pixel");
  }
  DnRange        range;
  const double   step = SetStep(valuesDn, minima, maxima, settings, range);
  const double   top = SetBitDepth(valuesDn.back(), step, settings, range);
  const Extremes extremes{ minima,
                           maxima,
                           valuesDn,
                           FindEndOfDnRange(minima, false, step),
                           FindEndOfDnRange(maxima, true, step),
                           typicalVarianceDn2,
                           depths };
  SetClipLevels(extremes, step, top, settings, range);
  return range;
}

DnRange
GivenDnRange(const DnSettings & settings)
{
  DnRange range;
  range.bitDepth = settings.bitDepth;
  range.bitDepthSource = settings.bitDepth ? "given" : "none";
  range.quantisationStepDn = settings.quantisationStepDn.value_or(0.0);
  range.clipLowDn = settings.clipLowDn;
  range.clipHighDn = settings.clipHighDn;
  range.clipSource = settings.clipLowDn || settings.clipHighDn ? "given" : "none";
  return range;
}

namespace
{

/** Returns whether the outermost of \a levels is a saturation level. \a stepDn is their spacing, if it is known [DN].
 */
bool
HasClipLevel(const OutermostLevels & levels, std::optional<double> stepDn, double typicalVarianceDn2, double depth)
{
  const double step = stepDn.value_or(levels.Step());
  return IsClipEvidence(typicalVarianceDn2, step, depth) && IsClipLevel(levels.Pixels(), levels.MostInside(step));
}

/** Returns "given", "pile-up" or "none". */
std::string
SourceOf(bool isGiven, bool isClipLevel)
{
  return isGiven ? "given" : (isClipLevel ? "pile-up" : "none");
}

} // namespace

DnRange
FindLevels(const OutermostLevels & minima,
           const OutermostLevels & maxima,
           double                  typicalVarianceDn2,
           const DnSettings &      settings,
           const ExtremeDepths &   depths)
{
  DnRange range = GivenDnRange(settings);
  if (minima.Pixels() > 0 && maxima.Pixels() > 0 && minima.Level() == maxima.Level())
  {
    return range;
  }
  const auto & step = settings.quantisationStepDn;
  const bool   low = !settings.clipLowDn && HasClipLevel(minima, step, typicalVarianceDn2, depths.low);
  const bool   high = !settings.clipHighDn && HasClipLevel(maxima, step, typicalVarianceDn2, depths.high);
  if (low || high)
  {
    range.clipLowDn = low ? minima.Level() : settings.clipLowDn;
    range.clipHighDn = high ? maxima.Level() : settings.clipHighDn;
    const std::string lowSource = SourceOf(settings.clipLowDn.has_value(), low);
    const std::string highSource = SourceOf(settings.clipHighDn.has_value(), high);
    range.SetClipSources(lowSource, highSource);
  }
  return range;
}

} // namespace sensornoise
