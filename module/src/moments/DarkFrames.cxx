// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/DarkFrames.h"

#include "sensornoise/Parallel.h"
#include "sensornoise/FrameGeometry.h"
#include "base/Quantiles.h"
#include "base/Text.h"
#include "sensornoise/StepResults.h"
#include "sensornoise/Settings.h"
#include "moments/Constants.h"
#include "moments/DarkDrift.h"
#include "moments/DarkMaps.h"
#include "moments/DefectivePixels.h"
#include "moments/NoiseMedian.h"
#include "moments/RoundingError.h"
#include "moments/StackMaps.h"
#include "moments/TemporalMaps.h"
#include "moments/TemporalMoments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{

/** Result for all pixels, whether they are used or not. */
struct DarkSurvey
{
  DarkMaps    maps;
  CodeRange   codes;
  std::size_t usable{ 0 };
  std::size_t clipped{ 0 };
};

/** Computes the offsets, the variances without the drift, and the pixels that are finite, never clipped and not masked.
 * Moves the mean and the variance out of \a ofStack. */
template <typename TPixel>
DarkSurvey
SurveyPixels(TemporalMaps<TPixel> &            ofStack,
             std::size_t                       frames,
             const CodeSettings &              codes,
             const std::vector<std::uint8_t> & mask,
             const ParallelFor &               parallelFor,
             const DarkDrift &                 drift)
{
  constexpr double  nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t pixels = ofStack.GetNumberOfPixels();
  const double      dof = static_cast<double>(frames) - 1.0;
  DarkSurvey        survey;
  DarkMaps &        maps = survey.maps;
  maps.frames = frames;
  maps.usable.resize(pixels);
  survey.codes = SummariseStack<TPixel>(ofStack, codes, parallelFor, maps.usable.data()).codes;
  maps.offsetDn = std::move(ofStack.mean);
  maps.varianceDn2 = std::move(ofStack.variance);
  maps.stepDn = survey.codes.quantisationStepDn;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    const bool isMasked = !mask.empty() && mask[p] == 0;
    survey.clipped += !isMasked && maps.usable[p] == 0 && std::isfinite(maps.offsetDn[p]) ? 1 : 0;
    maps.usable[p] = isMasked ? 0 : maps.usable[p];
    survey.usable += maps.usable[p];
    const double squares = dof * maps.varianceDn2[p];
    maps.varianceDn2[p] =
      maps.usable[p] != 0 && frames > 1 ? drift.SquaresWithoutDrift(p, squares, maps.offsetDn[p]) / dof : nan;
    maps.offsetDn[p] = maps.usable[p] != 0 ? maps.offsetDn[p] : nan;
  }
  return survey;
}

/** Throws std::invalid_argument if the pixels do not determine the offset. */
void
RequireDarkLevel(const DarkSurvey & survey)
{
  // Some dead pixels do no harm, nor does a clipped sample in a thousand.
  const auto   frames = static_cast<double>(survey.maps.frames);
  const auto   clipped = static_cast<double>(survey.clipped);
  const double clippedFraction = clipped / (clipped + static_cast<double>(survey.usable));
  if (clippedFraction >
      std::max(InMoments.largestClippedFraction, 1.0 - std::pow(InMoments.leastUnclippedFraction, frames)))
  {
    const CodeRange & range = survey.codes;
    const auto        levelText = [](const std::optional<double> & level) { return level ? Text(*level) : "none"; };
    throw std::invalid_argument(PercentApart(clippedFraction, InMoments.largestClippedFraction) +
                                " of the pixels of the dark frames reach a clip level, " + levelText(range.clipLowDn) +
                                " or " + levelText(range.clipHighDn) +
                                " DN; expected at most 1 %: their black level is cut off, or they are not dark. Raise "
                                "the camera's black level, or cover the sensor");
  }
  if (survey.usable < InMoments.fewestDarkPixels)
  {
    throw std::invalid_argument("only " + std::to_string(survey.usable) +
                                " pixels of the dark frames are usable; expected at least " +
                                std::to_string(InMoments.fewestDarkPixels) +
                                ". Record dark frames of the whole sensor, or correct --mask, --roi or --clip");
  }
}

/** Returns the values of the usable pixels. */
std::vector<double>
UsableValues(const std::vector<double> & values, const std::vector<std::uint8_t> & usable)
{
  std::vector<double> used;
  for (std::size_t p = 0; p < values.size(); ++p)
  {
    if (usable[p] != 0)
    {
      used.push_back(values[p]);
    }
  }
  return used;
}

