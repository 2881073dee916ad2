// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_SingleImageTestHelper_h
#define sensornoise_test_SingleImageTestHelper_h

#include "sensornoise/Report.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/SingleImageMethod.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

/** \file
 * Single images of the paper's cameras, and what the method says of them. */

namespace sensornoise::test::single
{

/** Returns camera "A", "B" or "C" under condition 3 of the paper. */
inline SimulationSettings
PaperSettings(char camera, std::size_t frames = 1, std::uint64_t seed = 1)
{
  SimulationSettings settings;
  settings.camera = PaperCamera(camera);
  settings.frames = frames;
  settings.seed = seed;
  return settings;
}

template <typename TPixel>
std::vector<Report>
MeasureAll(const Stack<TPixel> &             stack,
           const SingleImageSettings &       settings = {},
           std::size_t                       chunk = 1,
           const std::vector<std::uint8_t> & mask = {},
           const ParallelFor &               parallelFor = SerialFor)
{
  SingleImageMethod<TPixel> method(settings, { stack.width, stack.height, 1 }, stack.frames, mask, parallelFor);
  for (std::size_t t = 0; t < stack.frames; t += chunk)
  {
    method.AddFrames(stack.Frame(t), std::min(chunk, stack.frames - t));
  }
  return method.GetReports();
}

/** Returns the report of a monochrome stack. */
template <typename TPixel>
Report
Measure(const Stack<TPixel> & stack, const SingleImageSettings & settings = {})
{
  return MeasureAll(stack, settings).front();
}

inline bool
HasWarning(const Report & report, WarningCode code)
{
  return std::any_of(
    report.warnings.begin(), report.warnings.end(), [code](const Warning & warning) { return warning.code == code; });
}

} // namespace sensornoise::test::single

#endif
