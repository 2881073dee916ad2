// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_PublishedTestHelper_h
#define sensornoise_test_PublishedTestHelper_h

#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/ReportTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

/** \file
 * The published method, run on stacks. */

namespace sensornoise::test
{

using GreyValue = unsigned short;

/** Patches of 16 grey levels seen by camera B of the paper, with flicker, without vibration and without blur, whose
 * faint rims the vibration test keeps where their variance happens to be high. */
inline SimulationSettings
SettingsOf(double flickerSd, std::size_t frames)
{
  SimulationSettings settings;
  settings.conditions = { flickerSd, 0.0, 0.0 };
  settings.frames = frames;
  settings.opticalBlurPixels = 0.0;
  settings.seed = 5;
  return settings;
}

/** Returns a small stack of the calibration target. */
inline Stack<GreyValue>
Simulate(const SimulationSettings & settings, std::size_t width = 64, std::size_t height = 56)
{
  return Simulate<GreyValue>(settings, width, height);
}

/** Returns a stack for the identities: 40 frames with flicker of 5 %. */
inline const Stack<GreyValue> &
FlickeringStack()
{
  static const Stack<GreyValue> stack = Simulate(SettingsOf(0.05, 40));
  return stack;
}

inline PublishedSettings
WithGlobalShutter()
{
  PublishedSettings settings;
  settings.rollingShutter = RollingShutter::Off;
  return settings;
}

template <typename TPixel>
PublishedMethod<TPixel>
Measure(const Stack<TPixel> &             stack,
        const PublishedSettings &         settings = {},
        std::size_t                       chunk = 1000,
        const std::vector<std::uint8_t> & mask = {},
        const ParallelFor &               parallelFor = SerialFor)
{
  const FrameGeometry     geometry{ stack.width, stack.height, settings.shutterAxis };
  PublishedMethod<TPixel> method(settings, geometry, stack.frames, mask, parallelFor);
  while (!method.IsDone())
  {
    for (std::size_t t = 0; t < stack.frames; t += chunk)
    {
      method.AddFrames(stack.pixels.data() + t * geometry.Pixels(), std::min(chunk, stack.frames - t));
    }
    method.EndPass();
  }
  return method;
}

inline void
ExpectNothingMeasured(const Report & report, WarningCode code)
{
  for (const Quantity & quantity : { report.gain, report.offset, report.readNoise, report.intercept })
  {
    EXPECT_EQ(quantity.status, EstimateStatus::Failed);
    EXPECT_FALSE(quantity.value);
  }
  EXPECT_FALSE(report.IsUsable());
  EXPECT_TRUE(HasWarning(report, code)) << ToJson(report);
  EXPECT_EQ(report.pixels.used, 0u);
}

} // namespace sensornoise::test

#endif
