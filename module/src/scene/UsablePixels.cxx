// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/UsablePixels.h"

#include "base/Constants.h"
#include "base/NothingToMeasure.h"
#include "sensornoise/Report.h"
#include "base/Stencils.h"
#include "base/Text.h"
#include "scene/Constants.h"
#include "scene/GuardBand.h"

#include <algorithm>
#include <array>
#include <cmath>
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

} // namespace sensornoise
