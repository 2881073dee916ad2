// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/FixedPatternEstimate.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceFit.h"
#include "pixels/VarianceLine.h"
#include "helpers/PatternTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::pattern;

// Between levels that differ in their signal the slope of the variance is the gain. Between pixels of different gain it
// is twice the gain, and between pixels of different offset it is 0. The line of all pixels has the mean of these
// slopes, weighted with their fractions of the variance of the levels.

namespace
{
/** Line of all pixels, and instrumental-variable fit. */
struct Lines
{
  VarianceLine all;
  VarianceLine instrumental;

  explicit Lines(const Maps & maps, const ParallelFor & parallelFor = SerialFor)
  {
    VarianceFit fit(maps.Data(), parallelFor, std::nullopt, TrimRule::Distance, BlackDn);
    fit.Iterate(8);
    fit.FillErrors();
    all = fit.GetLine();
    InstrumentalFit fitted = FitInstrumental(fit, maps.Data(), maps.frame);
    fitted.line.covariance *= WideningOfInstrumental(fitted, fit, maps.Data(), maps.frame);
    instrumental = fitted.line;
  }
  /** Returns the fraction of a component of the variance of the levels [1]. */
  double
  FractionOf(double varianceDn2) const
  {
    return varianceDn2 / (all.spreadDn2 / all.weightSum);
  }
};

/** Expects that the instrumental-variable fit is unbiased, and that the line of all pixels is biased by \a fraction. */
void
ExpectOnlyTheInstrumentalFitIsRight(const Lines & lines, double fraction, double gainDn = GainDn)
{
  ASSERT_TRUE(lines.all.isDetermined && lines.instrumental.isDetermined);
  const double error = std::sqrt(lines.instrumental.covariance(0, 0));
  EXPECT_LT(error, 0.01 * GainDn);
  EXPECT_NEAR(lines.instrumental.gain, gainDn, 5.0 * error);
  EXPECT_NEAR(lines.instrumental.intercept + lines.instrumental.gain * BlackDn,
              ReadVarianceDn2,
              5.0 * error * (lines.instrumental.pivotDn - BlackDn));
  // The bias is known within sqrt(2 / 256), for a pattern of columns, and the weights differ by 30 %.
  EXPECT_GT(std::abs(fraction), 0.02);
  EXPECT_NEAR(lines.all.gain / gainDn - 1.0, fraction, 5.0 * 0.09 * std::abs(fraction));
}

std::vector<double>
NormalNumbers(std::size_t count)
{
  std::mt19937               random(78);
  std::normal_distribution<> normal;
  std::vector<double>        numbers(count);
  for (double & number : numbers)
  {
    number = normal(random);
  }
  return numbers;
}

/** Mean of the squared signal of the ramp over the pixels [DN^2]. */
constexpr double SquaredSignalDn2 = 1e4 + 1e4 / 12.0;
} // namespace

TEST(SensorNoiseInstrumentalFit, WithoutPatternsItIsTheLineOfAllPixels)
{
  const Lines lines(Maps([](std::size_t, std::size_t y) { return Pixel{ Ramp(y) }; }));
  EXPECT_NEAR(lines.all.gain, GainDn, 1e-8);
  EXPECT_NEAR(lines.instrumental.gain, GainDn, 1e-8);
  EXPECT_NEAR(lines.instrumental.intercept, ReadVarianceDn2 - GainDn * BlackDn, 1e-6);
}

TEST(SensorNoiseInstrumentalFit, NoiseOfTheMeansAloneIsNoInstrument)
{
  const Lines lines(
    Maps([](std::size_t, std::size_t y) { return Pixel{ 100.0 + 0.003 * static_cast<double>(y) }; }, FewFrames));
  EXPECT_FALSE(lines.instrumental.isDetermined);
}

TEST(SensorNoiseInstrumentalFit, GainsThatDifferHaveNoPart)
{
  const std::vector<double> normal = NormalNumbers(Pixels);
  const Lines               lines(
    Maps([&](std::size_t x, std::size_t y) { return Pixel{ Ramp(y), 1.0 + 0.1 * normal[y * Size + x] }; }));
  // With gains of variance s^2 the shot noise is 1 + s^2 times the shot noise of the mean gain.
  ExpectOnlyTheInstrumentalFitIsRight(lines, lines.FractionOf(0.01 * SquaredSignalDn2), 1.01 * GainDn);
}

TEST(SensorNoiseInstrumentalFit, OffsetsThatDifferHaveNoPart)
{
  const std::vector<double> normal = NormalNumbers(Pixels);
  const Lines               lines(
    Maps([&](std::size_t x, std::size_t y) { return Pixel{ Ramp(y), 1.0, 1.0, 12.0 * normal[y * Size + x] }; }));
  ExpectOnlyTheInstrumentalFitIsRight(lines, -lines.FractionOf(144.0));
}

