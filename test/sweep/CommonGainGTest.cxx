// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/SweepSummary.h"

#include "helpers/PageTestHelper.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace sensornoise
{
namespace
{
using test::Contains;

/** Gains at the exposures 1, 2, 4, ... seconds, with one error. */
std::vector<SettingNoise>
GainsOf(const std::vector<double> & gains, double error)
{
  std::vector<SettingNoise> settings;
  double                    exposure = 1.0;
  for (const double gain : gains)
  {
    settings.push_back({ exposure, NumberWithError{ gain, error }, {} });
    exposure *= 2.0;
  }
  return settings;
}

/** Returns a camera at 4 exposures. */
MeasuredRange
ExposureRange(const std::vector<double> & gains)
{
  MeasuredRange range;
  range.kind = SettingKind::Exposure;
  for (const SettingNoise & setting : GainsOf(gains, 0.001))
  {
    CameraNoise noise;
    noise.channels.resize(1);
    noise.channels[0].gain = { setting.gain->value, setting.gain->standardError, "identified" };
    range.settings.push_back(setting.setting);
    range.noise.push_back(noise);
  }
  return range;
}
} // namespace

// Closed form: weights 1 and 1/4, mean (0.50 + 0.51 / 4) / 1.25, error 0.01 / sqrt(1.25), chi-square 0.01^2 / (0.01^2 +
// 0.02^2).
TEST(CommonGain, IsTheWeightedMean)
{
  const std::vector<SettingNoise> settings{ { 1.0, NumberWithError{ 0.50, 0.01 }, {} },
                                            { 2.0, {}, {} },
                                            { 4.0, NumberWithError{ 0.51, 0.02 }, {} } };
  const auto                      common = FindCommonGain(settings);
  ASSERT_TRUE(common);
  EXPECT_NEAR(common->gain.value, 0.502, 1e-12);
  EXPECT_NEAR(common->gain.standardError, 0.01 / std::sqrt(1.25), 1e-12);
  EXPECT_NEAR(common->reducedChi2, 0.2, 1e-12);
  EXPECT_EQ(common->settings, 2U);
  EXPECT_TRUE(common->isSame);
  EXPECT_NEAR(std::abs(common->deviation.value), 0.02, 0.001);
}

TEST(CommonGain, DiffersByEffectAndBySignificance)
{
  EXPECT_TRUE(FindCommonGain(GainsOf({ 0.5, 0.5, 0.5, 0.504 }, 1e-5))->isSame) << "0.8 % is no effect";
  EXPECT_TRUE(FindCommonGain(GainsOf({ 0.5, 0.5, 0.5, 0.53 }, 0.01))->isSame) << "3 standard errors are chance";
  const auto differs = FindCommonGain(GainsOf({ 0.5, 0.5, 0.55, 0.5 }, 0.001));
  EXPECT_FALSE(differs->isSame);
  EXPECT_EQ(differs->setting, 4.0);
  EXPECT_NEAR(differs->deviation.value, 0.1, 1e-12);
  // the error of the mean holds the scatter: chi-square of residuals -0.0125 (three) and 0.0375 over 0.001, over 3
  EXPECT_NEAR(differs->reducedChi2, 625.0, 1e-6);
  EXPECT_NEAR(differs->gain.standardError, 0.5 * 0.001 * 25.0, 1e-9);
  // a deviation that counts is named, not the more significant one of a setting without an effect
  auto settings = GainsOf({ 0.5, 0.5, 0.5, 0.53 }, 0.003);
  settings[0].gain = NumberWithError{ 0.504, 1e-6 };
  settings[1].gain = NumberWithError{ 0.5, 1e-6 };
  EXPECT_EQ(FindCommonGain(settings)->setting, 8.0);
}

// 6 exposures of one gain: a false alarm is rarer than 6 x 6e-5. A gain 3 % off at errors of 0.3 % is always found.
TEST(CommonGain, IsTestedAtItsLevel)
{
  std::mt19937_64            random(1);
  std::normal_distribution<> normal(0.5, 0.0015);
  int                        alarms = 0;
  int                        found = 0;
  for (int camera = 0; camera < 1000; ++camera)
  {
    std::vector<double> gains(6);
    for (double & gain : gains)
    {
      gain = normal(random);
    }
    alarms += FindCommonGain(GainsOf(gains, 0.0015))->isSame ? 0 : 1;
    gains[2] *= 1.03;
    found += FindCommonGain(GainsOf(gains, 0.0015))->isSame ? 0 : 1;
  }
  EXPECT_LE(alarms, 3);
  EXPECT_GE(found, 990);
}

TEST(CommonGain, NeedsTwoGains)
{
  EXPECT_FALSE(FindCommonGain({}));
  EXPECT_FALSE(FindCommonGain(GainsOf({ 0.5 }, 0.01)));
  EXPECT_FALSE(FindCommonGain(GainsOf({ 0.5, 0.5 }, 0.0))) << "gains without an error";
}

TEST(CommonGain, IsInTheSummaryOfExposures)
{
  const SweepSummary same = SummariseSweep(ExposureRange({ 0.5, 0.501, 0.499, 0.5 }));
  EXPECT_TRUE(same.line.parts.empty());
  ASSERT_EQ(same.commonGains.size(), 1U);
  EXPECT_TRUE(Contains(MakeText(same), "The gain is the same at all 4 exposures: (0.50")) << MakeText(same);
  EXPECT_FALSE(Contains(MakeText(same), "line"));
  EXPECT_TRUE(Contains(ToJson(same), "\"is_same\": true")) << ToJson(same);
  EXPECT_TRUE(Contains(ToHtml(same), "exposure [s]"));
  const std::string text = MakeText(SummariseSweep(ExposureRange({ 0.5, 0.55, 0.5, 0.5 })));
  EXPECT_TRUE(Contains(text, "Warning: the gain is not the same at all exposures: at exposure 2 s it is (10.0"))
    << text;
  EXPECT_TRUE(SummariseSweep(MeasuredRange()).commonGains.empty());
}

TEST(CommonGain, IsNotInterpolated)
{
  const MeasuredRange range = ExposureRange({ 0.5, 0.5 });
  EXPECT_EQ(InterpolateNoise(range, 2.0).noise.channels[0].gain.value, 0.5);
  EXPECT_THROW(InterpolateNoise(range, 1.5), ExportError);
}

} // namespace sensornoise
