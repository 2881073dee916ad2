// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/SingleImageMethod.h"

#include "sensornoise/ReportText.h"
#include "helpers/SingleImageTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::single;

namespace
{
/** Expects slope and intercept within 4 of their errors of the simulated camera, and a relative error of the gain below
 * \a largestRelativeError [1]. */
void
ExpectCamera(const Report & report, const SimulationSettings & settings, double largestRelativeError)
{
  const CameraModel & camera = settings.camera;
  ASSERT_EQ(report.gain.status, EstimateStatus::Identified) << MakeText(report);
  const double gain = camera.gainDnPerElectron;
  const double intercept = camera.readNoiseDn * camera.readNoiseDn - gain * camera.offsetDn;
  EXPECT_LT(*report.gain.standardError, largestRelativeError * gain);
  EXPECT_NEAR(*report.gain.value, gain, 4.0 * *report.gain.standardError);
  EXPECT_NEAR(*report.intercept.value, intercept, 4.0 * *report.intercept.standardError);
}
} // namespace

TEST(SensorNoiseSingleImageMethod, FindsTheCamerasOfThePaper)
{
  for (const char camera : { 'A', 'B', 'C' })
  {
    for (const int condition : { 1, 2, 3 })
    {
      SimulationSettings settings = PaperSettings(camera);
      settings.conditions = PaperConditions(condition);
      const Report report = Measure(Simulate<unsigned short>(settings, 512, 512));
      ExpectCamera(report, settings, 0.014); // 37,000 details and a lever of 2: 0.9 %, times the scatter
      EXPECT_NEAR(*report.gain.value / settings.camera.gainDnPerElectron, 1.0, 0.03) << camera << condition;
      EXPECT_FALSE(HasWarning(report, WarningCode::TextureDominates)) << MakeText(report);
    }
  }
}

TEST(SensorNoiseSingleImageMethod, IntervalsHoldTheTruth)
{
  // Of 95 % intervals of 40 frames, 34 hold the truth with a probability of 98 %; the seeds are fixed.
  SimulationSettings settings = PaperSettings('B', 40);
  const auto         stack = Simulate<unsigned short>(settings, 256, 256);
  int                held = 0;
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    const Stack<unsigned short> frame{
      256, 256, 1, std::vector<unsigned short>(stack.Frame(t), stack.Frame(t) + 256 * 256)
    };
    const Report report = Measure(frame);
    held += report.gain.interval95 && *report.gain.interval95->low <= 1.0 && *report.gain.interval95->high >= 1.0;
  }
  EXPECT_GE(held, 34);
}

TEST(SensorNoiseSingleImageMethod, AFrameThatIsClippedAtBothEndsGivesTheSameCamera)
{
  SimulationSettings settings = PaperSettings('B');
  settings.clipLowDn = 150.0;
  settings.clipHighDn = 2200.0;
  const Report report = Measure(Simulate<unsigned short>(settings, 512, 512));
  EXPECT_EQ(report.clipLowDn.value_or(0.0), 150.0);
  EXPECT_EQ(report.clipHighDn.value_or(0.0), 2200.0);
  ExpectCamera(report, settings, 0.03);
}

TEST(SensorNoiseSingleImageMethod, FramesOfABurstAreCombinedAndChecked)
{
  SimulationSettings settings = PaperSettings('B', 16);
  const Report       report = Measure(Simulate<unsigned short>(settings, 256, 256));
  ExpectCamera(report, settings, 0.007); // a quarter of the error of one frame, 2.5 %
  ASSERT_TRUE(report.singleImage);
  EXPECT_EQ(report.singleImage->frames.size(), 16U);
  // Chi-square of 15 degrees of freedom is between these with a probability of 99.8 %.
  EXPECT_GT(report.singleImage->frameReducedChi2.value_or(0.0), 0.23);
  EXPECT_LT(report.singleImage->frameReducedChi2.value_or(9.0), 2.5);
  ASSERT_TRUE(report.singleImage->meanImage);
  EXPECT_NEAR(report.singleImage->meanImage->slope, 1.0, 4.0 * report.singleImage->meanImage->slopeStandardError);
}

TEST(SensorNoiseSingleImageMethod, NeitherOffsetNorReadNoiseIsIdentifiable)
{
  const Report report = Measure(Simulate<unsigned short>(PaperSettings('A'), 256, 256));
  for (const Quantity & quantity : { report.offset, report.readNoise, report.readNoiseElectrons })
  {
    EXPECT_EQ(quantity.status, EstimateStatus::NotIdentifiable);
    EXPECT_FALSE(quantity.value);
  }
  EXPECT_TRUE(HasWarning(report, WarningCode::LineOnly));
  EXPECT_NEAR(*report.totalIntercept.value - *report.intercept.value, 1.0 / 12.0, 1e-9);
}