TEST(SensorNoiseInstrumentalFit, NoiseOfTheMeansHasNoPart)
{
  const Lines  lines(Maps([](std::size_t, std::size_t y) { return Pixel{ Ramp(y) }; }, FewFrames));
  const double noiseDn2 = (ReadVarianceDn2 + GainDn * 100.0) / static_cast<double>(FewFrames);
  ExpectOnlyTheInstrumentalFitIsRight(lines, -lines.FractionOf(noiseDn2));
}

TEST(SensorNoiseInstrumentalFit, ColumnsThatDifferHaveNoPart)
{
  const std::vector<double> normal = NormalNumbers(Size);
  double                    square = 0.0;
  double                    mean = 0.0;
  for (const double number : normal)
  {
    mean += number / Size;
    square += number * number / Size;
  }
  const double variance = square - mean * mean;
  const Lines  offsets(
    Maps([&](std::size_t x, std::size_t y) { return Pixel{ Ramp(y), 1.0, 1.0, 12.0 * (normal[x] - mean) }; }));
  ExpectOnlyTheInstrumentalFitIsRight(offsets, -offsets.FractionOf(144.0 * variance));
  const Lines gains(
    Maps([&](std::size_t x, std::size_t y) { return Pixel{ Ramp(y), 1.0 + 0.05 * (normal[x] - mean) }; }));
  ExpectOnlyTheInstrumentalFitIsRight(
    gains, gains.FractionOf(0.0025 * variance * SquaredSignalDn2), (1.0 + 0.0025 * variance) * GainDn);
}

TEST(SensorNoiseInstrumentalFit, ColumnsThatDifferDoNotBendTheCurve)
{
  // Two thirds of the frame are dark, where the levels differ by the offsets of the columns alone.
  const std::vector<double> normal = NormalNumbers(Size);
  const Maps                maps([&](std::size_t x, std::size_t y) {
    return Pixel{ y < 2 * Size / 3 ? 2.0 : 60.0 * (Ramp(y) - Ramp(2 * Size / 3)), 1.0, 1.0, 200.0 * normal[x] };
  });
  VarianceFit               fit(maps.Data(), SerialFor, std::nullopt, TrimRule::Distance, BlackDn);
  fit.Iterate(8);
  fit.FillErrors();
  const VarianceLine instrumental = FitInstrumental(fit, maps.Data(), maps.frame).line;
  ASSERT_TRUE(instrumental.isDetermined);
  const VarianceCurve curve = CurveByInstrument(instrumental, fit, maps.Data(), maps.frame);
  EXPECT_EQ(curve.bins.size(), VarianceCurve::Bins);
  // 3/4 of the difference of the neighbours' means is the offset of the own column. The diagonals hold none of it: what
  // is left is the mean offset of the 25 columns of a group.
  EXPECT_LT(curve.Nonlinearity(1.0), 0.6 * fit.CurveAbout(instrumental).Nonlinearity(1.0));
}

TEST(SensorNoiseInstrumentalFit, UnequalEfficienciesActLikeSignal)
{
  const std::vector<double> normal = NormalNumbers(Pixels);
  const Lines               lines(
    Maps([&](std::size_t x, std::size_t y) { return Pixel{ Ramp(y), 1.0, 1.0 + 0.1 * normal[y * Size + x] }; }));
  EXPECT_NEAR(lines.all.gain, GainDn, 1e-8);
  EXPECT_NEAR(lines.instrumental.gain, GainDn, 1e-8);
}

TEST(SensorNoiseInstrumentalFit, OneIntensityDeterminesNone)
{
  const std::vector<double> normal = NormalNumbers(Pixels);
  const Lines               lines(
    Maps([&](std::size_t x, std::size_t y) { return Pixel{ 100.0, 1.0, 1.0, 5.0 * normal[y * Size + x] }; }));
  // The levels of neighbours have only noise in common: there is no slope, or its error is as large as the slope.
  EXPECT_TRUE(!lines.instrumental.isDetermined ||
              std::abs(lines.instrumental.gain) < 5.0 * std::sqrt(lines.instrumental.covariance(0, 0)))
    << lines.instrumental.gain << ' ' << lines.instrumental.covariance(0, 0);
}

TEST(SensorNoiseInstrumentalFit, ThreadsChangeNoBit)
{
  const Maps  maps([](std::size_t, std::size_t y) { return Pixel{ Ramp(y) }; }, FewFrames);
  const Lines expected(maps);
  const Lines lines(maps, test::Threads(3));
  EXPECT_EQ(lines.instrumental.gain, expected.instrumental.gain);
  EXPECT_EQ(lines.instrumental.covariance, expected.instrumental.covariance);
}
