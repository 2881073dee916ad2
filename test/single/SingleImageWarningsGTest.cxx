// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/SingleImageTestHelper.h"
#include "sensornoise/ReportText.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::single;

namespace
{
/** A gain that is off by more than a tenth has a warning beside it. */
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

TEST(SensorNoiseSingleImageWarnings, ARefusalSaysTheCountThatWasFound)
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

TEST(SensorNoiseSingleImageWarnings, CoarseCodesGiveNoGain)
{
  const auto   stack = Simulate<double>(PaperSettings('C'), 256, 256);
  const Report report = Measure(stack.Map<unsigned char>([](double u) { return std::floor(u / 100.0); }));
  EXPECT_NE(report.gain.status, EstimateStatus::Identified) << MakeText(report);
}
