// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportText.h"
#include "sensornoise/Report.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <optional>
#include <string>

using namespace sensornoise;

namespace
{
/** Returns the line of the table that begins with these words. */
std::string
LineOf(const Report & report, const std::string & words)
{
  const std::string table = MakeTable(report);
  const std::size_t start = table.find("\n" + words);
  return start == std::string::npos ? "" : table.substr(start + 1, table.find('\n', start + 1) - start - 1);
}
} // namespace

TEST(SensorNoiseReportTable, ValuesHaveTheirErrorsAndIntervals)
{
  Report report;
  report.gain = Quantity::Identified(0.998765);
  report.gain.standardError = 0.00123;
  report.gain.interval95 = Interval{ 0.9963, 1.0012 };
  report.gain.bracket = Interval{ 0.0, std::nullopt };
  EXPECT_EQ(LineOf(report, "quantity"),
            "quantity                        value   error      unit     status            95 % interval or limits");
  EXPECT_EQ(LineOf(report, "gain g"),
            "gain g                         0.9988 \u00B1 0.0012     DN/e\u207B    identified        [0.9963, 1.0012]");
  EXPECT_EQ(LineOf(report, "offset mu"), "offset mu                           -              DN       failed");
}

TEST(SensorNoiseReportTable, EqualFramesAreReportedWhereThereAreAny)
{
  Report report;
  report.frames = report.framesDistinct = 100;
  report.width = report.height = 64;
  EXPECT_EQ(MakeTable(report).substr(0, 31), "100 frames of 64 x 64 pixels\n0 ");
  report.framesDistinct = 50;
  EXPECT_EQ(MakeTable(report).substr(0, 44), "100 frames (50 different) of 64 x 64 pixels\n");
}

TEST(SensorNoiseReportTable, WithoutAnyErrorThereIsNoColumnForThem)
{
  Report report;
  report.offset = Quantity::Identified(99.7);
  report.offset.bracket = Interval{ 35.8, std::nullopt };
  EXPECT_EQ(LineOf(report, "quantity"), "quantity                        value  unit     status            limits");
  EXPECT_EQ(LineOf(report, "offset mu"), "offset mu                        99.7  DN       identified        [35.8, -]");
}

TEST(SensorNoiseReportTable, WhatIsNotDistinguishableFromZeroHasItsLimitForAValue)
{
  Report report;
  report.readNoise = Quantity::Without(EstimateStatus::UpperLimit);
  report.readNoise.bracket = Interval{ 0.0, 1.25 };
  report.flickerSd = Quantity::Without(EstimateStatus::UpperLimit);
  EXPECT_EQ(LineOf(report, "read noise sigma  "),
            "read noise sigma               < 1.25  DN       upper-limit       [0, 1.25]");
  EXPECT_EQ(LineOf(report, "flicker sd"), "flicker sd                          -  1        upper-limit");
}

TEST(SensorNoiseReportTable, FitIsShownAsFarAsItIsKnown)
{
  Report report;
  EXPECT_EQ(LineOf(report, "fit:"), "");
  report.fit.reducedChi2 = 1.02;
  EXPECT_EQ(LineOf(report, "fit:"), "fit: reduced chi2 1.02 (1: only sampling noise is left)");
  report.fit.offsetLinePhi = 0.98;
  EXPECT_EQ(
    LineOf(report, "fit:"),
    "fit: reduced chi2 1.02 (1: only sampling noise is left), offset line 0.98 (1: all pixels have one flicker)");
}

TEST(SensorNoiseReportTable, NoiseIsNamedWhereItWasLookedAt)
{
  Report report;
  EXPECT_EQ(LineOf(report, "noise"), "");
  NoiseCorrelationRecord & noise = report.noiseCorrelation.emplace();
  noise.kind = "white";
  noise.space = { { 1, 0, 0, 0.0004, 0.0005 } };
  EXPECT_EQ(LineOf(report, "noise"), "noise: white (no correlation between neighbours or frames)");
  noise.kind = "not-linear";
  EXPECT_EQ(LineOf(report, "noise"),
            "noise: not-linear (not as a sensor or a linear filter leaves it: the gain is not identifiable)");
}

TEST(SensorNoiseReportTable, CorrelationIsShownForTheLagOfTheLargestCoefficient)
{
  Report                   report;
  NoiseCorrelationRecord & noise = report.noiseCorrelation.emplace();
  noise.kind = "filtered";
  noise.space = { { 1, 0, 0, 0.1, 0.001 }, { 0, 1, 0, -0.442, 0.001 }, { 1, 1, 0, 0.2, 0.001 } };
  noise.time = { { 0, 0, 1, 0.251, 0.001 } };
  EXPECT_EQ(LineOf(report, "noise"), "noise: filtered, correlation of neighbours up to -44 %");
  report.gain = Quantity::Identified(1.0);
  EXPECT_EQ(LineOf(report, "noise"),
            "noise: filtered, correlation of neighbours up to -44 %; the gain is from the covariance over all lags");
  noise.kind = "temporal";
  EXPECT_EQ(LineOf(report, "noise"),
            "noise: temporal, correlation of frames up to 25 %; the gain is from the covariance over all lags");
}

TEST(SensorNoiseReportTable, RowsAndColumnsHaveALineWhereTheirNoiseIsMeasured)
{
  Report                   report;
  NoiseCorrelationRecord & noise = report.noiseCorrelation.emplace();
  noise.kind = "white";
  noise.rowNoise = Quantity::Without(EstimateStatus::UpperLimit);
  noise.rowNoise.bracket = Interval{ 0.0, 0.3 };
  noise.columnNoise = Quantity::Identified(2.5);
  EXPECT_EQ(LineOf(report, "row noise"), "");
  EXPECT_EQ(LineOf(report, "column noise"), "column noise                      2.5  DN       identified");
  EXPECT_EQ(LineOf(report, "noise"), "noise: white, except for row and column noise");
}

TEST(SensorNoiseReportTable, VarianceSlopeHasALineWhereItIsNotTheGain)
{
  Report report;
  report.gain = report.varianceSlope = Quantity::Identified(1.000001);
  EXPECT_EQ(LineOf(report, "variance slope"), "");
  report.varianceSlope.value = 0.245;
  EXPECT_EQ(LineOf(report, "variance slope"), "variance slope                  0.245  DN/e\u207B    identified");
  report.gain = Quantity::Without(EstimateStatus::Failed);
  EXPECT_EQ(LineOf(report, "variance slope"), "variance slope                  0.245  DN/e\u207B    identified");
}

TEST(SensorNoiseReportTable, AReportWithoutPixelsHasNoFractionOfThem)
{
  const std::string text = MakeTable(Report());
  EXPECT_NE(text.find("0 of 0 pixels used (0.0 %)"), std::string::npos) << text;
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}
