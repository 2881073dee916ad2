// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/GainEstimate.h"
#include "base/Eigen.h"
#include "sensornoise/Settings.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"
#include "refined/RefinedResults.h"

#include <cmath>
#include <cstddef>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr double OffsetDn = 100.0;
constexpr double ReadVarianceDn2 = 64.0;
constexpr double PivotDn = 1600.0;
constexpr double PivotErrorDn2 = 2.0;

/** Returns a line through the variance at the pivot, 1564 DN^2 with an error of 2 DN^2. */
VarianceLine
LineOf(double gain, double gainError)
{
  VarianceLine line;
  line.gain = gain;
  line.pivotDn = PivotDn;
  line.intercept = ReadVarianceDn2 + PivotDn - OffsetDn - gain * PivotDn;
  line.lowestDn2 = 1.0;
  line.isDetermined = true;
  Eigen::Matrix2d toIntercept;
  toIntercept << 1.0, 0.0, -PivotDn, 1.0;
  Eigen::Matrix2d atPivot;
  atPivot << gainError * gainError, 0.0, 0.0, PivotErrorDn2 * PivotErrorDn2;
  line.covariance = toIntercept * atPivot * toIntercept.transpose();
  return line;
}

/** Results of the passes for a sensor with the gain 1 DN/e-, the offset 100 DN and the read noise 8 DN. */
struct Found
{
  RefinedSettings       settings;
  StaticScene           scene;
  SceneSeries           series;
  StaticVariance        variance;
  ReestimatedComponents reestimated;
  std::vector<double>   corrected;

  explicit Found(double gainError = 0.002)
  {
    variance.line = LineOf(1.0, gainError);
    scene.frame.frames = 40;
    scene.frame.usable = { 1 };
    scene.frame.neighbourMean = { PivotDn };
    this->SetCurve([](double) { return 0.0; });
  }
  /** Sets a curve at levels from 110 to 3,090 DN, with relative deviations \a deviationOf from the line. */
  void
  SetCurve(const std::function<double(double levelDn)> & deviationOf)
  {
    const VarianceLine & line = variance.line;
    variance.curve = { line, {} };
    for (std::size_t b = 0; b < VarianceCurve::Bins; ++b)
    {
      const double level = 110.0 + 2980.0 * static_cast<double>(b) / (VarianceCurve::Bins - 1.0);
      const double weight = 10.0;
      variance.curve.bins.push_back(
        { 100.0, weight, weight * (level - PivotDn), weight * deviationOf(level) * line.At(level) });
    }
  }
  GainEstimate
  Estimate(double blackDn = OffsetDn) const
  {
    return EstimateGain({ settings, scene, series, variance, reestimated, corrected, blackDn });
  }
};
} // namespace

TEST(SensorNoiseGainEstimate, StraightSensorKeepsItsLineAndItsErrors)
{
  const GainEstimate estimate = Found().Estimate();
  EXPECT_EQ(estimate.line.gain, 1.0);
  EXPECT_FALSE(estimate.IsNonlinear());
  EXPECT_EQ(estimate.nonlinearity, 0.0);
  EXPECT_EQ(estimate.RelativeModelError(), 0.0);
  EXPECT_NEAR(estimate.StandardError(), 0.002, 1e-12);
  EXPECT_NEAR(estimate.scale, 1564.0 / 1500.0, 1e-12); // variance over signal at the pivot
  EXPECT_FALSE(estimate.atOffset);
}

TEST(SensorNoiseGainEstimate, LineIsChosenByErrorsUnlessTheLinesContradict)
{
  for (const double instrumentalGain : { 0.986, 1.0, 1.014 }) // within three errors of 0.005
  {
    Found found;
    found.variance.instrumentalLine = LineOf(instrumentalGain, 0.005);
    EXPECT_EQ(found.Estimate().line.gain, 1.0) << instrumentalGain; // no pattern: 0.002 is smaller
    found.variance.pattern.gainFraction = 0.01;
    EXPECT_EQ(found.Estimate().line.gain, instrumentalGain); // 0.01 is larger than 0.005
    EXPECT_NEAR(found.Estimate().StandardError(), 0.005, 1e-12);
    found.variance.pattern.gainFraction = 0.004;
    const GainEstimate wider = found.Estimate();
    EXPECT_EQ(wider.line.gain, 1.0);
    EXPECT_NEAR(wider.StandardError(), std::hypot(0.002, 0.004), 1e-12); // with the bias that the pattern could cause
    // The error at the pivot is unchanged.
    const Eigen::Vector2d pivot(PivotDn, 1.0);
    EXPECT_NEAR(std::sqrt(pivot.dot(wider.covariance * pivot)), PivotErrorDn2, 1e-6);
  }
  for (const double instrumentalGain : { 0.984, 1.016 })
  {
    Found found;
    found.variance.instrumentalLine = LineOf(instrumentalGain, 0.005);
    EXPECT_EQ(found.Estimate().line.gain, instrumentalGain);
  }
}

