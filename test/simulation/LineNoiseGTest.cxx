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
constexpr std::size_t Width = 40;
constexpr std::size_t Height = 50;

std::vector<double>
FrameOf(const LineNoise & noise, std::size_t frame)
{
  std::vector<double> values(Width * Height, 0.0);
  for (std::size_t y = 0; y < Height; ++y)
  {
    noise.AddTo(values.data() + y * Width, Width, frame, y);
  }
  return values;
}

/** Returns one number a row (step 1) or a column (step Width) of every frame. */
std::vector<double>
Collect(const LineNoise & noise, std::size_t frames, std::size_t step, std::size_t count)
{
  std::vector<double> collected;
  for (std::size_t frame = 0; frame < frames; ++frame)
  {
    const auto values = FrameOf(noise, frame);
    for (std::size_t i = 0; i < count; ++i)
    {
      collected.push_back(values[i * step]);
    }
  }
  return collected;
}
} // namespace

TEST(SensorNoiseLineNoise, RowsHaveOneNumberAndNeighboursDoNot)
{
  LineNoiseSettings settings;
  settings.rowNoiseSdDn = 3.0;
  const LineNoise noise(settings, 7);
  const auto      values = FrameOf(noise, 2);
  for (std::size_t pixel = 0; pixel < values.size(); ++pixel)
  {
    ASSERT_EQ(values[pixel], values[pixel / Width * Width]);
  }
  EXPECT_EQ(values[0], noise.OfRow(2, 0));
  const Moments moments = MomentsOf(Collect(noise, 100, Width, Height));
  EXPECT_NEAR(moments.mean, 0.0, 5.0 * 3.0 / std::sqrt(moments.count));
  EXPECT_NEAR(std::sqrt(moments.variance), 3.0, 5.0 * 3.0 / std::sqrt(2.0 * moments.count));
}

TEST(SensorNoiseLineNoise, ColumnsHaveOneNumber)
{
  LineNoiseSettings settings;
  settings.columnNoiseSdDn = 2.0;
  const LineNoise noise(settings, 7);
  const auto      values = FrameOf(noise, 2);
  for (std::size_t pixel = 0; pixel < values.size(); ++pixel)
  {
    ASSERT_EQ(values[pixel], values[pixel % Width]);
  }
  const Moments moments = MomentsOf(Collect(noise, 100, 1, Width));
  EXPECT_NEAR(moments.mean, 0.0, 5.0 * 2.0 / std::sqrt(moments.count));
  EXPECT_NEAR(std::sqrt(moments.variance), 2.0, 5.0 * 2.0 / std::sqrt(2.0 * moments.count));
}

TEST(SensorNoiseLineNoise, BandingIsASineOfItsPeriod)
{
  LineNoiseSettings settings;
  settings.bandingAmplitudeDn = 4.0;
  settings.bandingPeriodRows = 25.0;
  const LineNoise noise(settings, 7);
  for (std::size_t frame = 0; frame < 5; ++frame)
  {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t y = 0; y < Height; ++y) // two periods
    {
      const double value = noise.OfRow(frame, y);
      EXPECT_NEAR(value, noise.OfRow(frame, y + 25), 1e-12);
      sum += value;
      squares += value * value;
    }
    EXPECT_NEAR(sum, 0.0, 1e-11);
    EXPECT_NEAR(squares / Height, 0.5 * 4.0 * 4.0, 1e-11);
  }
  EXPECT_NE(noise.OfRow(0, 0), noise.OfRow(1, 0));
}

TEST(SensorNoiseLineNoise, PartsAdd)
{
  LineNoiseSettings rows;
  rows.rowNoiseSdDn = 3.0;
  LineNoiseSettings columns;
  columns.columnNoiseSdDn = 2.0;
  LineNoiseSettings both = rows;
  both.columnNoiseSdDn = 2.0;
  const auto ofRows = FrameOf(LineNoise(rows, 7), 1);
  const auto ofColumns = FrameOf(LineNoise(columns, 7), 1);
  const auto ofBoth = FrameOf(LineNoise(both, 7), 1);
  for (std::size_t pixel = 0; pixel < ofBoth.size(); ++pixel)
  {
    EXPECT_NEAR(ofBoth[pixel], ofRows[pixel] + ofColumns[pixel], 1e-14);
  }
}

TEST(SensorNoiseLineNoise, DarkFramesHaveNoiseOfTheirOwn)
{
  for (const LineNoiseSettings & settings :
       { LineNoiseSettings{ 3.0, 0.0, 0.0 }, LineNoiseSettings{ 0.0, 2.0, 0.0 }, LineNoiseSettings{ 0.0, 0.0, 4.0 } })
  {
    EXPECT_NE(FrameOf(LineNoise(settings, 7), 0)[0], FrameOf(LineNoise(settings, 7, true), 0)[0]);
    EXPECT_EQ(FrameOf(LineNoise(settings, 7, true), 0), FrameOf(LineNoise(settings, 7, true), 0));
  }
}

TEST(SensorNoiseLineNoise, BadSettingsAreRefused)
{
  EXPECT_THROW(CheckSettings(LineNoiseSettings{ -1.0, 0.0, 0.0, 64.0 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(LineNoiseSettings{ 0.0, INFINITY, 0.0, 64.0 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(LineNoiseSettings{ 0.0, 0.0, -2.0, 64.0 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(LineNoiseSettings{ 0.0, 0.0, 0.0, 0.0 }), std::invalid_argument);
}
