// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/SimulatedSensor.h"
#include "helpers/SimulatorTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::simulator;

namespace
{
constexpr std::size_t   Width = 300;
constexpr std::size_t   Height = 200;
constexpr std::uint64_t Seed = 9;

/** Returns 5 standard errors of the standard deviation of so many normal numbers. */
double
FiveErrors(double sd, std::size_t count)
{
  return 5.0 * sd / std::sqrt(2.0 * static_cast<double>(count));
}

std::vector<double>
MeanOfColumns(const std::vector<double> & map)
{
  std::vector<double> means(Width, 0.0);
  for (std::size_t pixel = 0; pixel < map.size(); ++pixel)
  {
    means[pixel % Width] += map[pixel] / static_cast<double>(Height);
  }
  return means;
}
} // namespace

TEST(SensorNoiseGainPattern, GainHasItsStandardDeviationAndMeanOne)
{
  PatternSettings settings;
  settings.gainSd = 0.02;
  const Moments moments = MomentsOf(DrawGainPattern(settings, Seed, Width, Height));
  EXPECT_NEAR(moments.mean, 1.0, 1e-12); // rounding of 60000 additions
  EXPECT_NEAR(std::sqrt(moments.variance), 0.02, FiveErrors(0.02, Width * Height));
}

TEST(SensorNoiseGainPattern, ColumnsHaveAStandardDeviationOfTheirOwn)
{
  PatternSettings settings;
  settings.columnGainSd = 0.03;
  auto map = DrawGainPattern(settings, Seed, Width, Height);
  for (std::size_t pixel = Width; pixel < map.size(); ++pixel)
  {
    ASSERT_EQ(map[pixel], map[pixel % Width]);
  }
  EXPECT_NEAR(MomentsOf(map).mean, 1.0, 1e-12);
  EXPECT_NEAR(std::sqrt(MomentsOf(MeanOfColumns(map)).variance), 0.03, FiveErrors(0.03, Width));
  // Both together: of a column's mean, the pixels' share is 0.02 / sqrt(200) = 0.0014, which adds 0.1 % in square.
  settings.gainSd = 0.02;
  map = DrawGainPattern(settings, Seed, Width, Height);
  EXPECT_NEAR(std::sqrt(MomentsOf(map).variance), std::hypot(0.02, 0.03), FiveErrors(0.03, Width));
  EXPECT_NEAR(std::sqrt(MomentsOf(MeanOfColumns(map)).variance), 0.03, FiveErrors(0.03, Width) + 0.0001);
}

TEST(SensorNoiseGainPattern, ColumnsOfEfficiencyAndOffset)
{
  PatternSettings settings;
  settings.columnEfficiencySd = 0.01;
  settings.columnOffsetSdDn = 4.0;
  const Moments efficiency = MomentsOf(DrawColumnEfficiency(settings, Seed, Width));
  EXPECT_EQ(efficiency.count, Width);
  EXPECT_NEAR(efficiency.mean, 1.0, 1e-13);
  EXPECT_NEAR(std::sqrt(efficiency.variance), 0.01, FiveErrors(0.01, Width));
  const Moments offset = MomentsOf(DrawColumnOffsetDn(settings, Seed, Width));
  EXPECT_NEAR(offset.mean, 0.0, 5.0 * 4.0 / std::sqrt(Width));
  EXPECT_NEAR(std::sqrt(offset.variance), 4.0, FiveErrors(4.0, Width));
}

TEST(SensorNoiseGainPattern, NothingIsDrawnUnlessAskedFor)
{
  EXPECT_TRUE(DrawGainPattern({}, Seed, Width, Height).empty());
  EXPECT_TRUE(DrawColumnEfficiency({}, Seed, Width).empty());
  EXPECT_TRUE(DrawColumnOffsetDn({}, Seed, Width).empty());
}

TEST(SensorNoiseGainPattern, BadSettingsAreRefused)
{
  EXPECT_THROW(CheckSettings(PatternSettings{ 0.2 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(PatternSettings{ 0.0, -0.1 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(PatternSettings{ 0.0, 0.0, NAN }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(PatternSettings{ 0.0, 0.0, 0.0, -1.0 }), std::invalid_argument);
  EXPECT_NO_THROW(CheckSettings(PatternSettings{ 0.1, 0.1, 0.1, 100.0 }));
}
