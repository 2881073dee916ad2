// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/GuardBand.h"

#include "base/Stencils.h"
#include "scene/InnerBlocks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sensornoise
{

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

} // namespace sensornoise
