// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"
#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/PublishedTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
/** Expects that \a other has the values of \a report, scaled and shifted, within rounding errors. */
void
ExpectSameCamera(const Report & report,
                 const Report & other,
                 double         scale = 1.0,
                 double         shiftDn = 0.0,
                 double         eps = 1e-8)
{
  const double gain = ValueOf(report.gain);
  EXPECT_NEAR(ValueOf(other.gain), scale * gain, eps * scale * gain);
  EXPECT_NEAR(ValueOf(other.offset), scale * ValueOf(report.offset) + shiftDn, eps * scale * 3000.0);
  EXPECT_NEAR(ValueOf(other.intercept),
              scale * scale * (ValueOf(report.intercept) - gain * shiftDn / scale),
              eps * scale * scale * 3000.0 * gain);
  EXPECT_NEAR(ValueOf(other.flickerSd), ValueOf(report.flickerSd), eps);
  EXPECT_EQ(other.pixels.used, report.pixels.used);
}
} // namespace

TEST(SensorNoisePublishedMethod, AnyChunksAndThreadsGiveTheSameBits)
{
  for (const bool rolling : { false, true })
  {
    SimulationSettings simulation = SettingsOf(0.05, 31);
    simulation.rollingShutterPeriodRows = rolling ? 40.0 : 0.0;
    const auto stack = Simulate(simulation);
    const auto expected = Measure(stack);
    for (const std::size_t chunk : { 1, 7, 30 })
    {
      const auto method = Measure(stack, {}, chunk, {}, test::Threads(4));
      EXPECT_EQ(ToJson(method.GetReport()), ToJson(expected.GetReport())) << chunk;
      EXPECT_EQ(method.GetMean(), expected.GetMean()) << chunk;
      EXPECT_EQ(method.GetVariance(), expected.GetVariance()) << chunk;
      EXPECT_EQ(method.GetPixelUse(), expected.GetPixelUse()) << chunk;
      for (std::size_t p = 0; p < expected.GetMean().size(); ++p)
      {
        const double variance = expected.GetCorrectedVariance()[p];
        ASSERT_TRUE(method.GetCorrectedVariance()[p] == variance || std::isnan(variance)) << chunk;
      }
    }
  }
}

TEST(SensorNoisePublishedMethod, PermutedFramesGiveTheSameCamera)
{
  const auto &      stack = FlickeringStack();
  auto              permuted = stack;
  const std::size_t pixels = stack.width * stack.height;
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    const std::size_t to = t * 7 % stack.frames;
    std::copy_n(stack.pixels.begin() + static_cast<std::ptrdiff_t>(t * pixels),
                pixels,
                permuted.pixels.begin() + static_cast<std::ptrdiff_t>(to * pixels));
  }
  const auto before = Measure(stack, WithGlobalShutter());
  const auto after = Measure(permuted, WithGlobalShutter());
  EXPECT_EQ(after.GetVariance(), before.GetVariance());
  ExpectSameCamera(before.GetReport(), after.GetReport());
  EXPECT_NEAR(after.GetReport().flicker[21], before.GetReport().flicker[3], 1e-12);
}

TEST(SensorNoisePublishedMethod, TransposedFramesSwapTheAxes)
{
  SimulationSettings simulation = SettingsOf(0.05, 40);
  simulation.conditions.vibrationSdXPixels = 0.3;
  simulation.conditions.vibrationSdYPixels = 0.1;
  for (const double period : { 0.0, 40.0 })
  {
    simulation.rollingShutterPeriodRows = period;
    const auto       stack = Simulate(simulation);
    Stack<GreyValue> transposed{ stack.height, stack.width, stack.frames, stack.pixels };
    for (std::size_t i = 0; i < stack.pixels.size(); ++i)
    {
      const std::size_t x = i % stack.width;
      const std::size_t y = i / stack.width % stack.height;
      const std::size_t t = i / stack.width / stack.height;
      transposed.pixels[(t * stack.width + x) * stack.height + y] = stack.pixels[i];
    }
    PublishedSettings alongX;
    alongX.shutterAxis = 0;
    const auto     method = Measure(stack);
    const auto     swapped = Measure(transposed, alongX);
    const Report & before = method.GetReport();
    const Report & after = swapped.GetReport();
    ExpectSameCamera(before, after);
    EXPECT_EQ(before.flickerRows.empty(), period == 0.0);
    EXPECT_EQ(after.flickerRows.empty(), period == 0.0);
    EXPECT_NEAR(ValueOf(after.vibrationSdX), ValueOf(before.vibrationSdY), 1e-8);
    EXPECT_NEAR(ValueOf(after.vibrationSdY), ValueOf(before.vibrationSdX), 1e-8);
    EXPECT_NEAR(ValueOf(after.vibrationCovariance), ValueOf(before.vibrationCovariance), 1e-8);
    EXPECT_GT(ValueOf(before.vibrationSdX), 2.0 * ValueOf(before.vibrationSdY)); // 0.3 against 0.1
  }
}

