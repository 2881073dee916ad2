// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/GainEstimate.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>

using namespace sensornoise;

namespace
{
constexpr double BlackDn = 100.0;
constexpr double QuantisationDn2 = 0.5;
constexpr double Gain = 0.4;
constexpr double InterceptDn2 = 30.0;

VarianceLine
Line(double gain, double interceptDn2, double pivotDn)
{
  VarianceLine line;
  line.gain = gain;
  line.intercept = interceptDn2;
  line.lowestDn2 = 5.0;
  line.covariance << 1e-6, -2e-4, -2e-4, 0.25;
  line.pivotDn = pivotDn;
  line.weightSum = 7.0;
  line.curvature = 1e-5;
  line.curvatureSd = 2e-5;
  line.noiseDispersionDn4 = 3.0;
  line.isDetermined = true;
  return line;
}

/** Returns levels from 110 to 2000 DN with different weights. The variance is \a varianceAt(level). */
template <typename TFunction>
SensorLines
LinesThrough(TFunction varianceAt)
{
  SensorLines lines;
  lines.all = Line(Gain, InterceptDn2, 900.0);
  lines.instrumentalLine = Line(1.1 * Gain, 0.9 * InterceptDn2, 800.0);
  lines.curve.line = lines.all;
  for (std::size_t b = 0; b < VarianceCurve::Bins; ++b)
  {
    const double level = 110.0 + 30.0 * static_cast<double>(b);
    CurveBin     bin;
    bin.pixels = 100.0;
    bin.weight = 100.0 / (50.0 + static_cast<double>(b));
    bin.x = bin.weight * (level - lines.all.pivotDn);
    bin.excess = bin.weight * (varianceAt(level) - lines.all.intercept - lines.all.gain * level);
    lines.curve.bins.push_back(bin);
  }
  return lines;
}

SensorLines
StraightLines()
{
  return LinesThrough([](double level) { return InterceptDn2 + Gain * level; });
}

/** Returns the variance of a bin: the line plus the excess. */
double
VarianceOf(const VarianceCurve & curve, std::size_t b)
{
  const CurveBin & bin = curve.bins[b];
  return curve.line.intercept + curve.line.gain * curve.LevelOf(bin) + bin.excess / bin.weight;
}

void
SetShape(NoiseCorrelation & correlation, CovarianceShape which, const MeasuredNumber & coefficient, double probability)
{
  WeightedShape & shape = correlation.Shape(which);
  shape = { coefficient, probability };
  shape.ofVariance = which == CovarianceShape::Variance ? 1.0 : 0.0;
  shape.ofSignal = which == CovarianceShape::Signal ? 1.0 : 0.0;
  shape.ofSquare = which == CovarianceShape::Square ? 1.0 : 0.0;
}

/** Returns a correlation of one shape. */
NoiseCorrelation
Sharing(CovarianceShape shape, double coefficient, double standardError = 0.0)
{
  NoiseCorrelation correlation;
  SetShape(correlation, shape, { coefficient, standardError }, 1.0);
  return correlation;
}
} // namespace

TEST(SensorNoiseSensorLines, WithoutSharingTheyAreThoseOfThePixels)
{
  const SensorLines lines = StraightLines();
  const SensorLines sensor = AddCovariances(lines, {}, BlackDn, QuantisationDn2);
  EXPECT_DOUBLE_EQ(sensor.all.gain, lines.all.gain);
  EXPECT_DOUBLE_EQ(sensor.all.intercept, lines.all.intercept);
  EXPECT_DOUBLE_EQ(sensor.instrumentalLine.gain, lines.instrumentalLine.gain);
  EXPECT_EQ(sensor.all.covariance, lines.all.covariance);
  EXPECT_EQ(sensor.covarianceOfCorrelation.norm(), 0.0);
  for (std::size_t b = 0; b < VarianceCurve::Bins; ++b)
  {
    EXPECT_NEAR(VarianceOf(sensor.curve, b), VarianceOf(lines.curve, b), 1e-9);
    EXPECT_DOUBLE_EQ(sensor.curve.bins[b].weight, lines.curve.bins[b].weight);
  }
  EXPECT_EQ(FilterFactor({}), 1.0);
}

