// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/DarkFrames.h"

#include "sensornoise/Parallel.h"
#include "sensornoise/FrameGeometry.h"
#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Quantiles.h"
#include "moments/Constants.h"
#include "base/Text.h"
#include "sensornoise/StepResults.h"
#include "sensornoise/Settings.h"
#include "moments/StackMaps.h"
#include "moments/TemporalMoments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{

/** Returns the finite values of the pixels \a sample of a frame [DN]. */
template <typename TPixel>
std::vector<double>
FiniteValues(const TPixel * frame, const std::vector<std::size_t> & sample)
{
  std::vector<double> values;
  values.reserve(sample.size());
  for (const std::size_t p : sample)
  {
    const auto value = static_cast<double>(frame[p]);
    if (std::isfinite(value))
    {
      values.push_back(value);
    }
  }
  return values;
}

} // namespace

DarkDrift::DarkDrift(std::size_t pixels, std::vector<std::uint8_t> mask)
  : m_Mask(mask.empty() ? std::vector<std::uint8_t>(pixels, 1) : std::move(mask))
  , m_Sample(SamplePixels(m_Mask))
  , m_ProductsDn2(pixels, 0.0)
{}

template <typename TPixel>
double
DarkDrift::MedianOf(const TPixel * frame) const
{
  std::vector<double> values = FiniteValues(frame, m_Sample);
  return values.empty() ? 0.0 : Quantile(values, 0.5);
}

template <typename TPixel>
double
DarkDrift::LevelOf(const TPixel * frame) const
{
  const double medianDn = MedianOf(frame);
  double       sum = 0.0;
  double       count = 0.0;
  for (std::size_t p = 0; p < m_Mask.size(); ++p)
  {
    const double above = static_cast<double>(frame[p]) - medianDn;
    if (m_Mask[p] != 0 && std::abs(above) <= m_ReachDn)
    {
      sum += above;
      count += 1.0;
    }
  }
  return count > 0.0 ? medianDn + sum / count : medianDn;
}

template <typename TPixel>
void
DarkDrift::Start(const TPixel * frame)
{
  std::vector<double> values = FiniteValues(frame, m_Sample);
  // At least one DN, so that rounding does not reduce the reach to 0.
  const double leastDn = std::is_integral_v<TPixel> ? 1.0 : 0.0;
  m_ReachDn = values.empty()
                ? 0.0
                : 0.5 * Significance.everyPixel * std::max(leastDn, Quantile(values, 0.84) - Quantile(values, 0.16));
  const double medianDn = MedianOf(frame);
  for (std::size_t p = 0; p < m_Mask.size(); ++p)
  {
    m_LevelPixels += m_Mask[p] != 0 && std::abs(static_cast<double>(frame[p]) - medianDn) <= m_ReachDn ? 1.0 : 0.0;
  }
}

template <typename TPixel>
void
DarkDrift::AddFrames(const TPixel * frames, std::size_t count, const ParallelFor & parallelFor)
{
  const std::size_t pixels = m_ProductsDn2.size();
  const std::size_t first = m_LevelsDn.size();
  if (first == 0 && count > 0)
  {
    Start(frames);
  }
  m_LevelsDn.resize(first + count);
  parallelFor(count, [&](std::size_t k) { m_LevelsDn[first + k] = LevelOf(frames + k * pixels); });
  for (std::size_t t = first; t < first + count; ++t)
  {
    const double driftDn = m_LevelsDn[t] - m_LevelsDn[0];
    m_SumDn += driftDn;
    m_SumOfSquaresDn2 += driftDn * driftDn;
  }
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = 0; k < count; ++k)
    {
      const double   driftDn = m_LevelsDn[first + k] - m_LevelsDn[0];
      const TPixel * frame = frames + k * pixels;
      for (std::size_t p = begin; p < end; ++p)
      {
        m_ProductsDn2[p] += (static_cast<double>(frame[p]) - m_LevelsDn[0]) * driftDn;
      }
    }
  });
}

double
DarkDrift::SquaresWithoutDrift(std::size_t p, double sumOfSquaresDn2, double meanDn) const
{
  if (m_LevelsDn.size() < 2 || m_LevelPixels < 2.0)
  {
    return sumOfSquaresDn2;
  }
  const double products = m_ProductsDn2[p] - (meanDn - m_LevelsDn[0]) * m_SumDn;
  // The level of a frame contains a part of the noise of the pixel itself.
  const double factor = m_LevelPixels / (m_LevelPixels - 1.0);
  return std::max(0.0, sumOfSquaresDn2 - 2.0 * products + GetSumOfSquaresDn2()) * factor;
}

double
DarkDrift::GetSumOfSquaresDn2() const
{
  return m_LevelsDn.empty() ? 0.0 : m_SumOfSquaresDn2 - m_SumDn * m_SumDn / static_cast<double>(m_LevelsDn.size());
}

