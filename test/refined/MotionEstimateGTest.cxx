// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"
#include "sensornoise/Report.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/Simulator.h"
#include "helpers/RefinedTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Size = 96;

double
CovarianceOfSeries(const std::vector<double> & a, const std::vector<double> & b)
{
  const auto frames = static_cast<double>(a.size());
  double     sumA = 0.0;
  double     sumB = 0.0;
  double     product = 0.0;
  for (std::size_t t = 0; t < a.size(); ++t)
  {
    sumA += a[t];
    sumB += b[t];
    product += a[t] * b[t];
  }
  return (product - sumA * sumB / frames) / (frames - 1.0);
}
} // namespace

// The signal is small, so that the noise of the shifts is as large as the shifts. If the errors are right, the mean
// square of 16 deviations in standard errors is chi2 / 16, from 0.25 to 2.45 in 99.8 of 100 cases.
TEST(SensorNoiseMotionEstimate, TheCovarianceOfTheVibrationHasAnError)
{
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed)
  {
    SimulationSettings settings = FlickeringSettings(30);
    settings.camera.electrons = 300.0;
    settings.conditions.vibrationSdXPixels = 0.03;
    settings.conditions.vibrationSdYPixels = 0.03;
    settings.seed = seed;
    const SimulatedSeries series = DrawTruth(settings, Size).series;
    const Report          report = Measure(Simulate<unsigned short>(settings, Size, Size)).GetReport();
    const Quantity &      covariance = report.vibrationCovariance;
    ASSERT_TRUE(covariance.value && covariance.standardError && covariance.interval95) << seed;
    EXPECT_LT(*covariance.standardError, 0.03 * 0.03);
    const double z = (*covariance.value - CovarianceOfSeries(series.alpha, series.beta)) / *covariance.standardError;
    squares += z * z;
  }
  EXPECT_GT(squares / 16.0, 0.25);
  EXPECT_LT(squares / 16.0, 2.45);
}

// With the refined method every quantity with a value has a standard error and an interval.
TEST(SensorNoiseMotionEstimate, WhatIsIdentifiedHasAnError)
{
  const Report report = Measure(Simulate<unsigned short>(FlickeringSettings(30), Size, Size)).GetReport();
  for (const Quantity * quantity : { &report.gain,
                                     &report.varianceSlope,
                                     &report.offset,
                                     &report.readNoise,
                                     &report.readNoiseElectrons,
                                     &report.intercept,
                                     &report.totalIntercept,
                                     &report.flickerSd,
                                     &report.vibrationSdX,
                                     &report.vibrationSdY,
                                     &report.vibrationCovariance })
  {
    EXPECT_TRUE(quantity->value && quantity->standardError && quantity->interval95);
  }
}
