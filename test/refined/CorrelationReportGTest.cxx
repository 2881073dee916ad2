// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"
#include "refined/RefinedEstimate.h"
#include "report/Quantities.h"
#include "helpers/ReportTestHelper.h"
#include "helpers/SentencesTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <string>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
/** Returns a correlation of 1 % with the nearest neighbour along a row, \a below along a column, and 20 % with the next
 * frame. */
NoiseCorrelation
CorrelationOf(NoiseKind kind, double below = 0.05)
{
  NoiseCorrelation correlation;
  correlation.kind = kind;
  correlation.space = { { { 1, 0, 0 }, { 0.01, 0.002 } },
                        { { 0, 1, 0 }, { below, 0.003 } },
                        { { -1, 1, 0 }, { 0.004, 0.001 } } };
  correlation.time = { { { 0, 0, 1 }, { 0.2, 0.01 } }, { { 0, 0, 2 }, { 0.04, 0.01 } } };
  correlation.kurtosis[0] = { -0.125, 0.01 };
  correlation.kurtosis[3] = { 0.5, 0.01 };
  return correlation;
}

/** Returns the only warning of a noise class, as "code: message". The gain is twice the slope of the variance. */
std::string
WarningOf(const NoiseCorrelation & correlation, bool hasGain = true)
{
  Report report;
  report.varianceSlope = WithError(0.25, 0.01);
  if (hasGain)
  {
    report.gain = WithError(0.5, 0.01);
  }
  WarnOfCorrelation(report, correlation);
  if (report.warnings.empty())
  {
    return "";
  }
  EXPECT_EQ(report.warnings.size(), 1U);
  EXPECT_LE(WordsOfLongestSentence(report.warnings[0].message), MostWords) << report.warnings[0].message;
  EXPECT_TRUE(HasAction(report.warnings[0])) << report.warnings[0].message;
  return std::string(KindOf(report.warnings[0].code).name) + ": " + report.warnings[0].message;
}

bool
Has(const std::string & text, const std::string & part)
{
  return text.find(part) != std::string::npos;
}
} // namespace

TEST(SensorNoiseCorrelationReport, WhiteNoiseIsNotWarnedOf)
{
  EXPECT_EQ(WarningOf(CorrelationOf(NoiseKind::White)), "");
  EXPECT_EQ(WarningOf(CorrelationOf(NoiseKind::NotMeasured)), "");
}

TEST(SensorNoiseCorrelationReport, FilteredFramesAreNamedWithTheLargestCoefficientAndTheConsequence)
{
  for (const double below : { 0.05, -0.05 }) // sharpening makes it negative
  {
    const std::string warning = WarningOf(CorrelationOf(NoiseKind::Filtered, below));
    EXPECT_EQ(warning.rfind("noise-correlated: the camera smooths, resamples or sharpens its frames", 0), 0U)
      << warning;
    EXPECT_TRUE(Has(warning, "the noise correlation of pixels 1 row apart is " + std::string(below < 0.0 ? "-5" : "5")))
      << warning;
    EXPECT_TRUE(Has(warning, "+- 0.30 %")) << warning;
    EXPECT_TRUE(Has(warning, "The slope of the variance (variance_slope) is 50 % of the gain")) << warning;
    EXPECT_TRUE(Has(warning, "Set the camera to raw frames")) << warning;
  }
}

TEST(SensorNoiseCorrelationReport, EachKindIsSaidInItsWords)
{
  const std::string crosstalk = WarningOf(CorrelationOf(NoiseKind::Crosstalk));
  EXPECT_EQ(crosstalk.rfind("noise-correlated: neighbours are coupled, or slightly filtered", 0), 0U) << crosstalk;
  EXPECT_TRUE(Has(crosstalk, "apart is 5.00 +- 0.30 %")) << crosstalk;

  const std::string fatter = WarningOf(CorrelationOf(NoiseKind::BrighterFatter));
  EXPECT_EQ(fatter.rfind("noise-correlated: charge repels charge", 0), 0U) << fatter;
  EXPECT_TRUE(Has(fatter, "brighter-fatter")) << fatter;
  EXPECT_TRUE(Has(fatter, "square of the signal")) << fatter;
  EXPECT_TRUE(Has(fatter, "Use `gain` for electrons")) << fatter;

  const std::string temporal = WarningOf(CorrelationOf(NoiseKind::Temporal));
  EXPECT_EQ(temporal.rfind("noise-correlated: the camera mixes its frames", 0), 0U) << temporal;
  EXPECT_TRUE(Has(temporal, "the noise correlation of frames 1 apart is 20.0 +- 1.0 %")) << temporal;

  const std::string notLinear = WarningOf(CorrelationOf(NoiseKind::NotLinear));
  EXPECT_EQ(notLinear.rfind("noise-not-linear: ", 0), 0U) << notLinear;
  EXPECT_TRUE(
    Has(notLinear, "excess kurtosis -0.125 +- 0.010, of differences in 2 x 2 pixels 0.500 +- 0.010, expected 0"))
    << notLinear;
  EXPECT_TRUE(Has(notLinear, "Set the camera to raw frames")) << notLinear;
}