double
DarkDrift::GetRangeDn() const
{
  const auto [low, high] = std::minmax_element(m_LevelsDn.begin(), m_LevelsDn.end());
  return m_LevelsDn.empty() ? 0.0 : *high - *low;
}

double
DarkDrift::GetVarianceDn2(double pixelVarianceDn2) const
{
  if (m_LevelsDn.size() < 2 || m_LevelPixels < 2.0)
  {
    return 0.0;
  }
  const double levels = GetSumOfSquaresDn2() / static_cast<double>(m_LevelsDn.size() - 1);
  return std::max(0.0, levels - pixelVarianceDn2 / m_LevelPixels);
}

double
DarkDrift::GetMeanErrorDn(double pixelVarianceDn2) const
{
  const std::size_t frames = m_LevelsDn.size();
  const double      varianceDn2 = this->GetVarianceDn2(pixelVarianceDn2);
  const double      independent = varianceDn2 > 0.0 ? std::sqrt(varianceDn2 / static_cast<double>(frames)) : 0.0;
  const std::size_t half = frames / 2;
  if (half < InMoments.fewestFramesOfHalf)
  {
    return independent;
  }
  // A trend has no part in the differences of neighbours (von Neumann 1941).
  double successive = 0.0;
  double difference = 0.0;
  for (std::size_t t = 0; t + 1 < frames; ++t)
  {
    successive += std::pow(m_LevelsDn[t + 1] - m_LevelsDn[t], 2) / (2.0 * static_cast<double>(frames - 1));
  }
  for (std::size_t t = 0; t < half; ++t)
  {
    difference += (m_LevelsDn[t] - m_LevelsDn[frames - 1 - t]) / static_cast<double>(half);
  }
  const double chance = 2.0 * successive / static_cast<double>(half);
  return std::hypot(independent, 0.5 * SizeBeyondChance(difference, chance, Significance.oneTest));
}

