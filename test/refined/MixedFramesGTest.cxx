// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"
#include "helpers/RefinedTestHelper.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

// Frames that are mixed with the frame before. A filter with constant weights keeps the covariance over all lags, which
// gives the gain. Weights that differ from frame to frame do not.

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
using GreyValue = unsigned short;

constexpr double      GainDn = 2.0;
constexpr std::size_t Frames = 30;
constexpr std::size_t FramesBefore =
  12; // frames that a recursive filter needs to settle: 0.4^12 of the first frame is left

Stack<GreyValue>
Unmixed(std::size_t width, std::size_t height, double vibrationPixels = 0.0)
{
  SimulationSettings settings = FlickeringSettings(Frames + FramesBefore);
  settings.camera = { 4000.0, GainDn, 100.0, 5.0 };
  settings.conditions = { 0.01, vibrationPixels, vibrationPixels };
  return Simulate<GreyValue>(settings, width, height);
}

/** Returns the last frames of a stack, each (1 - weight) times itself plus weight times the frame before, which is the
 * mixed one if \a isRecursive. \a weightOf(t) is the weight of a frame. */
Stack<GreyValue>
Mix(const Stack<GreyValue> & stack, bool isRecursive, const std::function<double(std::size_t)> & weightOf)
{
  const std::size_t   pixels = stack.width * stack.height;
  Stack<GreyValue>    mixed{ stack.width, stack.height, Frames, std::vector<GreyValue>(Frames * pixels) };
  std::vector<double> before(stack.pixels.begin(), stack.pixels.begin() + static_cast<std::ptrdiff_t>(pixels));
  for (std::size_t t = 1; t < stack.frames; ++t)
  {
    const double weight = weightOf(t);
    for (std::size_t p = 0; p < pixels; ++p)
    {
      const auto   own = static_cast<double>(stack.pixels[t * pixels + p]);
      const double value = (1.0 - weight) * own + weight * before[p];
      before[p] = isRecursive ? value : own;
      if (t >= FramesBefore)
      {
        mixed.pixels[(t - FramesBefore) * pixels + p] = static_cast<GreyValue>(std::round(value));
      }
    }
  }
  return mixed;
}

Report
ReportOf(const Stack<GreyValue> & stack)
{
  return Measure(stack, RefinedSettings()).GetReport();
}
} // namespace

TEST(SensorNoiseMixedFrames, OfARecursiveFilterHaveTheGainOfTheSensor)
{
  const Report report = ReportOf(Mix(Unmixed(128, 96), true, [](std::size_t) { return 0.4; }));
  EXPECT_TRUE(HasWarning(report, WarningCode::NoiseCorrelated));
  ASSERT_EQ(report.gain.status, EstimateStatus::Identified);
  EXPECT_NEAR(*report.gain.value, GainDn, 4.0 * *report.gain.standardError);
  EXPECT_TRUE(report.framesLeftOut.empty());
}

TEST(SensorNoiseMixedFrames, InterpolatedAtUnequalTimesHaveNoGain)
{
  // The variances are 0.5 to 0.9 of the unmixed one.
  CounterSeededRandom random(7);
  const Report        report =
    ReportOf(Mix(Unmixed(128, 96), false, [&](std::size_t) { return 0.05 + 0.45 * random.Uniform(); }));
  EXPECT_NE(report.gain.status, EstimateStatus::Identified) << *report.gain.value;
}

// Motion hides which frames are mixed, and is itself common to mixed frames.
TEST(SensorNoiseMixedFrames, UnderStrongVibrationHaveNoGain)
{
  const Stack<GreyValue> stack = Unmixed(128, 96, 0.6);
  const Report           report = ReportOf(Mix(stack, false, [](std::size_t t) { return t % 2 == 0 ? 0.5 : 0.0; }));
  EXPECT_NE(report.gain.status, EstimateStatus::Identified) << *report.gain.value;
}

TEST(SensorNoiseMixedFrames, WithSmallWeightsHaveThemInTheErrorOfTheGain)
{
  // A weight of 0.0085 is too small to be corrected: the slope is 1.7 % too small.
  constexpr double weight = 0.0085;
  const Report     report = ReportOf(Mix(Unmixed(256, 192), true, [](std::size_t) { return weight; }));
  EXPECT_FALSE(HasWarning(report, WarningCode::NoiseCorrelated));
  ASSERT_EQ(report.gain.status, EstimateStatus::Identified);
  EXPECT_NEAR(*report.gain.value, GainDn, 2.5 * *report.gain.standardError);
  EXPECT_GT(*report.gain.standardError, weight * GainDn);
}

TEST(SensorNoiseMixedFrames, UnmixedFramesOfAShortBurstUnderFlickerAreNotMixed)
{
  // Few frames remain after the projection, and bright frames have more noise than dark ones.
  for (const std::size_t frames : { std::size_t{ 10 }, std::size_t{ 12 }, std::size_t{ 14 } })
  {
    SimulationSettings settings = FlickeringSettings(frames);
    settings.camera = { 4000.0, GainDn, 100.0, 5.0 };
    settings.conditions = { 0.13, 0.0, 0.0 };
    settings.seed = 2;
    const Report report = ReportOf(Simulate<GreyValue>(settings, 256, 256));
    EXPECT_FALSE(HasWarning(report, WarningCode::NoiseCorrelated)) << frames;
    ASSERT_TRUE(report.gain.value && report.gain.standardError) << frames;
    EXPECT_NEAR(*report.gain.value, GainDn, 4.0 * *report.gain.standardError) << frames;
  }
}