TEST(SensorNoisePublishedMethod, AddedConstantShiftsTheOffset)
{
  const auto before = Measure(FlickeringStack(), WithGlobalShutter());
  const auto after = Measure(FlickeringStack().Map<GreyValue>([](int u) { return u + 5000; }), WithGlobalShutter());
  // v = u / ubar is relative to the mean of each pixel. The means of S^* are up to 1 % from u^* (3 sd of a mean are
  // 3 * 25 DN of 3,000, weighted). The constant changes the weights by so much, and a flicker of 5 % by 5e-4.
  ExpectSameCamera(before.GetReport(), after.GetReport(), 1.0, 5000.0, 5e-4);
}

TEST(SensorNoisePublishedMethod, LeftAlignedNumbersScaleTheCamera)
{
  const auto     stack = FlickeringStack().Map<GreyValue>([](int u) { return 16 * std::min(u, 3400); }); // saturated
  const auto     right = Measure(FlickeringStack().Map<GreyValue>([](int u) { return std::min(u, 3400); }));
  const auto     left = Measure(stack);
  const Report & before = right.GetReport();
  const Report & after = left.GetReport();
  ExpectSameCamera(before, after, 16.0);
  EXPECT_EQ(after.quantisationStepDn, 16.0);
  EXPECT_EQ(after.bitDepth, before.bitDepth);
  EXPECT_EQ(after.clipHighDn, 16.0 * before.clipHighDn.value());
  EXPECT_EQ(after.pixels.clipped, before.pixels.clipped);
}

TEST(SensorNoisePublishedMethod, FloatingPointPixelsGiveTheSameAsIntegers)
{
  const auto        integers = Measure(FlickeringStack(), WithGlobalShutter());
  PublishedSettings given = WithGlobalShutter();
  given.dnSettings = MakeDnSettings(12, 0.0, 4095.0, 1.0);
  const auto floats = Measure(FlickeringStack().Map<float>([](int u) { return u; }), given);
  ExpectSameCamera(integers.GetReport(), floats.GetReport());
  EXPECT_EQ(integers.GetPixelUse(), floats.GetPixelUse());
  const auto signedIntegers = Measure(FlickeringStack().Map<short>([](int u) { return u; }), WithGlobalShutter());
  ExpectSameCamera(integers.GetReport(), signedIntegers.GetReport());
}

TEST(SensorNoisePublishedMethod, MaskedPixelsTakeNoPart)
{
  auto                      stack = FlickeringStack();
  std::vector<std::uint8_t> mask(stack.width * stack.height, 1);
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    mask[p] = p / stack.width < 40 ? 7 : 0;
  }
  PublishedSettings settings = WithGlobalShutter();
  settings.dnSettings = MakeDnSettings(12, 0.0, 4095.0, 1.0); // otherwise the digital numbers of masked pixels are used
  const auto expected = Measure(stack, settings, 1000, mask);
  for (std::size_t i = 0; i < stack.pixels.size(); ++i)
  {
    if (i / stack.width % stack.height > 40) // row 40 is beside the last used row
    {
      stack.pixels[i] = static_cast<GreyValue>(i * 977 % 4096);
    }
  }
  const auto method = Measure(stack, settings, 1000, mask);
  ExpectSameCamera(expected.GetReport(), method.GetReport(), 1.0, 0.0, 0.0);
  EXPECT_EQ(method.GetPixelUse(), expected.GetPixelUse());
  EXPECT_EQ(std::count(method.GetPixelUse().begin(), method.GetPixelUse().end(), std::uint8_t{ 7 }), 16 * 64);
  mask.assign(mask.size(), 0);
  ExpectNothingMeasured(Measure(stack, settings, 1000, mask).GetReport(), WarningCode::NothingToMeasure);
}
