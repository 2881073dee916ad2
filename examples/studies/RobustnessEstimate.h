// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RobustnessEstimate_h
#define RobustnessEstimate_h

#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Report.h"
#include "studies/RobustnessRun.h"
#include "studies/StressStacks.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise::tools
{

/** A report, and the pixels that it is of. */
struct Estimation
{
  Report                    report;
  std::vector<std::uint8_t> isUsed; ///< 1: it used the pixel
};

/** Hands \a codes, frame after frame, to a method in all of its passes. */
template <typename TMethod, typename TPixel>
Estimation
EstimateBy(TMethod && method, const std::vector<TPixel> & codes, std::size_t frames)
{
  while (!method.IsDone())
  {
    method.AddFrames(codes.data(), frames);
    method.EndPass();
  }
  Estimation estimation{ method.GetReport(), {} };
  for (const std::uint8_t use : method.GetPixelUse())
  {
    estimation.isUsed.push_back(static_cast<PixelUse>(use) == PixelUse::Used ? 1 : 0);
  }
  return estimation;
}

/** Estimates a stack by a method, one thread. \a TMethod is PublishedMethod or RefinedMethod. */
template <template <typename> class TMethod>
Estimation
EstimateStack(const StressStack & stack)
{
  const FrameGeometry geometry{ stack.width, stack.height, 1 };
  if (stack.isEightBit)
  {
    const std::vector<std::uint8_t> bytes(stack.codes.begin(), stack.codes.end());
    return EstimateBy(TMethod<std::uint8_t>({}, geometry, stack.frames), bytes, stack.frames);
  }
  return EstimateBy(TMethod<std::uint16_t>({}, geometry, stack.frames), stack.codes, stack.frames);
}

/** Files in \a run what was estimated of \a stack, and how far it is from the truth of the pixels used. */
void
FileEstimation(Run & run, const StressStack & stack, const Estimation & estimation);

} // namespace sensornoise::tools

#endif