#define SensorNoise_INSTANTIATE(TPixel) \
  template SensorNoise_EXPORT void DarkDrift::AddFrames<TPixel>(const TPixel *, std::size_t, const ParallelFor &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

namespace
{

/** Result for all pixels, whether they are used or not. */
struct DarkSurvey
{
  DarkMaps    maps;
  DnRange     dnRange;
  std::size_t usable{ 0 };
  std::size_t clipped{ 0 };
};

/** Computes the offsets, the variances without the drift, and the pixels that are finite, never clipped and not masked.
 * Moves the mean and the variance out of \a ofStack. */
template <typename TPixel>
DarkSurvey
SurveyPixels(TemporalMaps<TPixel> &            ofStack,
             std::size_t                       frames,
             const DnSettings &                dnSettings,
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
  survey.dnRange = SummariseStack<TPixel>(ofStack, dnSettings, parallelFor, maps.usable.data()).dnRange;
  maps.offsetDn = std::move(ofStack.mean);
  maps.varianceDn2 = std::move(ofStack.variance);
  maps.stepDn = survey.dnRange.quantisationStepDn;
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
    const DnRange & range = survey.dnRange;
    const auto      levelText = [](const std::optional<double> & level) { return level ? Text(*level) : "none"; };
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

/** Returns the probability that a pixel of this noise holds the same value in all frames, in the worst case: its level
 * lies on a digital number. */
double
ChanceOfConstantValue(double noiseDn, double stepDn, double frames)
{
  return std::pow(std::erf(stepDn / (noiseDn * std::sqrt(8.0))), frames - 1.0);
}

/** Returns the median of the variances of the usable pixels [DN^2]. A variance below the quantization noise is not
 * significant. */
double
MedianVarianceDn2(const DarkMaps & maps)
{
  const double factor = MedianToMeanOfVariance(static_cast<double>(maps.frames) - 1.0);
  return std::max(QuantileOf(UsableValues(maps.varianceDn2, maps.usable), 0.5),
                  factor * maps.stepDn * maps.stepDn / 12.0);
}

/** Marks the pixels with one value beyond chance, as by a cosmic ray, as not usable. Returns their number.
 *
 * The extreme value is compared with the other values of its pixel by Student's t, at the significance of many tests:
 * of 16 values, a pixel in 10^5 is left out by chance, which changes no mean. The standard deviation is at least the
 * typical one. The distance is without the drift of the level, which may be in one frame, too. A pixel that is noisy in
 * all frames stays, as its other values are noisy. */
template <typename TPixel>
std::size_t
ExcludeSpikes(DarkMaps & maps, const TemporalMaps<TPixel> & ofStack, double driftDn)
{
  const auto n = static_cast<double>(maps.frames);
  if (maps.frames < 3)
  {
    return 0; // one value has no scatter
  }
  const double typicalDn2 = MedianVarianceDn2(maps) / MedianToMeanOfVariance(n - 1.0);
  if (!(typicalDn2 > 0.0))
  {
    return 0; // nothing to compare with
  }
  const double chance = 0.5 * std::erfc(Significance.manyTests / std::sqrt(2.0));
  const double t = StudentQuantile(1.0 - chance, n - 2.0);
  std::size_t  spikes = 0;
  for (std::size_t p = 0; p < maps.usable.size(); ++p)
  {
    if (maps.usable[p] == 0)
    {
      continue;
    }
    const double furthest =
      std::max(ofStack.GetMaximum(p) - maps.offsetDn[p], maps.offsetDn[p] - ofStack.GetMinimum(p));
    const double distance = std::max(0.0, furthest - driftDn);
    const double squareDn2 = distance * distance * n / (n - 1.0);
    const double othersDn2 = ((n - 1.0) * maps.varianceDn2[p] - squareDn2) / (n - 2.0);
    if (squareDn2 > t * t * std::max(typicalDn2, othersDn2))
    {
      maps.usable[p] = 0;
      ++spikes;
    }
  }
  return spikes;
}

/** Marks the defective pixels as not usable. Returns their number. */
template <typename TPixel>
std::size_t
ExcludeDefective(DarkMaps & maps, const TemporalMaps<TPixel> & ofStack)
{
  const double dof = static_cast<double>(maps.frames) - 1.0;
  const double factor = MedianToMeanOfVariance(dof);
  const double medianDn2 = MedianVarianceDn2(maps);
  if (!(medianDn2 > 0.0))
  {
    return 0; // nothing to compare with
  }
  const double limitDn2 = DefectiveVarianceDn2(medianDn2, dof);
  const double typicalDn = std::sqrt(medianDn2 / factor);
  const bool   mustChange =
    ChanceOfConstantValue(typicalDn, maps.stepDn, static_cast<double>(maps.frames)) < InMoments.chanceOfStuck;
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
                  const DnSettings &                dnSettings,
                  const std::vector<std::uint8_t> & mask,
                  const ParallelFor &               parallelFor,
                  const DarkDrift &                 drift)
{
  const std::size_t    frames = moments.GetNumberOfFrames();
  TemporalMaps<TPixel> ofStack = moments.TakeMaps(parallelFor);
  DarkSurvey           survey = SurveyPixels<TPixel>(ofStack, frames, dnSettings, mask, parallelFor, drift);
  RequireDarkLevel(survey);
  DarkMaps &          maps = survey.maps;
  const std::size_t   spikes = ExcludeSpikes<TPixel>(maps, ofStack, drift.GetRangeDn());
  std::vector<double> levels = UsableValues(maps.offsetDn, maps.usable);
  const double        low = Quantile(levels, 0.16);
  const double        high = Quantile(levels, 0.84);
  const double        median = Quantile(levels, 0.5);
  const double        reach = 0.5 * Significance.everyPixel * std::max(high - low, maps.stepDn);
  const MeanOfPixels  level = MeanWithin(levels, median - reach, median + reach);
  double              spreadDn2 = 0.25 * (high - low) * (high - low);
  double              driftErrorDn = 0.0;
  KnownOffset         dark;
  dark.valueDn = level.value;
  dark.darkFrames = maps.frames;
  if (dark.darkFrames > 1)
  {
    dark.numberDefective = spikes + ExcludeDefective<TPixel>(maps, ofStack);
    const std::vector<double> variances = UsableValues(maps.varianceDn2, maps.usable);
    const MeanOfPixels        mean = MeanWithin(variances, 0.0, std::numeric_limits<double>::max());
    dark.variance = { mean.value, mean.standardError };
    dark.readNoiseMedian = MedianReadNoiseOf(variances, static_cast<double>(maps.frames) - 1.0, maps.stepDn);
    dark.driftVarianceDn2 = drift.GetVarianceDn2(mean.value);
    driftErrorDn = drift.GetMeanErrorDn(mean.value);
    spreadDn2 += mean.value;
    dark.maps = std::make_shared<const DarkMaps>(std::move(maps));
  }
  dark.standardErrorDn =
    AddInQuadrature(level.standardError, driftErrorDn, RoundingErrorDn(survey.dnRange.quantisationStepDn, spreadDn2));
  return dark;
}

#define SensorNoise_INSTANTIATE(TPixel)                                                                \
  template SensorNoise_EXPORT KnownOffset MeasureDarkFrames<TPixel>(TemporalMoments<TPixel>,           \
                                                                    const DnSettings &,                \
                                                                    const std::vector<std::uint8_t> &, \
                                                                    const ParallelFor &,               \
                                                                    const DarkDrift &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