TEST(SensorNoiseSensorLines, AFilterScalesTheVarianceWithoutTheQuantizationNoise)
{
  constexpr double  shared = 1.5;
  const SensorLines lines = StraightLines();
  const auto        correlation = Sharing(CovarianceShape::Variance, shared);
  const SensorLines sensor = AddCovariances(lines, correlation, BlackDn, QuantisationDn2);
  constexpr double  factor = 1.0 + shared;
  EXPECT_DOUBLE_EQ(FilterFactor(correlation), factor);
  EXPECT_NEAR(sensor.all.gain, factor * Gain, 1e-12);
  EXPECT_NEAR(sensor.all.intercept, factor * (InterceptDn2 - QuantisationDn2) + QuantisationDn2, 1e-12);
  EXPECT_NEAR(sensor.all.intercept, VarianceOfSensor(InterceptDn2, correlation, QuantisationDn2), 1e-12);
  EXPECT_LT((sensor.all.covariance - factor * factor * lines.all.covariance).norm(), 1e-12);
  EXPECT_NEAR(sensor.instrumentalLine.gain, factor * lines.instrumentalLine.gain, 1e-12);
  for (std::size_t b = 0; b < VarianceCurve::Bins; ++b)
  {
    const double variance = VarianceOf(lines.curve, b);
    EXPECT_NEAR(VarianceOf(sensor.curve, b), factor * (variance - QuantisationDn2) + QuantisationDn2, 1e-9);
    EXPECT_NEAR(sensor.curve.LevelOf(sensor.curve.bins[b]), lines.curve.LevelOf(lines.curve.bins[b]), 1e-9);
    EXPECT_NEAR(sensor.curve.bins[b].weight * factor * factor, lines.curve.bins[b].weight, 1e-12);
  }
}

TEST(SensorNoiseSensorLines, FramesThatAreMixedScaleItToo)
{
  auto correlation = Sharing(CovarianceShape::Variance, 0.5);
  correlation.timeShapes = Sharing(CovarianceShape::Variance, 2.0).shapes;
  EXPECT_DOUBLE_EQ(FilterFactor(correlation), 4.5);
  const SensorLines sensor = AddCovariances(StraightLines(), correlation, BlackDn, QuantisationDn2);
  EXPECT_NEAR(sensor.all.gain, 4.5 * Gain, 1e-12);
  EXPECT_NEAR(sensor.all.intercept, 4.5 * (InterceptDn2 - QuantisationDn2) + QuantisationDn2, 1e-12);
}

TEST(SensorNoiseSensorLines, CoupledChargeAddsASlopeAboutBlack)
{
  constexpr double  shared = 0.05;
  const SensorLines lines = StraightLines();
  const SensorLines sensor = AddCovariances(lines, Sharing(CovarianceShape::Signal, shared), BlackDn, QuantisationDn2);
  EXPECT_NEAR(sensor.all.gain, Gain + shared, 1e-12);
  EXPECT_NEAR(sensor.all.intercept + sensor.all.gain * BlackDn, InterceptDn2 + Gain * BlackDn, 1e-9); // same read noise
  EXPECT_LT((sensor.all.covariance - lines.all.covariance).norm(), 1e-15);
  for (std::size_t b = 0; b < VarianceCurve::Bins; ++b)
  {
    const double level = lines.curve.LevelOf(lines.curve.bins[b]);
    EXPECT_NEAR(VarianceOf(sensor.curve, b), VarianceOf(lines.curve, b) + shared * (level - BlackDn), 1e-9);
  }
}

