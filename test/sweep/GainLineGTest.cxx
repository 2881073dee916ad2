// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/SweepSummary.h"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <stdexcept>
#include <vector>

namespace sensornoise
{
namespace
{
const std::vector<double> isoSpeeds{ 100, 200, 400, 800, 1600, 3200, 6400, 12800 };

/** A camera of 8 ISO speeds: its gain is scale x ISO, its read noise has a part before and a part behind the amplifier.
 */
struct SimulatedCamera
{
  double scale{ 0.002 };        // DN/e- per unit of ISO
  double pixelNoise{ 2.0 };     // e-, before the switch
  double amplifierNoise{ 6.0 }; // e- at ISO 100
  double drop{ 1.0 };           // factor on the pixel noise, from ISO switchIso on
  double gainStep{ 1.0 };       // factor on gain / ISO, from ISO switchIso on
  double switchIso{ 800 };
  double highestAnalogue{ 1e9 };  // ISO above which the gain is digital
  double gainError{ 0.004 };      // relative
  double readNoiseError{ 0.015 }; // relative

  double
  GainAt(double iso) const
  {
    return scale * iso * (iso >= switchIso ? gainStep : 1.0);
  }
  double
  ReadNoiseAt(double iso) const
  {
    return std::hypot(pixelNoise * (iso >= switchIso ? drop : 1.0),
                      amplifierNoise * 100.0 / std::min(iso, highestAnalogue));
  }
  std::vector<SettingNoise>
  Measure(unsigned seed) const
  {
    std::mt19937_64            random(seed);
    std::normal_distribution<> normal;
    std::vector<SettingNoise>  settings;
    for (const double iso : isoSpeeds)
    {
      const double gain = this->GainAt(iso);
      const double sigma = this->ReadNoiseAt(iso);
      settings.push_back(
        { iso,
          NumberWithError{ gain * (1.0 + gainError * normal(random)), gain * gainError },
          NumberWithError{ sigma * (1.0 + readNoiseError * normal(random)), sigma * readNoiseError } });
    }
    return settings;
  }
};

/** Cameras of 100 in which a switch is found; with a place, the right one. */
int
Found(const SimulatedCamera & camera, const std::optional<double> & below)
{
  int found = 0;
  for (unsigned seed = 0; seed < 100; ++seed)
  {
    const auto conversion = FindGainSwitch(camera.Measure(seed));
    found += conversion && (!below || conversion->below == *below) ? 1 : 0;
  }
  return found;
}
} // namespace

// Identity: an exact line is found exactly, without a switch.
TEST(GainLine, IsExactForAnExactCamera)
{
  std::vector<SettingNoise> settings;
  for (const double iso : isoSpeeds)
  {
    settings.push_back({ iso, NumberWithError{ 0.003 * iso, 0.0 }, NumberWithError{ 2.0 + 100.0 / iso, 0.01 } });
  }
  EXPECT_FALSE(FindGainSwitch(settings));
  const GainLine line = FitGainLine(settings, std::nullopt);
  ASSERT_EQ(line.parts.size(), 1U);
  EXPECT_NEAR(line.parts[0].scale.value, 0.003, 1e-15);
  // eight equal errors of 1 %, the rounding of the settings
  EXPECT_NEAR(line.parts[0].scale.standardError, 0.003 * 0.01 / std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(line.parts[0].reducedChi2, 0.0, 1e-12);
  EXPECT_EQ(line.parts[0].settings, 8U);
  EXPECT_NEAR(line.deviation[3].value(), 0.0, 1e-12);
}

TEST(GainLine, NamesTheSettingsThatLeaveIt)
{
  auto settings = SimulatedCamera().Measure(1);
  settings.front().gain->value *= 2.0; // an extended ISO speed: the gain of the next one
  settings.back().gain->value *= 0.5;
  settings[3].gain.reset();
  EXPECT_FALSE(FindGainSwitch(settings));
  const GainLine line = FitGainLine(settings, std::nullopt);
  ASSERT_EQ(line.parts.size(), 1U);
  EXPECT_EQ(line.parts[0].settings, 5U);
  EXPECT_EQ(line.isBeside, (std::vector<bool>{ true, false, false, false, false, false, false, true }));
  EXPECT_NEAR(line.deviation.front().value(), 1.0, 0.05);
  EXPECT_NEAR(line.deviation.back().value(), -0.5, 0.02);
  EXPECT_FALSE(line.deviation[3]);
}

// Two extended ISO speeds with the gain of the last one are no switch: they have no common level.
TEST(GainLine, TakesExtendedSpeedsForNoSwitch)
{
  auto settings = SimulatedCamera().Measure(2);
  settings[6].gain->value *= 0.5;
  settings[7].gain->value *= 0.25;
  EXPECT_FALSE(FindGainSwitch(settings));
  EXPECT_TRUE(FitGainLine(settings, std::nullopt).isBeside[7]);
}

TEST(GainLine, IsNoneWhereTheGainDoesNotFollowTheSetting)
{
  std::vector<SettingNoise> settings;
  for (const double iso : isoSpeeds)
  {
    settings.push_back({ iso, NumberWithError{ 0.5, 0.001 }, std::nullopt });
  }
  const GainLine line = FitGainLine(settings, FindGainSwitch(settings));
  EXPECT_TRUE(line.parts.empty());
  EXPECT_FALSE(line.deviation[0]);
  EXPECT_TRUE(FitGainLine({}, std::nullopt).parts.empty());
}

TEST(GainLine, RefusesSettingsThatMakeNoSense)
{
  EXPECT_THROW(FindGainSwitch({ { 200, {}, {} }, { 100, {}, {} } }), std::invalid_argument);
  EXPECT_THROW(FindGainSwitch({ { 0, {}, {} } }), std::invalid_argument);
  EXPECT_THROW(FitGainLine({ { 100, NumberWithError{ -1.0, 0.1 }, {} } }, std::nullopt), std::invalid_argument);
  EXPECT_THROW(FitGainLine({ { 100, NumberWithError{ 1.0, std::nan("") }, {} } }, std::nullopt), std::invalid_argument);
}

// Simulated cameras: the switch is found at its place in 95 of 100 or more, and none in 97 of 100 without one.
TEST(GainSwitch, IsFoundByTheReadNoise)
{
  SimulatedCamera camera;
  camera.drop = 0.5;
  EXPECT_GE(Found(camera, 400), 95);
  camera.switchIso = 6400;
  EXPECT_GE(Found(camera, 3200), 95);
  camera.switchIso = 800;
  camera.drop = 0.3;
  camera.readNoiseError = 0.03;
  EXPECT_GE(Found(camera, 400), 95);
}

TEST(GainSwitch, IsFoundByTheGain)
{
  SimulatedCamera camera;
  camera.gainStep = 1.5;
  EXPECT_GE(Found(camera, 400), 95);
  const auto conversion = FindGainSwitch(camera.Measure(7));
  ASSERT_TRUE(conversion && conversion->gainStep);
  EXPECT_FALSE(conversion->readNoiseStep);
  EXPECT_NEAR(conversion->gainStep->value, 1.5, 3.0 * conversion->gainStep->standardError);
  const GainLine line = FitGainLine(camera.Measure(7), conversion);
  ASSERT_EQ(line.parts.size(), 2U);
  EXPECT_NEAR(line.parts[1].scale.value, 0.003, 3.0 * line.parts[1].scale.standardError);
  EXPECT_EQ(line.parts[0].highest, 400.0);
  EXPECT_EQ(line.parts[1].lowest, 800.0);
}

TEST(GainSwitch, IsNotFoundWhereThereIsNone)
{
  SimulatedCamera camera;
  EXPECT_LE(Found(camera, std::nullopt), 3);
  camera.highestAnalogue = 1600; // the read noise is constant above
  EXPECT_LE(Found(camera, std::nullopt), 3);
  camera.amplifierNoise = 20.0;
  EXPECT_LE(Found(camera, std::nullopt), 3);
  camera.amplifierNoise = 0.0;
  EXPECT_LE(Found(camera, std::nullopt), 3);
  camera.readNoiseError = 0.1;
  camera.gainError = 0.05;
  EXPECT_LE(Found(camera, std::nullopt), 3);
}

// Closed form: without errors of the numbers, the step of the read noise is the step of the model at the geometric
// mean.
TEST(GainSwitch, MeasuresItsSteps)
{
  SimulatedCamera camera;
  camera.drop = 0.4;
  camera.gainStep = 0.8;
  camera.gainError = 0.0;
  camera.readNoiseError = 0.0;
  const auto conversion = FindGainSwitch(camera.Measure(0));
  ASSERT_TRUE(conversion && conversion->readNoiseStep && conversion->gainStep);
  const double amplifier = 6.0 * 6.0 * 100.0 * 100.0 / (400.0 * 800.0);
  EXPECT_NEAR(conversion->readNoiseStep->value, std::sqrt((0.8 * 0.8 + amplifier) / (4.0 + amplifier)), 1e-9);
  EXPECT_NEAR(conversion->gainStep->value, 0.8, 1e-12);
  EXPECT_EQ(conversion->below, 400.0);
  EXPECT_EQ(conversion->above, 800.0);
}

} // namespace sensornoise
