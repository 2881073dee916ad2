// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/UsablePixels.h"

#include "base/Constants.h"
#include "base/NothingToMeasure.h"
#include "sensornoise/Report.h"
#include "base/Stencils.h"
#include "base/Text.h"
#include "base/BoxSum.h"
#include "moments/Constants.h"
#include "scene/InitialNoiseModel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace sensornoise
{

namespace
{
/** Returns the use of pixel \a p, which the user did not mask. */
PixelUse
UseOf(const ReferenceFrame & frame, const std::vector<std::uint8_t> & valid, std::size_t p)
{
  if (frame.usable[p] != 0)
  {
    return PixelUse::Used;
  }
  if (valid[p] == 0)
  {
    return std::isfinite(frame.variance[p]) ? PixelUse::Clipped : PixelUse::NotFinite;
  }
  if (std::isnan(frame.variance[p]))
  {
    return PixelUse::Outlier;
  }
  if (!(frame.variance[p] > 0.0))
  {
    return PixelUse::Constant;
  }
  const std::size_t x = p % frame.geometry.width;
  const std::size_t y = p / frame.geometry.width;
  const bool        isInner = x >= StencilMargin && x + StencilMargin < frame.geometry.width && y >= StencilMargin &&
                       y + StencilMargin < frame.geometry.height;
  return isInner ? PixelUse::NearClip : PixelUse::Border;
}

/** Illumination of the frames about their average [DN]. */
struct FrameLevels
{
  double lowest;   ///< mean of the darkest frame less the average [DN]
  double highest;  ///< mean of the brightest frame less the average [DN]
  double average;  ///< mean of all frames [DN]
  double variance; ///< variance of the means [DN^2]
};

FrameLevels
LevelsOfFrames(const std::vector<double> & frameMeans)
{
  const auto   count = static_cast<double>(frameMeans.size());
  const double average = std::accumulate(frameMeans.begin(), frameMeans.end(), 0.0) / count;
  const auto [lowest, highest] = std::minmax_element(frameMeans.begin(), frameMeans.end());
  const double squares = std::accumulate(frameMeans.begin(), frameMeans.end(), 0.0, [average](double sum, double mean) {
    return sum + (mean - average) * (mean - average);
  });
  return { *lowest - average, *highest - average, average, squares / std::max(1.0, count - 1.0) };
}

/** Returns the fraction of the model's noise at the centre that is not due to the illumination of the frames. Where the
 * scene has little contrast, the model takes that for noise, of at most strongChangeOfFlat times the noise. */
double
FractionOfNoise(const InitialNoiseModel & model, const FrameLevels & levels)
{
  const double rawDn2 = model.RawVariance(model.centreDn, 0.0, 0.0);
  const double noiseDn2 = std::max(rawDn2 / (1.0 + InMoments.strongChangeOfFlat), rawDn2 - levels.variance);
  return std::min(1.0, noiseDn2 / model.NoiseVariance(model.centreDn));
}

/** Returns the largest possible offset [DN]: no mean of a frame is below the offset. */
double
HighestOffset(const InitialNoiseModel & model, const FrameLevels & levels)
{
  return std::min(model.darkestDn, levels.average + levels.lowest);
}

/** Returns the range of the illumination, about the largest possible offset. The illumination may change differently
 * from place to place, and leave the means of the frames as they are. */
IlluminationRange
RangeOfIllumination(const InitialNoiseModel & model, const FrameLevels & levels)
{
  const double typical =
    InScene.typicalFlickerSds * std::sqrt(model.flickerVariance) * (model.centreDn - model.darkestDn);
  const double offsetDn = HighestOffset(model, levels);
  return { std::min(levels.lowest, -typical),       std::max(levels.highest, typical), offsetDn, offsetDn,
           std::numeric_limits<double>::infinity(), FractionOfNoise(model, levels) };
}

/** Returns the range of a strong change of the illumination, whose variance is not in the model. The variance at the
 * smallest possible offset is not negative. */
IlluminationRange
RangeOfStrongChange(const InitialNoiseModel & model, const FrameLevels & levels, double darkestNoiseDn2)
{
  const double highestDn = HighestOffset(model, levels);
  const double lowestDn = std::min(highestDn, model.darkestDn - model.interceptDn2 / model.slopeDn);
  return { levels.lowest, levels.highest, lowestDn, highestDn, darkestNoiseDn2, 1.0, true };
}
} // namespace

std::vector<std::uint8_t>
FindPixelUse(const ReferenceFrame &            frame,
             const std::vector<std::uint8_t> & valid,
             const std::vector<std::uint8_t> & userMask,
             const ParallelFor &               parallelFor)
{
  std::vector<std::uint8_t> pixelUse(frame.mean.size());
  ForPixels(pixelUse.size(), parallelFor, [&](std::size_t p) {
    const bool isMasked = !userMask.empty() && userMask[p] == 0;
    pixelUse[p] = static_cast<std::uint8_t>(isMasked ? PixelUse::Masked : UseOf(frame, valid, p));
  });
  return pixelUse;
}

UsablePixels
ExcludeCoarseAndGuarded(const ReferenceFrame &        frame,
                        const InitialNoiseModel &     model,
                        const DnRange &               dnRange,
                        const std::vector<double> &   frameMeans,
                        std::vector<std::uint8_t>     pixelUse,
                        const ParallelFor &           parallelFor,
                        const std::optional<double> & darkestNoiseDn2)
{
  const FrameLevels       levels = LevelsOfFrames(frameMeans);
  const IlluminationRange range =
    darkestNoiseDn2 ? RangeOfStrongChange(model, levels, *darkestNoiseDn2) : RangeOfIllumination(model, levels);
  const auto   guarded = FindGuardBand(frame, model, dnRange, range, parallelFor);
  UsablePixels pixels;
  pixels.usable = frame.usable;
  pixels.pixelUse = std::move(pixelUse);
  const auto counts = SumOverBlocks<4>(guarded.size(), parallelFor, [&](std::size_t p, std::array<double, 4> & count) {
    if (frame.usable[p] != 0)
    {
      const double level = frame.neighbourMean[p];
      const double step = dnRange.StepAt(level);
      const bool   isCoarse = step > 0.0 && model.NoiseVariance(level) < InCommon.hiddenVariance * step * step;
      if (isCoarse || guarded[p] != 0)
      {
        pixels.pixelUse[p] = static_cast<std::uint8_t>(isCoarse ? PixelUse::CoarseQuantisation : PixelUse::NearClip);
        pixels.usable[p] = 0;
        count[isCoarse ? 1 : 2] += 1.0;
        count[3] += isCoarse && dnRange.steps.IsCompanded() && level > model.centreDn ? 1.0 : 0.0;
      }
      count[0] += 1.0;
    }
  });
  pixels.coarse = static_cast<std::size_t>(counts[1]);
  pixels.nearClip = static_cast<std::size_t>(counts[2]);
  pixels.coarseWhereBright = static_cast<std::size_t>(counts[3]);
  pixels.count = counts[0] - counts[1] - counts[2];
  return pixels;
}

void
RequireFineQuantization(const UsablePixels & pixels, double stepDn)
{
  const auto   coarse = static_cast<double>(pixels.coarse - pixels.coarseWhereBright);
  const double all = pixels.count + static_cast<double>(pixels.coarse + pixels.nearClip);
  if (coarse > InScene.largestCoarseFraction * all)
  {
    throw NothingToMeasure("the noise of " + PercentApart(coarse / all, InScene.largestCoarseFraction) +
                             " of the pixels, the darkest, is below half the quantization step of " + Text(stepDn) +
                             " DN, which hides it (expected at most " + Percent(InScene.largestCoarseFraction) +
                             " of the pixels). Use more bits, or a higher analogue gain",
                           WarningCode::CodesTooCoarse);
  }
}

namespace
{
/** Clip levels, and the extremes of the frames about an offset that are compared with them. */
struct Guard
{
  double offsetDn;        ///< about which the signal scales [DN]
  double lowDn;           ///< level that the noise must not reach [DN]
  double highDn;          ///< level that the noise must not reach [DN]
  double darkest;         ///< brightness of the darkest frame, relative to the mean frame, less 1 [1]
  double brightest;       ///< brightness of the brightest frame, relative to the mean frame, less 1 [1]
  double motionInDarkest; ///< variance by motion in the darkest frame, relative to the mean frame [1]
  double motionInBrightest;
  double lowestNoiseDn2;  ///< as in IlluminationRange
  double fractionOfNoise; ///< as in IlluminationRange
  double sds;             ///< distance in standard deviations [1]
};

Guard
GuardAbout(double offsetDn, const IlluminationRange & range, double centreDn, const DnRange & dnRange, double sds)
{
  constexpr double never = std::numeric_limits<double>::infinity();
  const double     signal = std::max(smallestDivisor, centreDn - offsetDn);
  const double     darkest = std::max(-1.0, range.lowestDn / signal);
  const double     brightest = range.highestDn / signal;
  const auto motionIn = [&range](double change) { return range.scalesMotion ? (1.0 + change) * (1.0 + change) : 1.0; };
  return { offsetDn,
           dnRange.clipLowDn ? *dnRange.clipLowDn + 0.5 * dnRange.StepAt(*dnRange.clipLowDn) : -never,
           dnRange.clipHighDn ? *dnRange.clipHighDn - 0.5 * dnRange.StepAt(*dnRange.clipHighDn) : never,
           darkest,
           brightest,
           motionIn(darkest),
           motionIn(brightest),
           range.lowestNoiseDn2,
           range.fractionOfNoise,
           sds };
}

/** Marks the usable pixels of [begin, end) that reach a clip level. The noise is evaluated at the levels that are
 * reached, so that in a dark frame it is small. Small arguments are passed by value: by reference they could alias the
 * output, which prevents vectorization. */
void
MarkGuarded(const ReferenceFrame & frame,
            InitialNoiseModel      model,
            Guard                  guard,
            std::size_t            begin,
            std::size_t            end,
            std::uint8_t *         guarded)
{
  const double * const       mean = frame.mean.data();
  const float * const        neighbourMean = frame.neighbourMean.data();
  const std::uint8_t * const usable = frame.usable.data();
  const std::size_t          width = frame.geometry.width;
  for (std::size_t p = begin; p < end; ++p)
  {
    const auto [gx, gy] = ApplyGradient(mean, width, p);
    const double level = neighbourMean[p];
    const double signal = std::max(0.0, level - guard.offsetDn);
    const double motion = model.MotionVariance(gx, gy);
    const double highDn = level + guard.brightest * signal;
    const double lowDn = level + guard.darkest * signal;
    const double highNoise = guard.fractionOfNoise * model.NoiseVariance(highDn);
    const double lowNoise = std::min(guard.lowestNoiseDn2, model.NoiseVariance(lowDn));
    const double high = highDn + guard.sds * std::sqrt(highNoise + guard.motionInBrightest * motion);
    const double low = lowDn - guard.sds * std::sqrt(lowNoise + guard.motionInDarkest * motion);
    const bool   isReached = (high >= guard.highDn) | (low <= guard.lowDn); // no short-circuit, to avoid a branch
    guarded[p] = usable[p] != 0 && isReached ? 1 : guarded[p];
  }
}
} // namespace

std::vector<std::uint8_t>
FindGuardBand(const ReferenceFrame &    frame,
              const InitialNoiseModel & model,
              const DnRange &           dnRange,
              const IlluminationRange & range,
              const ParallelFor &       parallelFor,
              double                    sds)
{
  std::vector<std::uint8_t> guarded(frame.mean.size(), 0);
  if (!dnRange.clipLowDn && !dnRange.clipHighDn)
  {
    return guarded;
  }
  const auto markAbout = [&](double offsetDn) {
    const Guard guard = GuardAbout(offsetDn, range, model.centreDn, dnRange, sds);
    ForInnerBlocks(frame.geometry, parallelFor, [&](std::size_t begin, std::size_t end) {
      MarkGuarded(frame, model, guard, begin, end, guarded.data());
    });
  };
  markAbout(range.highestOffsetDn);
  if (range.lowestOffsetDn < range.highestOffsetDn)
  {
    markAbout(range.lowestOffsetDn);
  }
  return guarded;
}

namespace
{
/** Marks the pixels [begin, end) whose \a variance \a model does not explain. The model is passed by value: by
 * reference it could alias the output, which prevents vectorization. */
template <typename TNumber>
void
MarkOutlierPixels(const ReferenceFrame & frame,
                  const TNumber *        variance,
                  InitialNoiseModel      model,
                  std::size_t            begin,
                  std::size_t            end,
                  std::uint8_t *         outliers)
{
  const double * const       mean = frame.mean.data();
  const float * const        level = frame.neighbourMean.data();
  const std::uint8_t * const usable = frame.usable.data();
  const std::size_t          width = frame.geometry.width;
  const double               leastDn2 = InCommon.lowestFraction * model.interceptDn2;
  for (std::size_t p = begin; p < end; ++p)
  {
    const auto [gx, gy] = ApplyGradient(mean, width, p);
    const double expected = std::max(leastDn2, model.RawVariance(level[p], gx, gy));
    const bool   isAbove = variance[p] > model.largestRatio * expected;
    outliers[p] = usable[p] != 0 && isAbove ? 1 : 0;
  }
  for (std::size_t p = begin; p < end && model.isSharp; ++p) // apart from the first loop, which is vectorized
  {
    if (outliers[p] != 0)
    {
      const double largest = model.LargestVariance(level[p], SquaredStepsNear(mean, width, p));
      outliers[p] = variance[p] > largest ? 1 : 0;
    }
  }
}
} // namespace

std::vector<std::uint8_t>
FindOutlierPixels(const ReferenceFrame & frame, const InitialNoiseModel & model, const ParallelFor & parallelFor)
{
  std::vector<std::uint8_t> outliers(frame.mean.size(), 0);
  ForInnerBlocks(frame.geometry, parallelFor, [&](std::size_t begin, std::size_t end) {
    frame.variance.Visit(
      [&](const auto & variance) { MarkOutlierPixels(frame, variance.data(), model, begin, end, outliers.data()); });
  });
  const std::size_t         width = frame.geometry.width;
  const auto                rows = [&] { return RowsOf(outliers, width); };
  std::vector<std::uint8_t> crowded(outliers.size());
  ForBoxRows(rows, width, frame.geometry.height, 3, parallelFor, [&](std::size_t y, const double * crowd) {
    const double most = InCommon.largestOutlierFraction * 49.0;
    std::transform(crowd,
                   crowd + width,
                   outliers.data() + y * width,
                   crowded.data() + y * width,
                   [most](double near, std::uint8_t own) { return near > most ? std::uint8_t{ 2 } : own; });
  });
  return crowded;
}

} // namespace sensornoise
