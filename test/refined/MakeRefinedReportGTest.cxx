// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"
#include "sensornoise/ReportText.h"
#include "helpers/RefinedResultsTestHelper.h"
#include "helpers/ReportTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>

// Report of constructed results, from which every number follows.

using namespace sensornoise;
using namespace sensornoise::test;

TEST(SensorNoiseMakeRefinedReport, NumbersAreThoseOfTheLineAndTheFlicker)
{
  const Report report = MakeRefinedReport(HandMadeResults().Get());
  EXPECT_TRUE(report.warnings.empty()) << MakeText(report);
  EXPECT_EQ(report.pixels.used, 1024u);
  EXPECT_EQ(report.frames, 20u);
  EXPECT_DOUBLE_EQ(ValueOf(report.gain), 1.0);
  EXPECT_DOUBLE_EQ(*report.gain.standardError, 0.01);
  EXPECT_DOUBLE_EQ(ValueOf(report.intercept), -36.0);
  EXPECT_DOUBLE_EQ(ValueOf(report.totalIntercept), -36.0); // no quantization
  EXPECT_DOUBLE_EQ(ValueOf(report.offset), 100.0);
  EXPECT_DOUBLE_EQ(*report.offset.standardError, 0.5);
  // -36 + 1 * 100 = 64.
  EXPECT_DOUBLE_EQ(ValueOf(report.readNoise), 8.0);
  EXPECT_DOUBLE_EQ(ValueOf(report.readNoiseElectrons), 8.0);
  // The error of the square: the error of the line 1,000 DN from its pivot, and the error of the offset.
  const double square = std::sqrt(25.0 + 1e-4 * 1000.0 * 1000.0 + 0.25);
  EXPECT_NEAR(*report.readNoise.standardError, square / 16.0, 1e-9);
  // In electrons the square is also divided by the square of the gain: 1000 + 2 * 64 for each unit of its error.
  const double electrons = std::sqrt(25.0 + 1e-4 * 1128.0 * 1128.0 + 0.25);
  EXPECT_NEAR(*report.readNoiseElectrons.standardError, electrons / 16.0, 1e-9);
  // 20 squares of 0.02 with 19 degrees of freedom, without the noise of 1e-8.
  EXPECT_NEAR(ValueOf(report.flickerSd), std::sqrt(20.0 / 19.0 * 4e-4 - 1e-8), 1e-9);
  EXPECT_EQ(report.vibrationSdX.status, EstimateStatus::NotIdentifiable); // no derivative is active
  ASSERT_TRUE(report.covariance);
  EXPECT_DOUBLE_EQ((*report.covariance)[0][0], 1e-4);
  EXPECT_DOUBLE_EQ((*report.covariance)[2][2], 0.25);
}

// The covariances that the error of a transform needs exist without an offset, too, and are the same.
TEST(SensorNoiseMakeRefinedReport, ErrorsOfTheLineNeedNoOffset)
{
  HandMadeResults results;
  const Report    known = MakeRefinedReport(results.Get());
  results.reestimated.line.flickerZ = 0.1;
  const Report report = MakeRefinedReport(results.Get());
  EXPECT_EQ(report.offset.status, EstimateStatus::NotIdentifiable);
  ASSERT_TRUE(known.covariance && report.covariance);
  for (const std::size_t i : { 0U, 1U })
  {
    EXPECT_EQ((*report.covariance)[i][0], (*known.covariance)[i][0]);
    EXPECT_EQ((*report.covariance)[i][1], (*known.covariance)[i][1]);
  }
  for (const std::size_t i : { 0U, 1U, 2U })
  {
    EXPECT_TRUE(std::isnan((*report.covariance)[i][2]));
    EXPECT_TRUE(std::isnan((*report.covariance)[2][i]));
  }
  EXPECT_NE(ToJson(report).find("null]"), std::string::npos);
}

TEST(SensorNoiseMakeRefinedReport, PixelsThatAreLeftOutAreSaidFromOneInAHundredOn)
{
  HandMadeResults results;
  results.variance.notStatic = 10; // of 1,024
  results.scene.nearClip = 10;
  results.variance.line.trimmedFraction = 0.002;
  EXPECT_TRUE(MakeRefinedReport(results.Get()).warnings.empty());
  results.variance.notStatic = results.scene.nearClip = 11;
  results.variance.line.trimmedFraction = 0.0021;
  const Report report = MakeRefinedReport(results.Get());
  EXPECT_TRUE(HasWarning(report, WarningCode::NotStatic));
  EXPECT_TRUE(HasWarning(report, WarningCode::NearClipLevel));
  EXPECT_TRUE(HasWarning(report, WarningCode::NoisyPixels));
  EXPECT_EQ(report.warnings.size(), 3u) << MakeText(report);
}

