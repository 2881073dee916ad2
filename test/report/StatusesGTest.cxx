// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/Quantities.h"
#include "helpers/ReportTestHelper.h"

#include "sensornoise/ReportText.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
/** Returns a report whose numbers agree. */
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
  FileStatuses(report);
  EXPECT_EQ(report.gain.status, status);
  EXPECT_EQ(report.offset.status, status);
  EXPECT_EQ(report.readNoise.status, status);
  EXPECT_FALSE(report.gain.value);
  EXPECT_FALSE(report.covariance);
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_TRUE(HasWarning(report, WarningCode::Contradicted));
}
} // namespace

TEST(SensorNoiseStatuses, WhatAgreesStands)
{
  for (const double chi2 : { LeastReducedChi2, 1.0, 100.0 })
  {
    Report report = Consistent();
    report.fit.reducedChi2 = chi2;
    FileStatuses(report);
    EXPECT_EQ(report.gain.status, EstimateStatus::Identified) << chi2;
    EXPECT_TRUE(report.covariance);
    EXPECT_TRUE(report.warnings.empty());
  }
}

TEST(SensorNoiseStatuses, AVarianceThatScattersTooLittleWithdrawsTheGain)
{
  for (const double chi2 : { 0.9 * LeastReducedChi2, 0.001 })
  {
    Report report = Consistent();
    report.fit.reducedChi2 = chi2;
    ExpectWithdrawn(report, EstimateStatus::Failed);
  }
}

TEST(SensorNoiseStatuses, AVibrationOfManyPixelsIsNone)
{
  Report report = Consistent();
  report.vibrationSdY = WithError(21.0, 0.1);
  FileStatuses(report);
  EXPECT_EQ(report.vibrationSdX.status, EstimateStatus::Identified);
  EXPECT_EQ(report.vibrationSdY.status, EstimateStatus::Failed);
  EXPECT_EQ(report.vibrationCovariance.status, EstimateStatus::Failed);
  EXPECT_EQ(report.gain.status, EstimateStatus::Identified);
}

TEST(SensorNoiseStatuses, AGainThatMayBeZeroIsNotIdentified)
{
  Report report = Consistent();
  report.gain.interval95 = Interval{ -0.1, 1.1 };
  ExpectWithdrawn(report, EstimateStatus::NotIdentifiable);
}

TEST(SensorNoiseStatuses, PositiveQuantitiesExcludeZeroAndAreKnownToHalf)
{
  using Domain = QuantityDomain;
  EXPECT_EQ(Filed(WithError(1.0, 0.5, 1.9), Domain::Positive).status, EstimateStatus::Identified);
  EXPECT_EQ(Filed(WithError(1.0, 0.501, 1.9), Domain::Positive).status, EstimateStatus::NotIdentifiable);
  const Quantity unknown = Filed(WithError(1.0, 0.6), Domain::Positive);
  EXPECT_EQ(unknown.status, EstimateStatus::NotIdentifiable);
  EXPECT_FALSE(unknown.value);
  EXPECT_EQ(unknown.bracket->low, 0.0);
  const Quantity limit = Filed(WithError(1.0, 0.6), Domain::NonNegative);
  EXPECT_EQ(limit.status, EstimateStatus::UpperLimit);
  EXPECT_DOUBLE_EQ(*limit.bracket->high, 1.0 + 1.96 * 0.6);
  EXPECT_EQ(Filed(Quantity::Identified(2.0), Domain::Positive).status, EstimateStatus::Identified); // has no error
}

TEST(SensorNoiseStatuses, OffsetsLieInTheirLimitsAndAreNarrow)
{
  const auto offset = [](double value, double error, double signalDn) {
    Quantity quantity = WithError(value, error);
    quantity.bracket = Interval{ -10.0, 100.0 };
    return Filed(quantity, QuantityDomain::Offset, signalDn).status;
  };
  EXPECT_EQ(offset(0.0, 1.0, 20.0), EstimateStatus::Identified);
  EXPECT_EQ(offset(-3.0, 1.0, 20.0), EstimateStatus::Identified);
  EXPECT_EQ(offset(0.0, 1.0, 15.0), EstimateStatus::NotIdentifiable);
  EXPECT_EQ(offset(101.0, 1.0, 20.0), EstimateStatus::Identified); // its interval reaches them
  EXPECT_EQ(offset(500.0, 1.0, 1000.0), EstimateStatus::Failed);
}

TEST(SensorNoiseStatuses, EveryPositiveQuantityThatMayBeZeroIsWithdrawn)
{
  Report report;
  report.noiseCorrelation.emplace();
  for (const QuantityEntry & entry : QuantityList())
  {
    const_cast<Quantity &>(*entry.of(report)) = WithError(1.0, 2.0);
  }
  FileStatuses(report);
  for (const QuantityEntry & entry : QuantityList())
  {
    if (entry.domain == QuantityDomain::Positive || entry.domain == QuantityDomain::NonNegative)
    {
      EXPECT_NE(entry.of(report)->status, EstimateStatus::Identified) << entry.path;
      EXPECT_FALSE(entry.of(report)->value) << entry.path;
    }
  }
}

TEST(SensorNoiseStatuses, WarningsAgainstTheDarkLevelFailOffsetAndReadNoise)
{
  for (const WarningCode code : { WarningCode::DarkFramesDiffer,
                                  WarningCode::OffsetOutOfRange,
                                  WarningCode::OffsetAboveDarkest,
                                  WarningCode::OffsetLineMisfit })
  {
    Report report = Consistent();
    report.readNoiseMedian = WithError(3.0, 0.1);
    report.Warn(code, "");
    FileStatuses(report);
    EXPECT_EQ(report.gain.status, EstimateStatus::Identified);
    EXPECT_TRUE(std::isnan((*report.covariance)[2][2]));
    for (const Quantity & quantity : { report.offset, report.readNoise, report.readNoiseMedian })
    {
      EXPECT_EQ(quantity.status, EstimateStatus::Failed);
      EXPECT_FALSE(quantity.value);
    }
  }
}

TEST(SensorNoiseStatuses, WhatIsNotIdentifiedIsLeftAlone)
{
  Report report = Consistent();
  report.gain = Quantity::Without(EstimateStatus::NotIdentifiable);
  report.fit.reducedChi2 = 0.001;
  FileStatuses(report);
  EXPECT_EQ(report.offset.status, EstimateStatus::Identified);
  EXPECT_TRUE(report.warnings.empty());
}