TEST(SensorNoiseGainEstimate, NonlinearResponseHasTheMeanGain)
{
  // The variance is about 3 % larger in the middle of the levels, and 6 % smaller at the ends.
  Found found;
  found.SetCurve([](double level) { return 0.03 * (1.0 - 3.0 * std::pow((level - PivotDn) / 1490.0, 2)); });
  const GainEstimate estimate = found.Estimate();
  const auto         cubic = FindMeanGain(found.variance.curve, 3);
  ASSERT_TRUE(cubic);
  EXPECT_TRUE(estimate.IsNonlinear());
  EXPECT_EQ(estimate.line.gain, cubic->value);
  EXPECT_EQ(estimate.nonlinearity, found.variance.curve.Nonlinearity(1.0));
  // The interval contains half of the difference to the slope, and a third of the nonlinearity, on both sides.
  EXPECT_GE(estimate.below, 0.5 * std::abs(cubic->value - 1.0));
  EXPECT_GE(estimate.above, estimate.nonlinearity * cubic->value / 3.0 - 1e-12);
  EXPECT_NEAR(estimate.line.intercept + estimate.line.gain * PivotDn, 1564.0, 1e-9); // rotated about the pivot
}

TEST(SensorNoiseGainEstimate, CoupledChargeUnderStrongVibrationMayBeMotion)
{
  Found            found;
  NoiseCorrelation correlation;
  correlation.kind = NoiseKind::Crosstalk;
  WeightedShape & shape = correlation.Shape(CovarianceShape::Signal);
  shape = { { 0.1, 0.01 }, 1.0 };
  shape.ofSignal = 1.0;
  const auto estimate = [&] {
    const RefinedResults results{ found.settings,    found.scene,     found.series, found.variance,
                                  found.reestimated, found.corrected, OffsetDn,     correlation };
    return EstimateGain(results, AddCovariances(LinesOf(found.variance), correlation, OffsetDn, 0.0));
  };
  const GainEstimate still = estimate();
  EXPECT_NEAR(still.line.gain, 1.1, 1e-9);
  EXPECT_LT(still.below, 0.05);
  found.scene.model.vibrationXPixels2 = 0.5 * 0.5;
  EXPECT_NEAR(estimate().below, 0.1, 1e-9); // to the slope of the variance, 1.0
}

TEST(SensorNoiseGainEstimate, OneLevelAndADarkPointArePhotonTransfer)
{
  // The slope is not known, and the dark frames contradict the line.
  Found found(10.0);
  found.settings.offset = KnownOffset{ 90.0, 0.03, 20, DarkVariance{ 50.0, 0.4 } };
  const GainEstimate estimate = found.Estimate();
  const double       signal = PivotDn - 90.0;
  EXPECT_NEAR(estimate.line.gain, (1564.0 - 50.0) / signal, 1e-6);
  EXPECT_NEAR(estimate.line.intercept + estimate.line.gain * 90.0, 50.0, 1e-3);
  // Errors of the variance at the pivot, of the dark variance and of the offset.
  const double error = std::hypot(PivotErrorDn2, std::hypot(0.4, estimate.scale * 0.03)) / signal;
  EXPECT_NEAR(estimate.StandardError(), error, 1e-4 * error);
}

TEST(SensorNoiseGainEstimate, LevelsThatMayAllBePatternLeaveThePhotonTransfer)
{
  Found found;
  found.variance.pattern.gainFraction = found.variance.pattern.offsetFraction = std::numeric_limits<double>::infinity();
  found.settings.offset = KnownOffset{ 90.0, 0.03, 20, DarkVariance{ 50.0, 0.4 } };
  const GainEstimate estimate = found.Estimate();
  const double       signal = PivotDn - 90.0;
  EXPECT_NEAR(estimate.line.gain, (1564.0 - 50.0) / signal, 1e-6);
  const double error = std::hypot(PivotErrorDn2, std::hypot(0.4, estimate.scale * 0.03)) / signal;
  EXPECT_NEAR(estimate.StandardError(), error, 1e-4 * error);
}