TEST(SensorNoiseSingleImageMethod, AnyThreadsAndChunksGiveTheSameBits)
{
  const auto        stack = Simulate<unsigned short>(PaperSettings('C', 3), 400, 300);
  const std::string expected = ToJson(MeasureAll(stack).front());
  EXPECT_EQ(ToJson(MeasureAll(stack, {}, 3).front()), expected);
  EXPECT_EQ(ToJson(MeasureAll(stack, {}, 2, {}, test::Threads(4)).front()), expected);
}

TEST(SensorNoiseSingleImageMethod, AllPixelTypesAndScalesGiveTheSameCamera)
{
  const auto   stack = Simulate<unsigned short>(PaperSettings('B'), 256, 256);
  const Report expected = Measure(stack);
  const Report shorts = Measure(stack.Map<short>([](double u) { return u; }));
  EXPECT_EQ(*shorts.gain.value, *expected.gain.value);
  const Report doubles = Measure(stack.Map<double>([](double u) { return 1e-6 * u + 3.0; }));
  EXPECT_NEAR(*doubles.gain.value, 1e-6 * *expected.gain.value, 1e-9); // floats round levels to 1e-7 of their range
  const Report floats = Measure(stack.Map<float>([](double u) { return u; }));
  EXPECT_NEAR(*floats.gain.value, *expected.gain.value, 1e-3);
}

TEST(SensorNoiseSingleImageMethod, PlanesOfAMosaicHaveTheBitsOfPlanesAlone)
{
  const auto          stack = Simulate<unsigned short>(PaperSettings('B'), 301, 300);
  SingleImageSettings settings;
  settings.bayerPattern = BayerPattern::GRBG;
  const std::vector<Report> reports = MeasureAll(stack, settings);
  ASSERT_EQ(reports.size(), 4U);
  for (std::size_t k = 0; k < reports.size(); ++k)
  {
    const auto            corner = CornerOf(BayerPattern::GRBG, BayerPlanes[k]);
    Stack<unsigned short> plane{ 150, 150, 1, {} };
    for (std::size_t y = 0; y < 150; ++y)
    {
      for (std::size_t x = 0; x < 150; ++x)
      {
        plane.pixels.push_back(stack.pixels[(2 * y + corner[1]) * 301 + 2 * x + corner[0]]);
      }
    }
    EXPECT_EQ(ToJson(reports[k]), ToJson(Measure(plane)));
  }
}

TEST(SensorNoiseSingleImageMethod, MaskedPixelsAndThoseThatAreNotFiniteAreLeftOut)
{
  const SimulationSettings  settings = PaperSettings('B');
  auto                      stack = Simulate<float>(settings, 512, 512);
  std::vector<std::uint8_t> mask(512 * 512, 1);
  for (std::size_t p = 0; p < stack.pixels.size(); ++p)
  {
    if (p % 512 < 200)
    {
      mask[p] = 0;
      stack.pixels[p] = 1e5F * static_cast<float>(p % 7); // would be the end of any estimate
    }
  }
  const Report masked = MeasureAll(stack, {}, 1, mask).front();
  ExpectCamera(masked, settings, 0.02);
  const auto unmasked = static_cast<std::size_t>(std::count(mask.begin(), mask.end(), std::uint8_t{ 1 }));
  EXPECT_EQ(masked.pixels.valid + masked.pixels.clipped, unmasked);
  for (std::size_t p = 0; p < stack.pixels.size(); ++p)
  {
    stack.pixels[p] = mask[p] != 0 ? stack.pixels[p] : std::numeric_limits<float>::quiet_NaN();
  }
  const Report report = Measure(stack);
  ExpectCamera(report, settings, 0.02);
  EXPECT_EQ(report.pixels.notFinite, 512U * 200U);
}

TEST(SensorNoiseSingleImageMethod, WrongUseThrows)
{
  const FrameGeometry geometry{ 64, 64, 1 };
  EXPECT_THROW(SingleImageMethod<float>({}, geometry, 0), std::invalid_argument);
  EXPECT_THROW(SingleImageMethod<float>({}, geometry, 1, std::vector<std::uint8_t>(5)), std::invalid_argument);
  SingleImageSettings settings;
  settings.excessNoiseFactor = 0.5;
  EXPECT_THROW(SingleImageMethod<float>(settings, geometry, 1), std::invalid_argument);
  SingleImageMethod<float> method({}, geometry, 1);
  EXPECT_THROW(method.GetReports(), std::logic_error);
  const std::vector<float> pixels(2 * geometry.Pixels());
  EXPECT_THROW(method.AddFrames(pixels.data(), 2), std::logic_error);
}
