// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/SingleImageTestHelper.h"
#include "sensornoise/ReportText.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::single;

namespace
{
/** Expects a warning beside a gain that is off by more than a tenth. */
void
ExpectWarned(const Report & report, double gain)
{
  if (report.gain.value && std::abs(*report.gain.value / gain - 1.0) > 0.1)
  {
    EXPECT_TRUE(HasWarning(report, WarningCode::TextureDominates)) << MakeText(report);
  }
  else if (!report.gain.value)
  {
    EXPECT_TRUE(HasWarning(report, WarningCode::NothingToMeasure) || HasWarning(report, WarningCode::Contradicted))
      << MakeText(report);
  }
}

/** Returns a ramp from left to right under a weave whose threads repeat after \a period pixels along x, and 0.8 more
 * along y. Its amplitude is relative to the ramp. */
std::vector<double>
MakeWovenWaves(std::size_t size, double period, double amplitude)
{
  const double        twoPi = 2.0 * std::acos(-1.0);
  std::vector<double> scene(size * size);
  for (std::size_t i = 0; i < scene.size(); ++i)
  {
    const auto   x = static_cast<double>(i % size);
    const auto   y = static_cast<double>(i / size);
    const double threads = std::sin(twoPi * x / period) * std::sin(twoPi * y / (period + 0.8));
    const double waves = 0.5 + 0.2 * std::sin(twoPi * x / 128.0) + 0.2 * std::sin(twoPi * y / 192.0);
    scene[i] = waves * (1.0 + amplitude * threads);
  }
  return scene;
}
} // namespace

TEST(SensorNoiseSingleImageWarnings, TextureIsWarnedOfWhereTheGainIsOff)
{
  for (const char camera : { 'A', 'B', 'C' })
  {
    for (const double blur : { 0.5, 1.0, 2.0 })
    {
      SimulationSettings settings = PaperSettings(camera);
      settings.opticalBlurPixels = blur;
      const auto stack = Simulate<unsigned short>(settings, 512, 512, MakeTextureScene(512, 512));
      ExpectWarned(Measure(stack), settings.camera.gainDnPerElectron);
    }
  }
}

TEST(SensorNoiseSingleImageWarnings, AFineWeaveIsWarnedOf)
{
  for (const char camera : { 'B', 'C' })
  {
    for (const double period : { 2.2, 2.6, 3.3 })
    {
      for (const std::uint64_t seed : { 1U, 2U })
      {
        const SimulationSettings settings = PaperSettings(camera, 1, seed);
        const Report report = Measure(Simulate<unsigned short>(settings, 512, 512, MakeWovenWaves(512, period, 0.03)));
        ASSERT_TRUE(report.gain.value);
        EXPECT_GT(*report.gain.value, 1.1 * settings.camera.gainDnPerElectron) << camera << period;
        ExpectWarned(report, settings.camera.gainDnPerElectron);
      }
    }
  }
}

TEST(SensorNoiseSingleImageWarnings, FramesWithoutTextureAreNotWarnedOf)
{
  for (const char camera : { 'A', 'B', 'C' })
  {
    for (std::uint64_t seed = 1; seed <= 11; ++seed) // none of 33: 97 % and more
    {
      const SimulationSettings settings = PaperSettings(camera, 1, seed);
      const Report report = Measure(Simulate<unsigned short>(settings, 256, 256, MakeWovenWaves(256, 3.3, 0.0)));
      EXPECT_TRUE(report.gain.value);
      EXPECT_FALSE(HasWarning(report, WarningCode::TextureDominates)) << MakeText(report);
    }
  }
}

TEST(SensorNoiseSingleImageWarnings, FixedPatternNoiseIsWarnedOf)
{
  SimulationSettings settings = PaperSettings('B');
  settings.prnuSd = 0.01; // raises the gain by 15 %
  const Report one = Measure(Simulate<unsigned short>(settings, 512, 512));
  EXPECT_GT(*one.gain.value, 1.1);
  EXPECT_TRUE(HasWarning(one, WarningCode::TextureDominates)) << MakeText(one);
  settings.frames = 8;
  const Report burst = Measure(Simulate<unsigned short>(settings, 256, 256));
  ASSERT_TRUE(burst.singleImage->meanImage);
  EXPECT_GT(burst.singleImage->meanImage->slope, 1.5 * *burst.gain.value); // 8 times as much of it as in a frame
  EXPECT_TRUE(HasWarning(burst, WarningCode::TextureDominates)) << MakeText(burst);
}

TEST(SensorNoiseSingleImageWarnings, FilteredFramesGiveNoGain)
{
  SimulationSettings settings = PaperSettings('B');
  settings.flaws.smoothing.sdPixels = 0.7;
  const Report report = Measure(Simulate<unsigned short>(settings, 512, 512));
  EXPECT_FALSE(report.gain.value) << MakeText(report);
  EXPECT_TRUE(HasWarning(report, WarningCode::NothingToMeasure));
}

TEST(SensorNoiseSingleImageWarnings, AFailedEstimateSaysTheCountThatWasFound)
{
  const Report report = Measure(Simulate<unsigned short>(PaperSettings('B'), 320, 320, MakeTextureScene(320, 320)));
  ASSERT_FALSE(report.gain.value) << MakeText(report);
  ASSERT_GT(report.pixels.used, 100U);
  const std::string message = report.warnings.back().message;
  const std::string before = "even areas have ";
  ASSERT_EQ(message.rfind(before, 0), 0U) << message;
  const double found = std::stod(message.substr(before.size()));
  EXPECT_GT(found, 0.1 * static_cast<double>(report.pixels.used)) << message; // a position has 4 pixels
  EXPECT_LT(found, 0.5 * static_cast<double>(report.pixels.used)) << message;
}

TEST(SensorNoiseSingleImageWarnings, FramesWithoutLevelsGiveNoGain)
{
  const Stack<unsigned short> constant{ 128, 128, 1, std::vector<unsigned short>(128 * 128, 100) };
  const Stack<unsigned short> small{ 20, 20, 1, std::vector<unsigned short>(20 * 20, 100) };
  for (const Report & report : { Measure(constant), Measure(small) })
  {
    EXPECT_EQ(report.gain.status, EstimateStatus::Failed);
    EXPECT_TRUE(HasWarning(report, WarningCode::NothingToMeasure)) << MakeText(report);
  }
  const Report flat = Measure(Simulate<unsigned short>(PaperSettings('B'), 256, 256, MakeFlatScene(256, 256)));
  EXPECT_NE(flat.gain.status, EstimateStatus::Identified) << MakeText(flat);
}

TEST(SensorNoiseSingleImageWarnings, CoarseQuantizationGivesNoGain)
{
  const auto   stack = Simulate<double>(PaperSettings('C'), 256, 256);
  const Report report = Measure(stack.Map<unsigned char>([](double u) { return std::floor(u / 100.0); }));
  EXPECT_NE(report.gain.status, EstimateStatus::Identified) << MakeText(report);
}
