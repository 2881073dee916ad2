// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/StackReport.h"
#include "report/Quantities.h"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

using namespace sensornoise;

namespace
{
Report
OfMultipliedElectrons()
{
  Report report;
  report.gain = report.varianceSlope = WithError(20.0, 0.2);
  report.readNoise = WithError(30.0, 0.3);
  report.readNoiseElectrons = WithError(1.5, 0.02);
  report.totalIntercept = WithError(-1000.0, 5.0);
  report.covariance = { { { 0.04, -0.5, 0.0 }, { -0.5, 25.0, 0.0 }, { 0.0, 0.0, 1.0 } } };
  return report;
}
} // namespace

TEST(SensorNoiseExcessNoise, IsDividedOutOfTheGainAlone)
{
  const Report plain = OfMultipliedElectrons();
  Report       report = plain;
  DivideExcessNoise(report, 2.0);
  EXPECT_DOUBLE_EQ(*report.gain.value, 10.0);
  EXPECT_DOUBLE_EQ(*report.gain.standardError, 0.1);
  EXPECT_DOUBLE_EQ(*report.gain.interval95->low, 0.5 * *plain.gain.interval95->low);
  EXPECT_DOUBLE_EQ(*report.readNoiseElectrons.value, 3.0);
  EXPECT_DOUBLE_EQ(*report.readNoise.value / *report.gain.value, *report.readNoiseElectrons.value);
  EXPECT_EQ(report.varianceSlope.value, plain.varianceSlope.value);
  EXPECT_EQ(report.totalIntercept.value, plain.totalIntercept.value);
  EXPECT_DOUBLE_EQ((*report.covariance)[0][0], 0.01); // the gain's standard error
  EXPECT_DOUBLE_EQ((*report.covariance)[0][1], -0.25);
  EXPECT_DOUBLE_EQ((*report.covariance)[1][1], 25.0);
  ASSERT_EQ(report.settings.size(), 1U);
  EXPECT_EQ(report.settings[0].first, "excess_noise_factor");
  EXPECT_EQ(report.settings[0].second, Report::SettingValue{ 2.0 });
}

TEST(SensorNoiseExcessNoise, IsDividedOutOfTheGainsOfParts)
{
  Report report = OfMultipliedElectrons();
  report.gainByParts = { { "left-right", { { "left half", 18.0, 0.3, 0.5 }, { "right half", 22.0, 0.4, 0.5 } } } };
  DivideExcessNoise(report, 2.0);
  const auto & parts = report.gainByParts[0].parts;
  EXPECT_DOUBLE_EQ(parts[0].gain, 9.0);
  EXPECT_DOUBLE_EQ(parts[1].gain, 11.0);
  EXPECT_DOUBLE_EQ(parts[1].standardError, 0.2);
  EXPECT_DOUBLE_EQ(parts[1].pixelFraction, 0.5);
}

TEST(SensorNoiseExcessNoise, OfOneChangesNothing)
{
  Report report = OfMultipliedElectrons();
  DivideExcessNoise(report, 1.0);
  EXPECT_EQ(report.gain.value, 20.0);
  EXPECT_TRUE(report.settings.empty());
}

TEST(SensorNoiseExcessNoise, FactorsThatAreNoneAreRefused)
{
  EXPECT_NO_THROW(ValidateExcessNoiseFactor(1.0));
  for (const double factor : { 0.99, 0.0, -2.0, std::nan(""), HUGE_VAL })
  {
    EXPECT_THROW(ValidateExcessNoiseFactor(factor), std::invalid_argument) << factor;
  }
}
