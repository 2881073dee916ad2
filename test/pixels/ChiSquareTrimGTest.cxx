// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceFit.h"

#include "pixels/Constants.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sensornoise;

namespace
{
/** Returns the integral of x^power times the chi-square density from \a low to \a high, by Simpson's rule. */
double
Integrate(double k, double low, double high, int power)
{
  const auto density = [&](double x) {
    return std::exp((0.5 * k - 1.0) * std::log(x) - 0.5 * x - 0.5 * k * std::log(2.0) - std::lgamma(0.5 * k)) *
           std::pow(x, power);
  };
  constexpr int steps = 4000;
  double        sum = density(low) + density(high);
  for (int i = 1; i < steps; ++i)
  {
    sum += (i % 2 == 1 ? 4.0 : 2.0) * density(low + (high - low) * i / steps);
  }
  return sum * (high - low) / steps / 3.0;
}
} // namespace

TEST(SensorNoiseChiSquareTrim, MeanFactorAgreesWithNumericalIntegration)
{
  const ChiSquareTrim trim(4.0, 200.0);
  for (const double k : { 4.0, 17.0, 95.0, 200.0 })
  {
    const auto & limits = trim.Of(k);
    const double inside = Integrate(k, k * limits.low, k * limits.high, 0);
    EXPECT_NEAR(inside, 1.0 - 2.0 * InPixels.trimTail, 1e-9) << k;
    EXPECT_NEAR(Integrate(k, 1e-9, k * limits.low, 0), InPixels.trimTail, 1e-8) << k;
    EXPECT_NEAR(limits.mean, Integrate(k, k * limits.low, k * limits.high, 1) / inside / k, 1e-9) << k;
    EXPECT_NEAR(Integrate(k, 1e-9, k * limits.median, 0), 0.5, 1e-8) << k;
  }
}

TEST(SensorNoiseChiSquareTrim, DegreesOfFreedomAreRoundedAndHeldInTheRange)
{
  const ChiSquareTrim trim(10.2, 20.7);
  EXPECT_EQ(trim.Of(12.4).high, trim.Of(12.0).high);
  EXPECT_EQ(trim.Of(3.0).high, trim.Of(10.0).high);
  EXPECT_EQ(trim.Of(99.0).high, trim.Of(21.0).high);
  EXPECT_GT(trim.Of(10.0).high, trim.Of(21.0).high);
  EXPECT_GT(ChiSquareTrim(0.1, 0.2).Of(0.1).high, 1.0); // at least one
}