TEST(SensorNoiseGainEstimate, KnownLineAndDarkPointAreWeighted)
{
  Found found(0.002);
  found.settings.offset = KnownOffset{ OffsetDn, 0.0, 20, DarkVariance{ ReadVarianceDn2 + 3.0, 1.0 } };
  const GainEstimate estimate = found.Estimate();
  // At the offset the line is 64 with the variance 2^2 + (0.002 x 1500)^2 = 13, and the dark frames give 67 with 1.
  ASSERT_TRUE(estimate.atOffset);
  EXPECT_NEAR(estimate.atOffset->valueDn2, ReadVarianceDn2, 1e-9);
  EXPECT_NEAR(estimate.atOffset->standardErrorDn2, std::sqrt(13.0), 1e-9);
  EXPECT_NEAR(estimate.line.intercept + estimate.line.gain * OffsetDn, ReadVarianceDn2 + 3.0 * 13.0 / 14.0, 1e-9);
  EXPECT_NEAR(estimate.line.gain, 1.0 - 3.0 / 14.0 * 4e-6 * 1500.0, 1e-12);
  EXPECT_LT(estimate.StandardError(), 0.002);
}

// Dark frames at three errors from the line may come from another camera setting, or differ by chance. With a
// gain of 1 DN/e-, a black level that is 11 DN higher explains a variance that is 11 DN^2 larger.
TEST(SensorNoiseGainEstimate, DarkFramesBesideTheLineWidenTheErrors)
{
  const double expected = 14.0; // variance of the difference [DN^4], as in the test above
  const double differenceDn2 = 3.0 * std::sqrt(expected);
  const double beyondChance = std::sqrt(9.0 - 4.0) / 3.0; // fraction of the difference
  Found        alone(0.002);
  Found        found(0.002);
  found.settings.offset = KnownOffset{ OffsetDn, 0.0, 20, DarkVariance{ ReadVarianceDn2 + differenceDn2, 1.0 } };
  const GainEstimate estimate = found.Estimate();
  const double       away = std::abs(estimate.line.gain - alone.Estimate().line.gain);
  EXPECT_GT(away, 2.0 * 0.002); // with the dark frames the gain is smaller
  EXPECT_FALSE(estimate.isDarkRejected);
  EXPECT_NEAR(estimate.darkDifferenceDn2, beyondChance * differenceDn2, 1e-9);
  EXPECT_GT(estimate.StandardError(), beyondChance * away);
  EXPECT_LT(estimate.StandardError(), std::hypot(beyondChance * away, 2.0 * 0.002));

  // Within chance, there is no difference.
  found.settings.offset->variance->valueDn2 = ReadVarianceDn2 + 1.99 * std::sqrt(expected);
  EXPECT_EQ(found.Estimate().darkDifferenceDn2, 0.0);
  EXPECT_LT(found.Estimate().StandardError(), 0.002);
}

TEST(SensorNoiseGainEstimate, UnknownLineHasNoDeviations)
{
  Found found(1.0);
  found.SetCurve([](double level) { return level > PivotDn ? 0.2 : -0.2; });
  const GainEstimate estimate = found.Estimate(-1e4); // as in a flat field, where the signals hardly differ
  EXPECT_FALSE(estimate.isWide);
  EXPECT_EQ(estimate.nonlinearity, 0.0);
  EXPECT_FALSE(estimate.IsNonlinear());
}

TEST(SensorNoiseGainEstimate, ItsSizeIsTheScaleOrWhatItsOwnErrorLeaves)
{
  GainEstimate estimate;
  estimate.scale = 0.002; // the level of a dark pivot without an offset, over its variance
  estimate.line.gain = 0.6;
  estimate.covariance(0, 0) = 0.01 * 0.01;
  EXPECT_DOUBLE_EQ(estimate.Size(), 0.58);
  estimate.covariance(0, 0) = 0.5 * 0.5;
  EXPECT_EQ(estimate.Size(), 0.002);
}

// The error of the correlation is the same in the lines of pixels and of frames: their mean has it, too.
TEST(SensorNoiseGainEstimate, ACommonErrorIsNotAveraged)
{
  Found         found;
  SensorLines   lines = LinesOf(found.variance);
  VarianceCurve frames = found.variance.curve;
  frames.line = LineOf(1.0, 0.002);
  lines.fromFrames = frames;
  lines.covarianceOfCorrelation(0, 0) = 0.01 * 0.01;
  const GainEstimate estimate = EstimateGain(
    { found.settings, found.scene, found.series, found.variance, found.reestimated, found.corrected, OffsetDn }, lines);
  EXPECT_NEAR(estimate.StandardError(), std::hypot(0.002 / std::sqrt(2.0), 0.01), 1e-9);
}
