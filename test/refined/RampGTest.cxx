// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"
#include "sensornoise/Report.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/RefinedTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Size = 256;
constexpr std::size_t Frames = 50;

/** Returns a ramp from dark to bright along "x", "y" or the "diagonal". */
std::vector<double>
RampAlong(const std::string & direction)
{
  std::vector<double> scene(Size * Size);
  for (std::size_t p = 0; p < scene.size(); ++p)
  {
    const double x = static_cast<double>(p % Size) / (Size - 1.0);
    const double y = static_cast<double>(p / Size) / (Size - 1.0);
    scene[p] = direction == "x" ? x : direction == "y" ? y : 0.5 * (x + y);
  }
  return scene;
}

Report
MeasureRamp(const std::string & direction, const SceneConditions & conditions, std::uint64_t seed)
{
  SimulationSettings settings;
  settings.conditions = conditions;
  settings.frames = Frames;
  settings.seed = seed;
  return Measure(Simulate<std::uint16_t>(settings, Size, Size, RampAlong(direction))).GetReport();
}

/** Parameters of a test: direction, flicker and vibration. */
class SensorNoiseRamp : public ::testing::TestWithParam<std::tuple<const char *, double, double>>
{};
} // namespace

TEST_P(SensorNoiseRamp, DeterminesTheGain)
{
  const auto [direction, flicker, vibration] = GetParam();
  for (const std::uint64_t seed : { 11, 12 })
  {
    const Report report = MeasureRamp(direction, { flicker, vibration, vibration }, seed);
    ASSERT_TRUE(report.gain.value && report.gain.standardError) << seed;
    EXPECT_NEAR(*report.gain.value, SimulationSettings().camera.gainDnPerElectron, 3.0 * *report.gain.standardError)
      << seed;
    EXPECT_LT(*report.gain.standardError, 0.02 * *report.gain.value) << seed;
    // An identified offset is right; otherwise it is not identifiable.
    const double offsetDn = SimulationSettings().camera.offsetDn;
    if (report.offset.value)
    {
      EXPECT_NEAR(*report.offset.value, offsetDn, 3.0 * *report.offset.standardError) << seed;
    }
    ASSERT_TRUE(report.offset.bracket) << seed;
    EXPECT_LT(report.offset.bracket->low.value_or(0.0), offsetDn) << seed;
    EXPECT_GT(report.offset.bracket->high.value_or(1e9), offsetDn) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(,
                         SensorNoiseRamp,
                         ::testing::Combine(::testing::Values("x", "y", "diagonal"),
                                            ::testing::Values(0.0, 0.01),
                                            ::testing::Values(0.0, 0.01, 0.1)));

TEST(SensorNoiseRampAlongAnAxis, FlickerIsIdentifiableAndMotionIsNot)
{
  for (const char * const direction : { "x", "y" })
  {
    const Report report = MeasureRamp(direction, { 0.01, 0.05, 0.05 }, 4);
    ASSERT_TRUE(report.flickerSd.value) << direction;
    double squares = 0.0;
    for (const double gamma : report.flicker)
    {
      squares += gamma * gamma;
    }
    EXPECT_NEAR(*report.flickerSd.value, std::sqrt(squares / (Frames - 1.0)), 1e-3) << direction;
    EXPECT_NEAR(*report.flickerSd.value, 0.01, 4.0 * 0.01 / std::sqrt(2.0 * Frames)) << direction;
    EXPECT_EQ(report.offset.status, EstimateStatus::NotIdentifiable) << direction;
    EXPECT_EQ(report.vibrationSdX.status, EstimateStatus::NotIdentifiable) << direction;
    EXPECT_EQ(report.vibrationSdY.status, EstimateStatus::NotIdentifiable) << direction;
    EXPECT_TRUE(std::any_of(report.warnings.begin(),
                            report.warnings.end(),
                            [](const Warning & warning) {
                              return warning.code == WarningCode::OffsetNotIdentifiable &&
                                     warning.message.find("ramp") != std::string::npos;
                            }))
      << direction;
  }
}

// With noise the levels of a dark ramp are distinguished from motion: the offset is identified within 4 DN. With the
// flicker about a wrong offset all levels move. An identified vibration contains the truth, and no vibration is
// identified along one axis if motion along the other axis looks the same.
TEST(SensorNoiseRampAlongAnAxis, FlickerAboutAWrongOffsetIsNoMotion)
{
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
  {
    SimulationSettings settings;
    settings.conditions = { 0.02, 0.02, 0.02 };
    settings.camera.gainDnPerElectron = 1.0;
    settings.camera.electrons = 1000.0;
    settings.camera.readNoiseDn = 1.0;
    settings.frames = Frames;
    settings.seed = seed;
    const auto scene = RampAlong(seed % 2 == 0 ? "x" : "diagonal");
    const auto report = Measure(Simulate<std::uint16_t>(settings, Size, Size, scene)).GetReport();
    for (const Quantity * const sd : { &report.vibrationSdX, &report.vibrationSdY })
    {
      if (sd->interval95)
      {
        EXPECT_LT(sd->interval95->low.value_or(0.0), 0.025) << seed;
        EXPECT_GT(sd->interval95->high.value_or(1.0), 0.015) << seed;
      }
    }
    if (seed % 2 != 0)
    {
      EXPECT_FALSE(report.vibrationSdX.value) << seed;
      EXPECT_FALSE(report.vibrationSdY.value) << seed;
    }
  }
}