TEST(SensorNoiseSensorLines, ChargeThatRepelsChargeLeavesALineBehind)
{
  // A sensor with V = 30 + 0.4 z whose bright pixels have lost 2e-5 z^2; any line may fit the remaining variance.
  constexpr double  shared = 2e-5;
  const SensorLines lines = LinesThrough([](double level) {
    const double z = level - BlackDn;
    return 30.0 + 0.4 * z - shared * z * z;
  });
  const SensorLines sensor = AddCovariances(lines, Sharing(CovarianceShape::Square, shared), BlackDn, QuantisationDn2);
  for (std::size_t b = 0; b < VarianceCurve::Bins; ++b)
  {
    const double z = lines.curve.LevelOf(lines.curve.bins[b]) - BlackDn;
    EXPECT_NEAR(VarianceOf(sensor.curve, b), 30.0 + 0.4 * z, 1e-9);
  }
  EXPECT_NEAR(sensor.all.curvature, lines.all.curvature + shared, 1e-15);
}

TEST(SensorNoiseSensorLines, TheLineThroughALossIsMadeTheSensorsOwn)
{
  // From the least-squares line of the remaining variance, with the weights of the curve, the line of the sensor
  // follows.
  constexpr double shared = 2e-5;
  const auto       left = [](double level) {
    const double z = level - BlackDn;
    return 30.0 + 0.4 * z - shared * z * z;
  };
  SensorLines     lines = LinesThrough(left);
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  Eigen::Vector2d product = Eigen::Vector2d::Zero();
  for (const CurveBin & bin : lines.curve.bins)
  {
    const Eigen::Vector2d row(lines.curve.LevelOf(bin), 1.0);
    square += bin.weight * row * row.transpose();
    product += bin.weight * left(row(0)) * row;
  }
  const Eigen::Vector2d fitted = square.inverse() * product;
  lines.all.gain = fitted(0);
  lines.all.intercept = fitted(1);
  const SensorLines sensor = AddCovariances(lines, Sharing(CovarianceShape::Square, shared), BlackDn, QuantisationDn2);
  EXPECT_NEAR(sensor.all.gain, 0.4, 1e-9);
  EXPECT_NEAR(sensor.all.intercept + sensor.all.gain * BlackDn, 30.0, 1e-6);
}

