// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/Figures.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <vector>

using namespace sensornoise;

namespace
{
Report
MakeReport()
{
  Report report;
  report.framesDistinct = 51;
  report.gain = report.varianceSlope = Quantity::Identified(2.0);
  report.totalIntercept = Quantity::Identified(10.0);
  report.offset = Quantity::Identified(-5.0); // where the line has no variance
  report.varianceSlope.standardError = 0.03;
  report.totalIntercept.standardError = 4.0;
  report.covariance = { { { 1.0, -0.5, 0.0 }, { -0.5, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } } };
  report.fit.line = Report::Baseline{ 0.0, 2.0, 10.0 };
  report.scatter = { { 100.0, 200.0 }, { 300.0, 700.0 }, { 214.2, 410.0 }, { 100, 400 } };
  return report;
}
} // namespace

TEST(SensorNoiseFigureData, ResidualsAreInUnitsOfTheBinsError)
{
  // A variance of normal noise over 51 frames has the relative error sqrt(2 / 50) = 0.2. A mean of 100 variances has
  // 0.02: 4.2 DN^2 for 210 DN^2.
  const FigureData data = MakeFigureData(MakeReport());
  ASSERT_EQ(data.residuals.size(), 2U);
  EXPECT_NEAR(data.residuals[0], 1.0, 1e-9);
  EXPECT_NEAR(data.residuals[1], 0.0, 1e-9);
  EXPECT_EQ(data.meanResiduals, (std::vector<double>{ 100.0, 200.0 }));
}

TEST(SensorNoiseFigureData, MeansByWhichPixelsAreSortedHaveNoiseToo)
{
  // in the dark 105 DN^2, half of the variance at 100 DN: the mean of a pixel in 51 frames has the error
  // sqrt(210 / 51), and the line rises by 2 DN^2 / DN
  Report report = MakeReport();
  report.offset = Quantity::Identified(47.5);
  const double ofLevel = 2.0 * std::sqrt(210.0 / 51.0) * 0.5;
  EXPECT_NEAR(MakeFigureData(report).residuals[0], 4.2 / std::hypot(4.2, ofLevel), 1e-9);
  // the offset is not known: the darkest level has none of the photons' noise
  report.offset = Quantity::Without(EstimateStatus::NotIdentifiable);
  EXPECT_NEAR(MakeFigureData(report).residuals[0], 4.2 / std::hypot(4.2, 2.0 * ofLevel), 1e-9);
}

// The variance of n details of one image has the relative error sqrt(2.3085 / n), however many frames there are: 0.1 of
// 230 or 231 details. A level set has no error of its level.
TEST(SensorNoiseFigureData, ResidualsOfLevelSetsAreInUnitsOfTheirDetails)
{
  Report report = MakeReport();
  report.singleImage.emplace();
  report.scatter = { { 100.0, 200.0 }, { 231.0, 410.0 }, { 231.0, 410.0 }, { 231, 400 } };
  for (const std::size_t frames : { std::size_t{ 1 }, std::size_t{ 5 }, std::size_t{ 51 } })
  {
    report.framesDistinct = frames;
    const FigureData data = MakeFigureData(report);
    ASSERT_EQ(data.residuals.size(), 2U) << frames;
    EXPECT_NEAR(data.residuals[0], 0.1 / std::sqrt(2.3085 / 231.0), 1e-9) << frames;
    EXPECT_NEAR(data.residuals[1], 0.0, 1e-9) << frames;
  }
}

TEST(SensorNoiseFigureData, TemporalCorrelationIsInTheErrorsOfResiduals)
{
  // frames one apart have the correlation 0.5: 1 + 2 * 0.25 = 1.5 times the variance of a variance
  Report report = MakeReport();
  report.noiseCorrelation.emplace();
  report.noiseCorrelation->time.push_back({ 0, 0, 1, 0.5, 0.0 });
  const FigureData data = MakeFigureData(report);
  ASSERT_EQ(data.residuals.size(), 2U);
  EXPECT_NEAR(data.residuals[0], 1.0 / std::sqrt(1.5), 1e-9);
  EXPECT_EQ(data.residualSpread, 1.0);
}

TEST(SensorNoiseFigureData, CorrelationIsTheDispersionOfResidualsBeyondChance)
{
  Report report = MakeReport();
  report.noiseCorrelation.emplace();
  report.noiseCorrelation->space = { { 1, 0, 0, 0.5, 0.1 }, { 0, 1, 0, 0.01, 0.02 } };
  const FigureData data = MakeFigureData(report);
  EXPECT_NEAR(data.residualSpread, std::sqrt(1.0 + 2.0 * (0.25 - 0.01)), 1e-12); // nothing of the second
  EXPECT_NEAR(data.residuals[0], 1.0, 1e-9);
}

TEST(SensorNoiseFigureData, TheBandIsOfSlopeAndInterceptTogether)
{
  const FigureData data = MakeFigureData(MakeReport());
  ASSERT_EQ(data.bandLow.size(), data.lineMean.size());
  EXPECT_FALSE(data.isIndicative);
  EXPECT_DOUBLE_EQ(data.lineMean.front(), 100.0);
  EXPECT_DOUBLE_EQ(data.lineVariance.back(), 410.0);
  // at 100 DN the errors are 3 and 4 DN^2, correlated by -0.5: 9 + 16 - 12
  EXPECT_NEAR(data.bandHigh.front() - data.lineVariance.front(), 1.959964 * std::sqrt(13.0), 1e-5);
  EXPECT_NEAR(data.lineVariance.front() - data.bandLow.front(), 1.959964 * std::sqrt(13.0), 1e-5);
}

TEST(SensorNoiseFigureData, WithoutAGainTheLineIsIndicativeAndHasNoBand)
{
  Report report = MakeReport();
  report.gain = report.varianceSlope = Quantity::Without(EstimateStatus::Failed);
  EXPECT_TRUE(MakeFigureData(report).isIndicative);
  EXPECT_DOUBLE_EQ(MakeFigureData(report).lineVariance.back(), 410.0);
  EXPECT_TRUE(MakeFigureData(report).bandLow.empty());
  report.fit.line.reset();
  EXPECT_TRUE(MakeFigureData(report).lineMean.empty());
  EXPECT_TRUE(MakeFigureData(report).residuals.empty());
}

TEST(SensorNoiseFigureData, TheLineIsTheIdentifiedOneWhateverTheFitWas)
{
  // none by the published method; with dark frames the identified line goes through their point, another one does not
  for (const auto & fit : { std::optional<Report::Baseline>(), std::optional(Report::Baseline{ 0.0, 1.5, 60.0 }) })
  {
    Report report = MakeReport();
    report.fit.line = fit;
    const FigureData data = MakeFigureData(report);
    ASSERT_EQ(data.residuals.size(), 2U);
    EXPECT_NEAR(data.residuals[1], 0.0, 1e-9);
    EXPECT_DOUBLE_EQ(data.lineVariance.back(), 410.0);
  }
}

TEST(SensorNoiseFigureData, WhatIsNotKnownIsLeftOut)
{
  Report report = MakeReport();
  report.scatter.correctedVariance[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(MakeFigureData(report).mean, std::vector<double>{ 200.0 });
  EXPECT_FALSE(MakeFigureData(Report()).HasCurve());
  report.framesDistinct = 0;
  EXPECT_TRUE(MakeFigureData(report).residuals.empty());
}
