// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/UsablePixels.h"

#include "base/Constants.h"
#include "base/NothingToMeasure.h"
#include "sensornoise/Report.h"
#include "base/Stencils.h"
#include "base/Text.h"
#include "base/BoxSum.h"
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

/** Returns the smallest and the largest change of the brightness of a frame relative to the average, from the means of
 * the frames or from the model of the variance [1]. */
std::pair<double, double>
BrightnessExtremes(const ReferenceFrame &      frame,
                   const InitialNoiseModel &   model,
                   const std::vector<double> & frameMeans)
{
  const double average = std::accumulate(frameMeans.begin(), frameMeans.end(), 0.0) / static_cast<double>(frame.frames);
  const double flux = std::max(1e-3, model.centreDn - model.darkestDn);
  const auto [lowest, highest] = std::minmax_element(frameMeans.begin(), frameMeans.end());
  const double typical = InScene.typicalFlickerSds * std::sqrt(model.flickerVariance);
  const double brightest = std::max((*highest - average) / flux, typical);
  const double darkest = std::max(-1.0, std::min((*lowest - average) / flux, -typical));
  return { darkest, brightest };
}

/** Returns the range of the illumination in levels, and the range of the offset. No mean of a frame is below the
 * offset, and the variance at the offset is not negative. */
