// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/SimulatedSensor.h"
#include "helpers/SimulatorTestHelper.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::simulator;

// Causes of one kind together: the pixels' and the columns' part, hot pixels and the spread of the read noise.

namespace
{
constexpr std::size_t Width = 30;
constexpr std::size_t Height = 20;
constexpr std::size_t Pixels = Width * Height;
} // namespace

TEST(SensorNoiseFixedPattern, EfficiencyIsThePixelsTimesTheColumns)
{
  SimulationSettings settings = StaticSettings('B', 1);
  EXPECT_TRUE(DrawEfficiency(settings, Width, Height).empty());
  settings.prnuSd = 0.02;
  const auto ofPixels = DrawEfficiency(settings, Width, Height);
  settings.flaws.pattern.columnEfficiencySd = 0.03;
  const auto both = DrawEfficiency(settings, Width, Height);
  const auto ofColumns = DrawColumnEfficiency(settings.flaws.pattern, settings.seed, Width);
  settings.prnuSd = 0.0;
  const auto columnsAlone = DrawEfficiency(settings, Width, Height);
  for (std::size_t pixel = 0; pixel < Pixels; ++pixel)
  {
    EXPECT_DOUBLE_EQ(both[pixel], ofPixels[pixel] * ofColumns[pixel % Width]);
    EXPECT_EQ(columnsAlone[pixel], ofColumns[pixel % Width]);
  }
}

TEST(SensorNoiseFixedPattern, OffsetIsThePixelsPlusTheColumns)
{
  SimulationSettings settings = StaticSettings('B', 1);
  EXPECT_TRUE(DrawOffsetDn(settings, Width, Height).empty());
  settings.dsnuSdDn = 2.0;
  const auto ofPixels = DrawOffsetDn(settings, Width, Height);
  settings.flaws.pattern.columnOffsetSdDn = 3.0;
  const auto both = DrawOffsetDn(settings, Width, Height);
  const auto ofColumns = DrawColumnOffsetDn(settings.flaws.pattern, settings.seed, Width);
  for (std::size_t pixel = 0; pixel < Pixels; ++pixel)
  {
    EXPECT_DOUBLE_EQ(both[pixel], ofPixels[pixel] + ofColumns[pixel % Width]);
  }
}

TEST(SensorNoiseFixedPattern, ReadNoiseIsTheCamerasTimesTheFactors)
{
  SimulationSettings settings = StaticSettings('B', 1);
  EXPECT_TRUE(DrawReadNoiseDn(settings, Width, Height).empty());
  settings.hotPixelFraction = 0.2;
  const auto hot = DrawReadNoiseDn(settings, Width, Height);
  settings.flaws.readNoise.spread = 0.3;
  const auto both = DrawReadNoiseDn(settings, Width, Height);
  settings.hotPixelFraction = 0.0;
  const auto spread = DrawReadNoiseDn(settings, Width, Height);
  const auto factors = DrawReadNoisePattern(settings.flaws.readNoise, settings.seed, Pixels);
  for (std::size_t pixel = 0; pixel < Pixels; ++pixel)
  {
    EXPECT_DOUBLE_EQ(spread[pixel], 8.0 * factors[pixel]);
    EXPECT_DOUBLE_EQ(both[pixel], hot[pixel] * factors[pixel]);
  }
}
