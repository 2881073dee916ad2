// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/SimulatedSensor.h"
#include "base/Quantiles.h"
#include "helpers/SimulatorTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::simulator;

namespace
{
constexpr std::size_t Pixels = 400000;

std::vector<double>
LogarithmOf(std::vector<double> values)
{
  std::transform(values.begin(), values.end(), values.begin(), [](double value) { return std::log(value); });
  return values;
}

double
MeanSquare(const std::vector<double> & values)
{
  const Moments moments = MomentsOf(values);
  return moments.mean * moments.mean + moments.variance;
}
} // namespace

TEST(SensorNoiseReadNoisePattern, CoreIsLogNormalWithMedianOne)
{
  const auto    factors = DrawReadNoisePattern({ 0.25, 0.0, 1.0 }, 3, Pixels);
  const Moments moments = MomentsOf(LogarithmOf(factors));
  EXPECT_NEAR(moments.mean, 0.0, 5.0 * 0.25 / std::sqrt(Pixels));
  EXPECT_NEAR(std::sqrt(moments.variance), 0.25, 5.0 * 0.25 / std::sqrt(2.0 * Pixels));
  // Standard error of a median: sqrt(pi / 2) of the standard error of the mean.
  EXPECT_NEAR(QuantileOf(factors, 0.5), 1.0, 5.0 * 1.2533 * 0.25 / std::sqrt(Pixels));
  // E[f^2] = exp(2 s^2); its relative standard error is sqrt(exp(4 s^2) - 1) / sqrt(n).
  const double error = std::sqrt(std::expm1(4.0 * 0.0625) / Pixels);
  EXPECT_NEAR(MeanSquare(factors) / std::exp(2.0 * 0.0625), 1.0, 5.0 * error);
}

TEST(SensorNoiseReadNoisePattern, TailHoldsItsFractionAndItsSquare)
{
  constexpr double fraction = 0.05;
  constexpr double tailSpread = 0.6;
  const auto       factors = DrawReadNoisePattern({ 0.0, fraction, tailSpread }, 3, Pixels);
  const auto       inTail = std::count_if(factors.begin(), factors.end(), [](double f) { return f != 1.0; });
  EXPECT_NEAR(static_cast<double>(inTail), fraction * Pixels, 5.0 * std::sqrt(fraction * Pixels));
  EXPECT_GE(*std::min_element(factors.begin(), factors.end()), 1.0);
  // E[exp(2 t |m|)] = 2 exp(2 t^2) Phi(2 t), and the same with 4 t for the square.
  const auto   moment = [](double k) { return std::exp(0.5 * k * k) * std::erfc(-k / std::sqrt(2.0)); };
  const double square = 1.0 + fraction * (moment(2.0 * tailSpread) - 1.0);
  const double fourth = 1.0 + fraction * (moment(4.0 * tailSpread) - 1.0);
  EXPECT_NEAR(MeanSquare(factors), square, 5.0 * std::sqrt((fourth - square * square) / Pixels));
}

TEST(SensorNoiseReadNoisePattern, MoreDispersionLeavesTheSamePixelsNoisy)
{
  const auto narrow = LogarithmOf(DrawReadNoisePattern({ 0.1, 0.0, 1.0 }, 3, 1000));
  const auto wide = LogarithmOf(DrawReadNoisePattern({ 0.3, 0.0, 1.0 }, 3, 1000));
  for (std::size_t pixel = 0; pixel < narrow.size(); ++pixel)
  {
    EXPECT_NEAR(wide[pixel], 3.0 * narrow[pixel], 1e-14);
  }
}

TEST(SensorNoiseReadNoisePattern, NothingIsDrawnUnlessAskedFor)
{
  EXPECT_TRUE(DrawReadNoisePattern({}, 3, 10).empty());
  EXPECT_TRUE(DrawReadNoisePattern({ 0.0, 0.5, 0.0 }, 3, 10).empty());
}

TEST(SensorNoiseReadNoisePattern, BadSettingsAreRefused)
{
  EXPECT_THROW(CheckSettings(ReadNoiseSettings{ -0.1, 0.0, 1.0 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(ReadNoiseSettings{ 3.1, 0.0, 1.0 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(ReadNoiseSettings{ 0.1, 1.1, 1.0 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(ReadNoiseSettings{ 0.1, 0.1, 4.0 }), std::invalid_argument);
  EXPECT_NO_THROW(CheckSettings(ReadNoiseSettings{ 0.2, 0.03, 1.0 }));
}