/** Returns the probability that a pixel of this noise holds one code in all frames, in the worst case: its level lies
 * on the code. */
double
ChanceOfOneCode(double noiseDn, double stepDn, double frames)
{
  return std::pow(std::erf(stepDn / (noiseDn * std::sqrt(8.0))), frames - 1.0);
}

/** Marks the defective pixels as not usable. Returns their number. */
template <typename TPixel>
std::size_t
ExcludeDefective(DarkMaps & maps, const TemporalMaps<TPixel> & ofStack)
{
  const double dof = static_cast<double>(maps.frames) - 1.0;
  const double share = MedianToMeanOfVariance(dof);
  // A variance below the quantization noise is not significant.
  const double medianDn2 =
    std::max(QuantileOf(UsableValues(maps.varianceDn2, maps.usable), 0.5), share * maps.stepDn * maps.stepDn / 12.0);
  if (!(medianDn2 > 0.0))
  {
    return 0; // nothing to compare with
  }
  const double limitDn2 = DefectiveVarianceDn2(medianDn2, dof);
  const double typicalDn = std::sqrt(medianDn2 / share);
  const bool   mustChange =
    ChanceOfOneCode(typicalDn, maps.stepDn, static_cast<double>(maps.frames)) < InMoments.chanceOfStuck;
  std::size_t defective = 0;
  for (std::size_t p = 0; p < maps.usable.size(); ++p)
  {
    const bool isStuck = mustChange && ofStack.GetMinimum(p) == ofStack.GetMaximum(p);
    if (maps.usable[p] != 0 && (isStuck || maps.varianceDn2[p] > limitDn2))
    {
      maps.usable[p] = 0;
      ++defective;
    }
  }
  return defective;
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
MeasureDarkFrames(TemporalMoments<TPixel>           moments,
                  const CodeSettings &              codes,
                  const std::vector<std::uint8_t> & mask,
                  const ParallelFor &               parallelFor,
                  const DarkDrift &                 drift)
{
  const std::size_t    frames = moments.GetNumberOfFrames();
  TemporalMaps<TPixel> ofStack = moments.TakeMaps(parallelFor);
  DarkSurvey           survey = SurveyPixels<TPixel>(ofStack, frames, codes, mask, parallelFor, drift);
  RequireDarkLevel(survey);
  DarkMaps &          maps = survey.maps;
  std::vector<double> levels = UsableValues(maps.offsetDn, maps.usable);
  const double        low = Quantile(levels, 0.16);
  const double        high = Quantile(levels, 0.84);
  const double        median = Quantile(levels, 0.5);
  const double        reach = InMoments.levelReach * std::max(high - low, maps.stepDn);
  const MeanOfPixels  level = MeanWithin(levels, median - reach, median + reach);
  double              spreadDn2 = 0.25 * (high - low) * (high - low);
  KnownOffset         dark;
  dark.valueDn = level.value;
  dark.darkFrames = maps.frames;
  if (dark.darkFrames > 1)
  {
    dark.numberDefective = ExcludeDefective<TPixel>(maps, ofStack);
    const std::vector<double> variances = UsableValues(maps.varianceDn2, maps.usable);
    const MeanOfPixels        mean = MeanWithin(variances, 0.0, std::numeric_limits<double>::max());
    dark.variance = { mean.value, mean.standardError };
    dark.readNoiseMedian = MedianReadNoiseOf(variances, static_cast<double>(maps.frames) - 1.0, maps.stepDn);
    dark.driftVarianceDn2 = drift.GetVarianceDn2(mean.value);
    spreadDn2 += mean.value;
    dark.maps = std::make_shared<const DarkMaps>(std::move(maps));
  }
  const double driftErrorDn = std::sqrt(dark.driftVarianceDn2 / static_cast<double>(dark.darkFrames));
  dark.standardErrorDn =
    std::hypot(level.standardError, driftErrorDn, RoundingErrorDn(survey.codes.quantisationStepDn, spreadDn2));
  return dark;
}

#define SensorNoise_INSTANTIATE(TPixel)                                                                \
  template SensorNoise_EXPORT KnownOffset MeasureDarkFrames<TPixel>(TemporalMoments<TPixel>,           \
                                                                    const CodeSettings &,              \
                                                                    const std::vector<std::uint8_t> &, \
                                                                    const ParallelFor &,               \
                                                                    const DarkDrift &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