// The message contains the number that decided.
TEST(SensorNoiseCorrelationReport, NeighboursThatDecidedAreNamed)
{
  NoiseCorrelation correlation = CorrelationOf(NoiseKind::NotLinear);
  correlation.kurtosis[0] = { -0.0069, 0.0040 };
  correlation.kurtosis[3] = { 0.001, 0.01 };
  correlation.kurtosis[4] = { 0.09, 0.01 };
  const std::string warning = WarningOf(correlation);
  EXPECT_EQ(warning.rfind("noise-not-linear: differences of neighbours are not normally distributed", 0), 0U)
    << warning;
  EXPECT_TRUE(Has(warning, "excess kurtosis -0.0069 +- 0.0040, of differences in 8 x 1 pixels 0.090 +- 0.010"))
    << warning;
}

TEST(SensorNoiseCorrelationReport, NoiseOfAFilterBeforeTheReadOutIsSaidToBeSo)
{
  NoiseCorrelation correlation = CorrelationOf(NoiseKind::Filtered);
  EXPECT_FALSE(Has(WarningOf(correlation), "before the read-out"));
  correlation.shapes.back().probability = 0.6;
  EXPECT_TRUE(Has(WarningOf(correlation), "spread before the read-out")) << WarningOf(correlation);
  EXPECT_TRUE(Has(WarningOf(correlation), "the gain is per event where one event frees several electrons"));
}

TEST(SensorNoiseCorrelationReport, EnlargedFramesAreNamedWithThePeriodAndTheLimitsOfTheGain)
{
  NoiseCorrelation correlation = CorrelationOf(NoiseKind::Enlarged);
  correlation.enlargement = EnlargementTrace{ 2, false, false, 0.4, 0.23 };
  Report report;
  report.gain = Quantity::Without(EstimateStatus::NotIdentifiable, Interval{ 0.25, 3.25 });
  WarnOfCorrelation(report, correlation);
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_EQ(report.warnings[0].code, WarningCode::FramesEnlarged);
  const std::string & text = report.warnings[0].message;
  EXPECT_EQ(text.rfind("the noise correlation of pixels 2 rows apart changes by 23 %", 0), 0U) << text;
  EXPECT_TRUE(Has(text, "every 2.5 pixels")) << text;
  EXPECT_TRUE(Has(text, "between 0.25 and 3.25 DN/e-")) << text;
}

TEST(SensorNoiseCorrelationReport, WithoutAGainNothingIsSaidOfIt)
{
  const std::string warning = WarningOf(CorrelationOf(NoiseKind::Filtered), false);
  EXPECT_FALSE(Has(warning, "of the gain")) << warning;
  EXPECT_TRUE(Has(warning, "apart is 5.00 +- 0.30 %")) << warning;
}

TEST(SensorNoiseCorrelationReport, RecordHoldsKindAndCoefficients)
{
  const NoiseCorrelationRecord record = RecordOf(CorrelationOf(NoiseKind::BrighterFatter));
  EXPECT_EQ(record.kind, "brighter-fatter");
  ASSERT_EQ(record.space.size(), 3U);
  EXPECT_EQ(record.space[2].x, -1);
  EXPECT_EQ(record.space[2].y, 1);
  EXPECT_EQ(record.space[2].value, 0.004);
  EXPECT_EQ(record.space[2].standardError, 0.001);
  ASSERT_EQ(record.time.size(), 2U);
  EXPECT_EQ(record.time[1].frames, 2);
  EXPECT_EQ(ValueOf(record.excessKurtosis), -0.125);
  EXPECT_EQ(*record.excessKurtosis.standardError, 0.01);
}

