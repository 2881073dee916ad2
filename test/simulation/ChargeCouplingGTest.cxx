// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/SimulatedSensor.h"
#include "simulation/Random.h"
#include "helpers/FrameNoiseTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <numeric>
#include <stdexcept>

using namespace sensornoise;
using namespace sensornoise::test;

TEST(SensorNoiseChargeCoupling, APixelGivesToItsFourNeighbours)
{
  DoubleFrame charge(5, 4);
  charge.Row(1)[2] = 1000.0;
  const DoubleFrame out = CoupleCharge(charge, { 0.02 }, SerialFor);
  EXPECT_DOUBLE_EQ(out.Row(1)[2], 920.0);
  EXPECT_DOUBLE_EQ(out.Row(1)[1], 20.0);
  EXPECT_DOUBLE_EQ(out.Row(1)[3], 20.0);
  EXPECT_DOUBLE_EQ(out.Row(0)[2], 20.0);
  EXPECT_DOUBLE_EQ(out.Row(2)[2], 20.0);
  EXPECT_EQ(out.Row(0)[1], 0.0);
  EXPECT_EQ(out.Row(3)[2], 0.0);
}

TEST(SensorNoiseChargeCoupling, TheFrameKeepsItsChargeAndAnEvenFrameItsLevel)
{
  const DoubleFrame noise = PoissonFrame(40, 30, 200.0, 1);
  const DoubleFrame out = CoupleCharge(noise, { 0.02 }, SerialFor);
  const auto        sum = [](const DoubleFrame & frame) {
    return std::accumulate(frame.values.begin(), frame.values.end(), 0.0);
  };
  EXPECT_NEAR(sum(out), sum(noise), 1e-7);
  DoubleFrame even(7, 6);
  std::fill(even.values.begin(), even.values.end(), 300.0);
  EXPECT_EQ(CoupleCharge(even, { 0.02 }, SerialFor).values, even.values);
}

TEST(SensorNoiseChargeCoupling, ShotNoiseLosesVarianceToItsNeighbours)
{
  constexpr double c = 0.02;
  constexpr double level = 500.0;
  const auto       found = CovarianceOf(CoupleCharge(PoissonFrame(600, 500, level, 2), { c }, SerialFor));
  // The kernel (1 - 4c in the middle, c around): its autocorrelation at lags (0, 0), (1, 0), (1, 1), (2, 0).
  const double middle = 1.0 - 4.0 * c;
  const double error = 5.0 * level / std::sqrt(0.5 * 600.0 * 500.0); // 5 standard errors of the variance
  EXPECT_NEAR(found.variance, level * (middle * middle + 4.0 * c * c), error);
  EXPECT_NEAR(found.horizontal, level * 2.0 * c * middle, error);
  EXPECT_NEAR(found.vertical, level * 2.0 * c * middle, error);
  EXPECT_NEAR(found.diagonal, level * 2.0 * c * c, error);
}

TEST(SensorNoiseChargeCoupling, SameBitsForAnyNumberOfThreads)
{
  const DoubleFrame noise = PoissonFrame(61, 53, 200.0, 3);
  EXPECT_EQ(CoupleCharge(noise, { 0.01 }, Threads(3)).values, CoupleCharge(noise, { 0.01 }, SerialFor).values);
}

TEST(SensorNoiseChargeCoupling, BadSettingsAreRefused)
{
  EXPECT_THROW(CheckSettings(CouplingSettings{ -0.01 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(CouplingSettings{ 0.3 }), std::invalid_argument);
  EXPECT_NO_THROW(CheckSettings(CouplingSettings{ 0.2 }));
}