TEST(SensorNoiseSensorLines, WhatIsNotKnownOfTheSharingIsAnErrorOfGainAndIntercept)
{
  const SensorLines lines = StraightLines();
  const auto filtered = AddCovariances(lines, Sharing(CovarianceShape::Variance, 1.5, 0.02), BlackDn, QuantisationDn2)
                          .covarianceOfCorrelation;
  EXPECT_NEAR(std::sqrt(filtered(0, 0)), 0.02 * Gain, 1e-12);
  EXPECT_NEAR(std::sqrt(filtered(1, 1)), 0.02 * (InterceptDn2 - QuantisationDn2), 1e-12);
  EXPECT_NEAR(filtered(0, 1), 4e-4 * Gain * (InterceptDn2 - QuantisationDn2), 1e-12);
  const auto coupled = AddCovariances(lines, Sharing(CovarianceShape::Signal, 0.05, 0.002), BlackDn, QuantisationDn2)
                         .covarianceOfCorrelation;
  EXPECT_NEAR(std::sqrt(coupled(0, 0)), 0.002, 1e-12);
  EXPECT_NEAR(coupled(0, 1), -4e-6 * BlackDn, 1e-12);

  // Two shapes are equally probable: the gain may be either value.
  NoiseCorrelation both;
  SetShape(both, CovarianceShape::Variance, { 0.2, 0.0 }, 0.5);
  SetShape(both, CovarianceShape::Signal, { 0.06, 0.0 }, 0.5);
  const SensorLines sensor = AddCovariances(lines, both, BlackDn, QuantisationDn2);
  EXPECT_NEAR(sensor.all.gain, Gain + 0.5 * (0.2 * Gain + 0.06), 1e-12);
  EXPECT_NEAR(std::sqrt(sensor.covarianceOfCorrelation(0, 0)), 0.5 * (0.2 * Gain - 0.06), 1e-12);

  // Half of the dark noise is added after the filter, or all of it: the gain is the same, the intercepts differ.
  NoiseCorrelation part;
  SetShape(part, CovarianceShape::Variance, { 1.0, 0.0 }, 0.5);
  const double darkDn2 = InterceptDn2 + Gain * BlackDn - QuantisationDn2;
  part.Shape(CovarianceShape::FirstPart) = { { 1.0, 0.0 }, 0.5, 1.0, 0.0, 0.0, -0.5 * darkDn2 };
  const SensorLines between = AddCovariances(lines, part, BlackDn, QuantisationDn2);
  EXPECT_NEAR(between.all.gain, 2.0 * Gain, 1e-12);
  EXPECT_NEAR(between.all.At(BlackDn), 1.75 * darkDn2 + QuantisationDn2, 1e-9);
  const Eigen::Vector2d atBlack(BlackDn, 1.0);
  EXPECT_NEAR(std::sqrt(atBlack.dot(between.covarianceOfCorrelation * atBlack)), 0.25 * darkDn2, 1e-9);
  EXPECT_NEAR(VarianceOfSensor(darkDn2 + QuantisationDn2, part, QuantisationDn2), between.all.At(BlackDn), 1e-9);
  EXPECT_NEAR(StandardDeviationOfShapes(darkDn2 + QuantisationDn2, part, QuantisationDn2), 0.25 * darkDn2, 1e-9);

  NoiseCorrelation mixed;
  mixed.timeShapes = Sharing(CovarianceShape::Variance, 2.0, 0.06).shapes;
  EXPECT_NEAR(std::sqrt(AddCovariances(lines, mixed, BlackDn, QuantisationDn2).covarianceOfCorrelation(0, 0)),
              0.06 * Gain,
              1e-12);
  mixed.beyondTimeLags = 0.08; // fraction of the variance
  EXPECT_NEAR(
    std::sqrt(AddCovariances(lines, mixed, BlackDn, QuantisationDn2).covarianceOfCorrelation(0, 0)), 0.1 * Gain, 1e-12);
  NoiseCorrelation wide;
  wide.beyondReach = 0.01; // fraction of the variance, not of the total covariance
  EXPECT_NEAR(
    std::sqrt(AddCovariances(lines, wide, BlackDn, QuantisationDn2).covarianceOfCorrelation(0, 0)), 0.01 * Gain, 1e-12);
}

TEST(SensorNoiseSensorLines, NoiseOfWholeRowsIsNotThePixelsOwn)
{
  NoiseCorrelation correlation = Sharing(CovarianceShape::Variance, 1.5);
  correlation.rowsDn2 = { 4.0, 0.1 };
  correlation.columnsDn2 = { 0.3, 0.1 }; // not significant
  const SensorLines lines = StraightLines();
  const SensorLines sensor = AddCovariances(lines, correlation, BlackDn, QuantisationDn2);
  EXPECT_NEAR(sensor.all.gain, 2.5 * Gain, 1e-12);
  EXPECT_NEAR(sensor.all.intercept, 2.5 * (InterceptDn2 - QuantisationDn2 - 4.0) + QuantisationDn2, 1e-12);
  EXPECT_NEAR(VarianceOfSensor(InterceptDn2, correlation, QuantisationDn2), sensor.all.intercept, 1e-12);
  EXPECT_NEAR(
    VarianceOf(sensor.curve, 5), 2.5 * (VarianceOf(lines.curve, 5) - QuantisationDn2 - 4.0) + QuantisationDn2, 1e-9);
  EXPECT_NEAR(std::sqrt(sensor.covarianceOfCorrelation(1, 1)), 2.5 * 0.1, 1e-12);
}
