// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceCurve.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <optional>
#include <random>

using namespace sensornoise;

namespace
{
constexpr double Gain = 0.5;
constexpr double OffsetDn = 100.0;
constexpr double ReadVariance = 9.0;

/** Returns the curve of a variance at levels from 120 to 2,700 DN, about a line through its ends. The relative error of
 * a bin is 0.5 %. */
template <typename TFunction>
VarianceCurve
CurveOf(TFunction varianceAt, unsigned int seed)
{
  constexpr double           error = 0.005;
  std::mt19937               random(seed);
  std::normal_distribution<> normal;
  VarianceCurve              curve;
  const double               first = 120.0;
  const double               last = 2700.0;
  curve.line.gain = (varianceAt(last) - varianceAt(first)) / (last - first);
  curve.line.intercept = varianceAt(first) - curve.line.gain * first;
  curve.line.pivotDn = 1200.0;
  curve.line.isDetermined = true;
  for (std::size_t b = 0; b < VarianceCurve::Bins; ++b)
  {
    const double level = first + (last - first) * static_cast<double>(b) / (VarianceCurve::Bins - 1.0);
    const double sd = error * varianceAt(level);
    const double variance = varianceAt(level) + sd * normal(random);
    const double weight = 1.0 / (sd * sd);
    curve.bins.push_back({ 100.0,
                           weight,
                           weight * (level - curve.line.pivotDn),
                           weight * (variance - curve.line.intercept - curve.line.gain * level) });
  }
  return curve;
}

double
LineAt(double level)
{
  return Gain * (level - OffsetDn) + ReadVariance;
}

bool
HasCertainStep(const VarianceCurve & curve)
{
  const std::optional<VarianceStep> step = FindVarianceStep(curve);
  return step && step->isCertain;
}
} // namespace

TEST(SensorNoiseVarianceStep, FindsLevelSizeAndTheLineBelow)
{
  for (const double size : { 140.0, 60.0, -40.0 })
  {
    const VarianceCurve curve =
      CurveOf([size](double level) { return LineAt(level) + (level > 900.0 ? size : 0.0); }, 7);
    const std::optional<VarianceStep> step = FindVarianceStep(curve);
    ASSERT_TRUE(step && step->isCertain) << size;
    EXPECT_NEAR(step->levelDn, 900.0, 60.0); // bins are 41 DN apart
    EXPECT_NEAR(step->sizeDn2, size, 4.0 * step->errorDn2);
    EXPECT_NEAR(step->line.gain, Gain, 4.0 * std::sqrt(step->line.covariance(0, 0)));
    EXPECT_NEAR(step->line.intercept, LineAt(0.0), 4.0 * std::sqrt(step->line.covariance(1, 1)));
    EXPECT_LT(std::sqrt(step->line.covariance(0, 0)), 0.01 * Gain);
    EXPECT_NEAR(step->slopeBelow, 0.0, 0.01 * Gain);
    EXPECT_NEAR(step->slopeAbove, 0.0, 0.01 * Gain);
    const VarianceCurve rest = step->RestOf(curve);
    EXPECT_LT(rest.bins.size(), curve.bins.size());
    EXPECT_NEAR(rest.ReducedChi2(), 1.0, 0.9); // 5 standard deviations of sqrt(2 / 58)
  }
}

TEST(SensorNoiseVarianceStep, IsPossibleNextToTheEnd)
{
  // Six bins lie above it, one of them where pixels are of either amplifier. A curve describes the others nearly as
  // well.
  const VarianceCurve curve = CurveOf([](double level) { return LineAt(level) + (level > 2450.0 ? 50.0 : 0.0); }, 7);
  const std::optional<VarianceStep> step = FindVarianceStep(curve);
  ASSERT_TRUE(step);
  EXPECT_FALSE(step->isCertain);
  EXPECT_NEAR(step->line.gain, Gain, 4.0 * std::sqrt(step->line.covariance(0, 0)));

  // In one of hundreds of lines, by the significance of several tests.
  std::size_t found = 0;
  for (unsigned int seed = 1; seed <= 200; ++seed)
  {
    found += FindVarianceStep(CurveOf(LineAt, seed)) ? 1 : 0;
  }
  EXPECT_LE(found, 1U);
}

TEST(SensorNoiseVarianceStep, FindsNoneInALine)
{
  for (unsigned int seed = 1; seed <= 200; ++seed)
  {
    EXPECT_FALSE(HasCertainStep(CurveOf(LineAt, seed))) << seed;
  }
}

TEST(SensorNoiseVarianceStep, FindsNoneInNonlinearResponses)
{
  const auto nonlinear = [](double size) {
    return [size](double level) {
      const double x = (level - OffsetDn) / 2600.0;
      return LineAt(level) * (1.0 + size * x * (1.0 - x));
    };
  };
  const auto power = [](double exponent) {
    return [exponent](double level) { return ReadVariance + 1300.0 * std::pow((level - OffsetDn) / 2600.0, exponent); };
  };
  const auto knee = [](double level) { return LineAt(level) - 0.2 * std::max(0.0, level - 1500.0); };
  const auto shoulder = [](double level) { return LineAt(level) / (1.0 + std::exp((level - 2600.0) / 60.0)); };
  for (unsigned int seed = 1; seed <= 20; ++seed)
  {
    for (const double size : { -0.4, -0.1, 0.1, 0.4 })
    {
      EXPECT_FALSE(HasCertainStep(CurveOf(nonlinear(size), seed))) << size << ' ' << seed;
    }
    for (const double exponent : { 0.7, 1.3, 1.8 })
    {
      EXPECT_FALSE(HasCertainStep(CurveOf(power(exponent), seed))) << exponent << ' ' << seed;
    }
    EXPECT_FALSE(HasCertainStep(CurveOf(knee, seed))) << seed;
    EXPECT_FALSE(HasCertainStep(CurveOf(shoulder, seed))) << seed;
  }
}

TEST(SensorNoiseVarianceStep, FindsNoneThatIsSmallHoweverSure)
{
  const VarianceCurve curve = CurveOf([](double level) { return LineAt(level) + (level > 900.0 ? 8.0 : 0.0); }, 5);
  VarianceCurve       sure = curve;
  EXPECT_FALSE(HasCertainStep(curve));
  for (CurveBin & bin : sure.bins)
  {
    const double level = curve.LevelOf(bin);
    const double excess = LineAt(level) + (level > 900.0 ? 8.0 : 0.0) - curve.line.intercept - curve.line.gain * level;
    bin.weight *= 1e4;
    bin.x *= 1e4;
    bin.excess = bin.weight * excess;
  }
  EXPECT_FALSE(HasCertainStep(sure));
}