IlluminationRange
RangeOfIllumination(const ReferenceFrame &      frame,
                    const InitialNoiseModel &   model,
                    const std::vector<double> & frameMeans,
                    double                      darkestNoiseDn2)
{
  const double average = std::accumulate(frameMeans.begin(), frameMeans.end(), 0.0) / static_cast<double>(frame.frames);
  const auto [lowest, highest] = std::minmax_element(frameMeans.begin(), frameMeans.end());
  const double highestOffsetDn = std::min(model.darkestDn, *lowest);
  const double lowestOffsetDn = std::min(highestOffsetDn, model.darkestDn - model.interceptDn2 / model.slopeDn);
  return { *lowest - average, *highest - average, lowestOffsetDn, highestOffsetDn, darkestNoiseDn2 };
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
                        const CodeRange &             codes,
                        const std::vector<double> &   frameMeans,
                        std::vector<std::uint8_t>     pixelUse,
                        const ParallelFor &           parallelFor,
                        const std::optional<double> & darkestNoiseDn2)
{
  const auto [darkest, brightest] = BrightnessExtremes(frame, model, frameMeans);
  const auto guarded =
    darkestNoiseDn2
      ? FindGuardBand(frame, model, codes, RangeOfIllumination(frame, model, frameMeans, *darkestNoiseDn2), parallelFor)
      : FindGuardBand(frame, model, codes, brightest, darkest, parallelFor);
  UsablePixels pixels;
  pixels.usable = frame.usable;
  pixels.pixelUse = std::move(pixelUse);
  const auto counts = SumOverBlocks<4>(guarded.size(), parallelFor, [&](std::size_t p, std::array<double, 4> & count) {
    if (frame.usable[p] != 0)
    {
      const double level = frame.neighbourMean[p];
      const double step = codes.StepAt(level);
      const bool   isCoarse = step > 0.0 && model.NoiseVariance(level) < InCommon.hiddenVariance * step * step;
      if (isCoarse || guarded[p] != 0)
      {
        pixels.pixelUse[p] = static_cast<std::uint8_t>(isCoarse ? PixelUse::CoarseCodes : PixelUse::NearClip);
        pixels.usable[p] = 0;
        count[isCoarse ? 1 : 2] += 1.0;
        count[3] += isCoarse && codes.steps.IsCompanded() && level > model.centreDn ? 1.0 : 0.0;
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
/** Clip levels and their guard: levels that the noise must not reach [DN], relative brightness of the brightest and the
 * darkest frame [1], and distance in standard deviations [1]. */
struct GuardedLevels
{
  double lowDn;
  double highDn;
  double brightest;
  double darkest;
  double sds;
};

GuardedLevels
LevelsOf(const CodeRange & codes, double brightest, double darkest, double sds)
{
  constexpr double never = std::numeric_limits<double>::infinity();
  return { codes.clipLowDn ? *codes.clipLowDn + 0.5 * codes.StepAt(*codes.clipLowDn) : -never,
           codes.clipHighDn ? *codes.clipHighDn - 0.5 * codes.StepAt(*codes.clipHighDn) : never,
           brightest,
           darkest,
           sds };
}

/** Marks the usable pixels of [begin, end) that reach a clip level. Small arguments are passed by value: by reference
 * they could alias the output, which prevents vectorization. */
void
MarkGuarded(const ReferenceFrame & frame,
            InitialNoiseModel      model,
            GuardedLevels          guard,
            std::size_t            begin,
            std::size_t            end,
            std::uint8_t *         guarded)
{
  const double * const       mean = frame.mean.data();
  const double * const       neighbourMean = frame.neighbourMean.data();
  const std::uint8_t * const usable = frame.usable.data();
  const std::size_t          width = frame.geometry.width;
  for (std::size_t p = begin; p < end; ++p)
  {
    const auto [gx, gy] = ApplyGradient(mean, width, p);
    const double level = neighbourMean[p];
    const double flux = std::max(0.0, level - model.darkestDn);
    const double noise = model.NoiseVariance(level);
    const double motion = model.MotionVariance(gx, gy);
    const double high =
      level + guard.brightest * flux + guard.sds * std::sqrt(noise * (1.0 + guard.brightest) + motion);
    const double low = level + guard.darkest * flux - guard.sds * std::sqrt(noise + motion);
    const bool   isReached = (high >= guard.highDn) | (low <= guard.lowDn); // no short-circuit, to avoid a branch
    guarded[p] = usable[p] != 0 && isReached ? 1 : 0;
  }
}

/** Marks the usable pixels of [begin, end) that reach a clip level, if the signal scales about \a offsetDn. The noise
 * is evaluated at the levels that are reached, so that in a dark frame it is small. */
void
MarkGuardedAbout(double                 offsetDn,
                 double                 lowestNoiseDn2,
                 const ReferenceFrame & frame,
                 InitialNoiseModel      model,
                 GuardedLevels          guard,
                 std::size_t            begin,
                 std::size_t            end,
                 std::uint8_t *         guarded)
{
  const double * const       mean = frame.mean.data();
  const double * const       neighbourMean = frame.neighbourMean.data();
  const std::uint8_t * const usable = frame.usable.data();
  const std::size_t          width = frame.geometry.width;
  for (std::size_t p = begin; p < end; ++p)
  {
    const auto [gx, gy] = ApplyGradient(mean, width, p);
    const double signal = std::max(0.0, neighbourMean[p] - offsetDn);
    const double highest = 1.0 + guard.brightest;
    const double lowest = 1.0 + guard.darkest;
    const double motion = model.MotionVariance(gx, gy);
    const double highDn = offsetDn + highest * signal;
    const double lowDn = offsetDn + lowest * signal;
    const double high = highDn + guard.sds * std::sqrt(model.NoiseVariance(highDn) + highest * highest * motion);
    const double lowNoise = std::min(lowestNoiseDn2, model.NoiseVariance(lowDn));
    const double low = lowDn - guard.sds * std::sqrt(lowNoise + lowest * lowest * motion);
    const bool   isReached = (high >= guard.highDn) | (low <= guard.lowDn);
    guarded[p] = usable[p] != 0 && isReached ? 1 : guarded[p];
  }
}
} // namespace

std::vector<std::uint8_t>
FindGuardBand(const ReferenceFrame &    frame,
              const InitialNoiseModel & model,
              const CodeRange &         codes,
              double                    brightest,
              double                    darkest,
              const ParallelFor &       parallelFor,
              double                    sds)
{
  std::vector<std::uint8_t> guarded(frame.mean.size(), 0);
  if (!codes.clipLowDn && !codes.clipHighDn)
  {
    return guarded;
  }
  const GuardedLevels guard = LevelsOf(codes, brightest, darkest, sds);
  ForInnerBlocks(frame.geometry, parallelFor, [&](std::size_t begin, std::size_t end) {
    MarkGuarded(frame, model, guard, begin, end, guarded.data());
  });
  return guarded;
}

std::vector<std::uint8_t>
FindGuardBand(const ReferenceFrame &    frame,
              const InitialNoiseModel & model,
              const CodeRange &         codes,
              const IlluminationRange & range,
              const ParallelFor &       parallelFor,
              double                    sds)
{
  std::vector<std::uint8_t> guarded(frame.mean.size(), 0);
  if (!codes.clipLowDn && !codes.clipHighDn)
  {
    return guarded;
  }
  for (const double offsetDn : { range.lowestOffsetDn, range.highestOffsetDn })
  {
    const double        signal = std::max(1e-3, model.centreDn - offsetDn);
    const GuardedLevels guard = LevelsOf(codes, range.highestDn / signal, std::max(-1.0, range.lowestDn / signal), sds);
    ForInnerBlocks(frame.geometry, parallelFor, [&](std::size_t begin, std::size_t end) {
      MarkGuardedAbout(offsetDn, range.lowestNoiseDn2, frame, model, guard, begin, end, guarded.data());
    });
  }
  return guarded;
}

namespace
{
/** Marks the pixels [begin, end) whose variance \a model does not explain. The model is passed by value: by reference
 * it could alias the output, which prevents vectorization. */
void
MarkOutlierPixels(const ReferenceFrame & frame,
                  InitialNoiseModel      model,
                  std::size_t            begin,
                  std::size_t            end,
                  std::uint8_t *         outliers)
{
  const double * const       mean = frame.mean.data();
  const double * const       level = frame.neighbourMean.data();
  const double * const       variance = frame.variance.data();
  const std::uint8_t * const usable = frame.usable.data();
  const std::size_t          width = frame.geometry.width;
  const double               leastDn2 = InScene.leastFractionOfDarkest * model.interceptDn2;
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
    MarkOutlierPixels(frame, model, begin, end, outliers.data());
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
