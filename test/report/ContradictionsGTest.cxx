// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/report/Contradictions.h"
#include "sensornoise/report/Quantities.h"
#include "helpers/ReportTestHelper.h"

#include <gtest/gtest.h>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
/** A report whose numbers agree. */
Report
Consistent()
{
  Report report;
  report.gain = report.varianceSlope = WithError(0.5, 0.001);
  report.offset = WithError(100.0, 0.5);
  report.readNoise = WithError(3.0, 0.1);
  report.vibrationSdX = report.vibrationSdY = WithError(0.3, 0.001);
  report.fit.reducedChi2 = 1.0;
  report.covariance.emplace();
  return report;
}

void
ExpectWithdrawn(Report report, EstimateStatus status)
{
  WithdrawContradicted(report);
  EXPECT_EQ(report.gain.status, status);
  EXPECT_EQ(report.offset.status, status);
  EXPECT_EQ(report.readNoise.status, status);
  EXPECT_FALSE(report.gain.value);
  EXPECT_FALSE(report.covariance);
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_TRUE(HasWarning(report, WarningCode::Contradicted));
}
} // namespace

TEST(SensorNoiseContradictions, WhatAgreesStands)
{
  for (const double chi2 : { LeastReducedChi2, 1.0, 100.0 })
  {
    Report report = Consistent();
    report.fit.reducedChi2 = chi2;
    WithdrawContradicted(report);
    EXPECT_EQ(report.gain.status, EstimateStatus::Identified) << chi2;
    EXPECT_TRUE(report.covariance);
    EXPECT_TRUE(report.warnings.empty());
  }
}

TEST(SensorNoiseContradictions, AVarianceThatScattersTooLittleWithdrawsTheGain)
{
  for (const double chi2 : { 0.9 * LeastReducedChi2, 0.001 })
  {
    Report report = Consistent();
    report.fit.reducedChi2 = chi2;
    ExpectWithdrawn(report, EstimateStatus::Failed);
  }
}

TEST(SensorNoiseContradictions, AVibrationOfManyPixelsIsNone)
{
  Report report = Consistent();
  report.vibrationSdY = WithError(21.0, 0.1);
  WithdrawContradicted(report);
  EXPECT_EQ(report.vibrationSdX.status, EstimateStatus::Identified);
  EXPECT_EQ(report.vibrationSdY.status, EstimateStatus::Failed);
  EXPECT_EQ(report.vibrationCovariance.status, EstimateStatus::Failed);
  EXPECT_EQ(report.gain.status, EstimateStatus::Identified);
}

TEST(SensorNoiseContradictions, AGainThatMayBeZeroIsNotIdentified)
{
  Report report = Consistent();
  report.gain.interval95 = Interval{ -0.1, 1.1 };
  ExpectWithdrawn(report, EstimateStatus::NotIdentifiable);
}

TEST(SensorNoiseContradictions, WhatIsNotIdentifiedIsLeftAlone)
{
  Report report = Consistent();
  report.gain = Quantity::Without(EstimateStatus::NotIdentifiable);
  report.fit.reducedChi2 = 0.001;
  WithdrawContradicted(report);
  EXPECT_EQ(report.offset.status, EstimateStatus::Identified);
  EXPECT_TRUE(report.warnings.empty());
}
