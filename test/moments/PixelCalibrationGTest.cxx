// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/ChiSquare.h"
#include "sensornoise/Settings.h"
#include "helpers/DarkPixelsTestHelper.h"
#include "moments/DarkFrames.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/** Returns the fraction of the pixels whose interval contains the truth. */
double
CoverageOf(const IntervalMapDn & map, const std::vector<double> & truth)
{
  double inside = 0.0;
  for (std::size_t p = 0; p < truth.size(); ++p)
  {
    inside += map.low[p] <= truth[p] && truth[p] <= map.high[p] ? 1.0 : 0.0;
  }
  return inside / static_cast<double>(truth.size());
}
} // namespace

TEST(SensorNoisePixelCalibration, IntervalsAreStudentsAndChiSquares)
{
  const PixelCalibration maps = MakePixelCalibration({ { 100.0 }, { 16.0 }, { 1 }, 8, 0.0 });
  EXPECT_EQ(maps.offset.value[0], 100.0);
  const double half = StudentQuantile(0.975, 7.0) * 4.0 / std::sqrt(8.0);
  EXPECT_DOUBLE_EQ(maps.offset.low[0], 100.0 - half);
  EXPECT_DOUBLE_EQ(maps.offset.high[0], 100.0 + half);
  EXPECT_EQ(maps.readNoise.value[0], 4.0);
  EXPECT_NEAR(maps.readNoise.low[0], 4.0 * std::sqrt(7.0 / 16.012764), 1e-6); // tabulated quantiles of 7 degrees
  EXPECT_NEAR(maps.readNoise.high[0], 4.0 * std::sqrt(7.0 / 1.689869), 1e-6);
}

TEST(SensorNoisePixelCalibration, RoundingIsSubtractedAndWhatItHidesIsInTheInterval)
{
  const PixelCalibration maps = MakePixelCalibration({ { 100.0, 100.0 }, { 3.0 + 1.0 / 3.0, 0.0 }, { 1, 1 }, 30, 2.0 });
  EXPECT_DOUBLE_EQ(maps.readNoise.value[0], std::sqrt(3.0));
  // A constant pixel: its level is within half a step of the digital number, and its noise is at most half a step.
  EXPECT_DOUBLE_EQ(maps.offset.low[1], 99.0);
  EXPECT_DOUBLE_EQ(maps.offset.high[1], 101.0);
  EXPECT_EQ(maps.readNoise.value[1], 0.0);
  EXPECT_EQ(maps.readNoise.low[1], 0.0);
  EXPECT_EQ(maps.readNoise.high[1], 1.0);
}

TEST(SensorNoisePixelCalibration, DefectivePixelsHaveValuesAndUnknownOnesNone)
{
  const PixelCalibration maps = MakePixelCalibration({ { 100.0, 300.0, NaN }, { 4.0, 9e4, NaN }, { 1, 0, 0 }, 8, 0.0 });
  EXPECT_EQ(maps.readNoise.value[1], 300.0);
  for (const IntervalMapDn & map : { maps.offset, maps.readNoise })
  {
    EXPECT_TRUE(std::isnan(map.value[2]) && std::isnan(map.low[2]) && std::isnan(map.high[2]));
  }
}

TEST(SensorNoisePixelCalibration, NineteenOfTwentyPixelsLieInTheirIntervals)
{
  const DarkSensor          sensor = MakeDarkSensor(20000, 4.0, LogNormalNoise(0.4, 0.05));
  const std::vector<double> drift{ 0.0, 3.0, -2.0, 5.0, 1.0, 0.5, -4.0, 2.0 };
  for (const std::size_t frames : { 8u, 50u })
  {
    std::vector<double> levels(frames);
    double              mean = 0.0;
    for (std::size_t t = 0; t < frames; ++t)
    {
      levels[t] = drift[t % drift.size()];
      mean += levels[t] / static_cast<double>(frames);
    }
    std::vector<double> offsets = sensor.offsetDn;
    for (double & offset : offsets)
    {
      offset += mean; // the level of these frames
    }
    const KnownOffset      dark = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, frames, levels));
    const PixelCalibration maps = MakePixelCalibration(*dark.maps, Threads(3));
    // The fraction of 20,000 pixels has the standard deviation 0.0015.
    EXPECT_NEAR(CoverageOf(maps.offset, offsets), 0.95, 0.007) << frames;
    EXPECT_NEAR(CoverageOf(maps.readNoise, sensor.readNoiseDn), 0.95, 0.007) << frames;
  }
}

TEST(SensorNoisePixelCalibration, MapsOfOneFrameAreRefused)
{
  EXPECT_THROW(MakePixelCalibration({ { 1.0 }, { 1.0 }, { 1 }, 1, 0.0 }), std::invalid_argument);
  EXPECT_THROW(MakePixelCalibration({ { 1.0, 2.0 }, { 1.0 }, { 1, 1 }, 5, 0.0 }), std::invalid_argument);
}