TEST(SensorNoiseMakeRefinedReport, LocalLightIsADriftOrSeveralSources)
{
  HandMadeResults results;
  results.MakeLocal();
  EXPECT_TRUE(HasWarning(MakeRefinedReport(results.Get()), WarningCode::LocalLight));
  EXPECT_DOUBLE_EQ(ValueOf(MakeRefinedReport(results.Get()).offset), 102.0);
  results.reestimated.isOffsetDrift = true;
  const Report drift = MakeRefinedReport(results.Get());
  EXPECT_TRUE(HasWarning(drift, WarningCode::OffsetDrift));
  EXPECT_FALSE(HasWarning(drift, WarningCode::LocalLight));
  EXPECT_DOUBLE_EQ(ValueOf(drift.offset), 100.0);
}

TEST(SensorNoiseMakeRefinedReport, VibrationIsStrongFromFourTenthsOfAPixelOn)
{
  HandMadeResults results;
  results.scene.model.vibrationYPixels2 = 0.159;
  EXPECT_FALSE(HasWarning(MakeRefinedReport(results.Get()), WarningCode::StrongVibration));
  results.scene.model.vibrationYPixels2 = 0.161;
  EXPECT_TRUE(HasWarning(MakeRefinedReport(results.Get()), WarningCode::StrongVibration));
}

TEST(SensorNoiseMakeRefinedReport, NoiseThatIsNotLinearLeavesTheLineOfTheFrames)
{
  HandMadeResults results;
  results.correlation.kind = NoiseKind::NotLinear;
  const Report report = MakeRefinedReport(results.Get());
  EXPECT_EQ(report.gain.status, EstimateStatus::Failed);
  EXPECT_TRUE(HasWarning(report, WarningCode::NoiseNotLinear));
  EXPECT_DOUBLE_EQ(ValueOf(report.varianceSlope), 1.0);
  EXPECT_DOUBLE_EQ(ValueOf(report.totalIntercept), -36.0);
}

TEST(SensorNoiseMakeRefinedReport, EnlargedFramesLeaveLimitsOfTheGainAndTheLineOfTheFrames)
{
  HandMadeResults results;
  results.correlation.kind = NoiseKind::Enlarged;
  results.correlation.enlargement = EnlargementTrace{ 1, true, false, 0.5, 0.15 };
  WeightedShape & shape = results.correlation.Shape(CovarianceShape::Variance);
  shape = { { 3.0, 0.0 }, 1.0, 1.0, 0.0, 0.0, 0.0 };
  const Report report = MakeRefinedReport(results.Get());
  EXPECT_EQ(report.gain.status, EstimateStatus::NotIdentifiable);
  ASSERT_TRUE(report.gain.bracket);
  // The value for white noise, and four times this value, each with two standard errors.
  EXPECT_NEAR(*report.gain.bracket->low, 1.0, 0.03);
  EXPECT_NEAR(*report.gain.bracket->high, 4.0, 0.1);
  EXPECT_EQ(report.readNoise.status, EstimateStatus::NotIdentifiable);
  EXPECT_EQ(report.intercept.status, EstimateStatus::NotIdentifiable);
  EXPECT_FALSE(report.covariance);
  EXPECT_DOUBLE_EQ(ValueOf(report.offset), 100.0);
  EXPECT_DOUBLE_EQ(ValueOf(report.varianceSlope), 1.0);
  EXPECT_TRUE(HasWarning(report, WarningCode::FramesEnlarged));
  EXPECT_FALSE(HasWarning(report, WarningCode::ReadNoiseUpperLimit));
}

TEST(SensorNoiseMakeRefinedReport, FailureKeepsTheResultsOfDarkFrames)
{
  HandMadeResults results;
  results.settings.offset = KnownOffset{ 97.0, 0.2, 20, DarkVariance{ 81.0, 0.3 } };
  const Report report = MakeFailedReport(
    results.settings, results.scene, results.scene.pixelUse, NothingToMeasure("nothing", WarningCode::CodesTooCoarse));
  EXPECT_TRUE(HasWarning(report, WarningCode::CodesTooCoarse));
  EXPECT_FALSE(report.IsUsable());
  EXPECT_DOUBLE_EQ(ValueOf(report.offset), 97.0);
  EXPECT_DOUBLE_EQ(ValueOf(report.readNoise), 9.0);
}