TEST(SensorNoiseCorrelationReport, NoiseOfRowsIsTheRootWithItsIntervalOrAnUpperLimit)
{
  NoiseCorrelation correlation = CorrelationOf(NoiseKind::White);
  correlation.rowsDn2 = { 9.0, 0.6 };
  correlation.columnsDn2 = { 1.2, 0.6 }; // two standard errors
  const NoiseCorrelationRecord record = RecordOf(correlation);
  EXPECT_EQ(record.rowNoise.status, EstimateStatus::Identified);
  EXPECT_EQ(ValueOf(record.rowNoise), 3.0);
  // The relative error of the root is half the relative error of the square.
  EXPECT_NEAR(*record.rowNoise.standardError, 0.6 / (2.0 * 3.0), 1e-12);
  EXPECT_EQ(record.columnNoise.status, EstimateStatus::UpperLimit);
  EXPECT_FALSE(record.columnNoise.value);
  ASSERT_TRUE(record.columnNoise.interval95);
  EXPECT_EQ(record.columnNoise.interval95->low, 0.0);
  EXPECT_NEAR(record.columnNoise.interval95->high.value(), std::sqrt(1.2 + 2.0 * 0.6), 1e-12);

  // By chance the square may be below 0; this does not lower the limit.
  correlation.columnsDn2 = { -3.0, 0.6 };
  const Quantity limit = RecordOf(correlation).columnNoise;
  EXPECT_EQ(limit.status, EstimateStatus::UpperLimit);
  EXPECT_NEAR(limit.interval95->high.value(), std::sqrt(2.0 * 0.6), 1e-12);
}

TEST(SensorNoiseCorrelationReport, EveryKindHasANameOfItsOwn)
{
  EXPECT_STREQ(NameOf(NoiseKind::White), "white");
  EXPECT_STREQ(NameOf(NoiseKind::Crosstalk), "crosstalk");
  EXPECT_STREQ(NameOf(NoiseKind::Filtered), "filtered");
  EXPECT_STREQ(NameOf(NoiseKind::Temporal), "temporal");
  EXPECT_STREQ(NameOf(NoiseKind::BrighterFatter), "brighter-fatter");
  EXPECT_STREQ(NameOf(NoiseKind::NotLinear), "not-linear");
}

// The distribution of the noise is that after a linear filter, and not the reason of the class.
TEST(SensorNoiseCorrelationReport, NormalNoiseThatIsNotLinearIsInterferenceOrRounding)
{
  NoiseCorrelation correlation = CorrelationOf(NoiseKind::NotLinear);
  correlation.kurtosis.fill({ 0.001, 0.002 });
  const std::string warning = WarningOf(correlation, false);
  EXPECT_TRUE(Has(warning, "noise-not-linear: the noise correlation of pixels 1 row apart is 5.00 +- 0.30 %"))
    << warning;
  EXPECT_TRUE(Has(warning, "periodic interference")) << warning;
  EXPECT_FALSE(Has(warning, "takes medians")) << warning;
}

TEST(SensorNoiseCorrelationReport, FramesThatAreMixedWhereTheyDifferLittleAreNamed)
{
  NoiseCorrelation correlation = CorrelationOf(NoiseKind::NotLinear);
  correlation.kurtosisOfSteps = { 1.25, 0.03 };
  const std::string warning = WarningOf(correlation, false);
  EXPECT_TRUE(Has(warning, "have an excess kurtosis of 1.250 +- 0.030 (expected at most 0.1)")) << warning;
  EXPECT_TRUE(Has(warning, "Switch noise reduction in time off")) << warning;
}

TEST(SensorNoiseCorrelationReport, AWaveThatIsNotSignificantIsNotInTheRecord)
{
  NoiseCorrelation correlation = CorrelationOf(NoiseKind::White);
  correlation.interference = { { { 0.1, 0.2 }, { 0.4, 0.4 } } };
  EXPECT_TRUE(RecordOf(correlation).interference.empty());
}

TEST(SensorNoiseCorrelationReport, InterferenceIsInTheRecord)
{
  NoiseCorrelation correlation = CorrelationOf(NoiseKind::White);
  correlation.interference = { { { 0.1, 0.2 }, { 4.0, 0.4 } } };
  const NoiseCorrelationRecord record = RecordOf(correlation);
  ASSERT_EQ(record.interference.size(), 1U);
  EXPECT_DOUBLE_EQ(record.interference.front().rmsDn, 2.0);
  EXPECT_DOUBLE_EQ(record.interference.front().rmsStandardErrorDn, 0.1);
}

TEST(SensorNoiseCorrelationReport, TheStrongestWaveIsNamed)
{
  NoiseCorrelation correlation = CorrelationOf(NoiseKind::White);
  correlation.interference = { { { 0.1, 0.2 }, { 4.0, 0.4 } }, { { 0.173, -0.091 }, { 9.0, 0.6 } } };
  Report report;
  report.noiseCorrelation = RecordOf(correlation);
  WarnOfCorrelation(report, correlation);
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_EQ(report.warnings.front().code, WarningCode::PeriodicInterference);
  const std::string & text = report.warnings.front().message;
  EXPECT_TRUE(Has(text,
                  "a wave of 3.00 +- 0.10 DN rms, with 0.173 cycles per column and -0.091 cycles per row, the "
                  "strongest of 2 such waves, has another phase in each frame"))
    << text;
}
