// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/FrameNoiseTestHelper.h"
#include "simulation/SimulatedSensor.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <numeric>
#include <stdexcept>

using namespace sensornoise;
using namespace sensornoise::test;

TEST(SensorNoiseBrighterFatter, FlowIsTheDifferenceTimesTheMeanCharge)
{
  DoubleFrame charge(3, 1);
  charge.values = { 1000.0, 3000.0, 1000.0 };
  const DoubleFrame out = SpreadCharge(charge, { 1e-6 }, SerialFor);
  // 1e-6 * (3000 - 1000) * 2000 = 4 electrons over each border.
  EXPECT_DOUBLE_EQ(out.values[0], 1004.0);
  EXPECT_DOUBLE_EQ(out.values[1], 2992.0);
  EXPECT_DOUBLE_EQ(out.values[2], 1004.0);
}

TEST(SensorNoiseBrighterFatter, TheFrameKeepsItsCharge)
{
  const DoubleFrame noise = PoissonFrame(40, 30, 2000.0, 1);
  const DoubleFrame out = SpreadCharge(noise, { 2e-6 }, SerialFor);
  EXPECT_NEAR(std::accumulate(out.values.begin(), out.values.end(), 0.0),
              std::accumulate(noise.values.begin(), noise.values.end(), 0.0),
              1e-6);
}

TEST(SensorNoiseBrighterFatter, LossOfVarianceGrowsWithTheSquareOfTheLevel)
{
  constexpr double k = 2e-6;
  for (const double level : { 1000.0, 4000.0 })
  {
    SCOPED_TRACE(level);
    const auto found = CovarianceOf(SpreadCharge(PoissonFrame(600, 500, level, 2), { k }, SerialFor));
    // As a coupling of the fraction k Q; what the noise of Q adds to the fraction is of the order of k^2 Q^2, too
    // small.
    const double c = k * level;
    const double middle = 1.0 - 4.0 * c;
    const double error = 5.0 * level / std::sqrt(0.5 * 600.0 * 500.0);
    EXPECT_NEAR(found.variance, level * (middle * middle + 4.0 * c * c), error);
    EXPECT_NEAR(found.horizontal, level * 2.0 * c * middle, error);
    EXPECT_NEAR(found.vertical, level * 2.0 * c * middle, error);
    EXPECT_GT(level - found.variance, 0.8 * 8.0 * k * level * level - error);
  }
}

TEST(SensorNoiseBrighterFatter, BadSettingsAreRefused)
{
  EXPECT_THROW(CheckSettings(BrighterFatterSettings{ -1e-6 }, 3000.0), std::invalid_argument);
  EXPECT_THROW(CheckSettings(BrighterFatterSettings{ 1e-4 }, 3000.0), std::invalid_argument);
  EXPECT_NO_THROW(CheckSettings(BrighterFatterSettings{ 1e-4 }, 1000.0));
}
