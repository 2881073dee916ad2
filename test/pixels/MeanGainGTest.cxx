// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Bins = VarianceCurve::Bins;
constexpr double      Weight = 50.0;

/** Returns the curve of a variance [DN^2] at levels [DN], about the line through it with equal weights. */
VarianceCurve
CurveOf(const std::vector<double> & levels, const std::vector<double> & variance)
{
  const auto count = static_cast<double>(levels.size());
  double     meanLevel = 0.0;
  double     meanVariance = 0.0;
  for (std::size_t b = 0; b < levels.size(); ++b)
  {
    meanLevel += levels[b] / count;
    meanVariance += variance[b] / count;
  }
  double square = 0.0;
  double product = 0.0;
  for (std::size_t b = 0; b < levels.size(); ++b)
  {
    square += std::pow(levels[b] - meanLevel, 2);
    product += (levels[b] - meanLevel) * variance[b];
  }
  VarianceCurve curve;
  curve.line.gain = product / square;
  curve.line.intercept = meanVariance - curve.line.gain * meanLevel;
  curve.line.pivotDn = meanLevel;
  for (std::size_t b = 0; b < levels.size(); ++b)
  {
    const double excess = variance[b] - curve.line.intercept - curve.line.gain * levels[b];
    curve.bins.push_back({ 100.0, Weight, Weight * (levels[b] - meanLevel), Weight * excess });
  }
  return curve;
}

/** Levels, variances and mean local gain of a response y(x), in bins without noise. */
struct Response
{
  std::vector<double> levels;
  std::vector<double> variance;
  double              meanGain{ 0.0 };

  template <typename TLevel, typename TGain>
  Response(double first, double last, double readNoiseElectrons2, TLevel levelOf, TGain gainOf)
  {
    for (std::size_t b = 0; b < Bins; ++b)
    {
      const double x = first + (last - first) * static_cast<double>(b) / (Bins - 1.0);
      levels.push_back(levelOf(x));
      variance.push_back(gainOf(x) * gainOf(x) * (x + readNoiseElectrons2));
      meanGain += gainOf(x) / Bins;
    }
  }
  double
  Slope() const
  {
    return CurveOf(levels, variance).line.gain;
  }
  double
  Found(int degree, const std::optional<double> & offsetDn = std::nullopt) const
  {
    const auto found = FindMeanGain(CurveOf(levels, variance), degree, offsetDn);
    EXPECT_TRUE(found);
    return found ? found->value : 0.0;
  }
};

/** Returns a response with the local gain 0.3 (1 + d (1 - 2 x / 10000)), d the nonlinearity, for 10,000 electrons and
 * a read noise of 2 electrons. */
Response
NonlinearResponse(double nonlinearity)
{
  const auto levelOf = [=](double x) { return 100.0 + 0.3 * x * (1.0 + nonlinearity * (1.0 - x / 1e4)); };
  return Response(0.0, 1e4, 4.0, levelOf, [=](double x) { return 0.3 * (1.0 + nonlinearity * (1.0 - 2.0 * x / 1e4)); });
}
} // namespace

TEST(SensorNoiseMeanGain, StraightLineGivesItsSlope)
{
  const Response straight(50.0, 1e4, 25.0, [](double x) { return 100.0 + 0.3 * x; }, [](double) { return 0.3; });
  for (const int degree : { 2, 3 })
  {
    EXPECT_NEAR(straight.Found(degree), 0.3, 1e-9) << degree;
  }
  // The result is the same about another line, as only the sum of line and excess matters.
  VarianceCurve curve = CurveOf(straight.levels, straight.variance);
  curve.line.gain -= 0.1;
  curve.line.intercept += 0.1 * curve.line.pivotDn;
  for (CurveBin & bin : curve.bins)
  {
    bin.excess += 0.1 * bin.x;
  }
  const auto found = FindMeanGain(curve, 2);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 0.3, 1e-9);
}

TEST(SensorNoiseMeanGain, PowerOfTheSignalIsExactWithTheOffset)
{
  // y = c x^p with shot noise alone: V is the power q = 2 - 1 / p of y. Over a quarter of y a cubic through it is exact
  // within 2 (1 / 16)^4 |q (q - 1) (q - 2) (q - 3)| / 24 or 1e-6. Its slope at the end, from which q follows, is exact
  // within 2e-4. Z is proportional to 1 / (2 - q).
  for (const double p : { 0.6, 0.77, 1.0, 1.3 })
  {
    const auto     levelOf = [=](double x) { return 64.0 + 2.0 * std::pow(x, p); };
    const auto     gainOf = [=](double x) { return 2.0 * p * std::pow(x, p - 1.0); };
    const Response response(800.0, 1000.0, 0.0, levelOf, gainOf);
    EXPECT_NEAR(response.Found(3, 64.0) / response.meanGain, 1.0, 3e-4) << p;
    // Without the offset a small signal is assumed at the darkest level, where V' is the gain. Here V' is (2 p - 1) / p
    // times the gain.
    if (p != 1.0)
    {
      EXPECT_GT(std::abs(response.Found(3) / response.meanGain - 1.0), 0.1) << p;
    }
  }
}

TEST(SensorNoiseMeanGain, NonlinearityIsRecoveredToSecondOrder)
{
  for (const double nonlinearity : { -0.04, -0.02, 0.02, 0.04 })
  {
    const Response response = NonlinearResponse(nonlinearity);
    // The slope of the line contains twice the change of the gain, so that its relative error is `bend`.
    EXPECT_GT(std::abs(response.Slope() / response.meanGain - 1.0), 0.5 * std::abs(nonlinearity)) << nonlinearity;
    EXPECT_NEAR(response.Found(2) / response.meanGain, 1.0, nonlinearity * nonlinearity) << nonlinearity;
    EXPECT_NEAR(response.Found(3) / response.meanGain, 1.0, nonlinearity * nonlinearity) << nonlinearity;
  }
}

TEST(SensorNoiseMeanGain, VarianceIsThatOfTheDifferenceFromTheLine)
{
  // The variance of 400 draws is known within sqrt(2 / 400) = 7 %; 5 standard errors are allowed.
  constexpr int              draws = 400;
  const Response             response = NonlinearResponse(0.04);
  std::mt19937               random(9);
  std::normal_distribution<> normal(0.0, 1.0 / std::sqrt(Weight));
  for (const int degree : { 2, 3 })
  {
    double sum = 0.0;
    double squares = 0.0;
    double reported = 0.0;
    for (int i = 0; i < draws; ++i)
    {
      std::vector<double> variance = response.variance;
      for (double & value : variance)
      {
        value += normal(random);
      }
      const VarianceCurve curve = CurveOf(response.levels, variance);
      const auto          found = FindMeanGain(curve, degree);
      ASSERT_TRUE(found);
      const double difference = found->value - curve.line.gain;
      sum += difference / draws;
      squares += difference * difference / draws;
      reported += found->variance / draws;
    }
    EXPECT_NEAR((squares - sum * sum) / reported, 1.0, 0.35) << degree;
  }
}

TEST(SensorNoiseMeanGain, IsNullWhereTheVarianceDeterminesNone)
{
  const Response straight(50.0, 1e4, 25.0, [](double x) { return 100.0 + 0.3 * x; }, [](double) { return 0.3; });
  // The variance decreases with the level.
  std::vector<double> falling(straight.variance.rbegin(), straight.variance.rend());
  EXPECT_FALSE(FindMeanGain(CurveOf(straight.levels, falling), 2));
  // The variance is below 0 at the darkest level.
  std::vector<double> negative = straight.variance;
  for (double & value : negative)
  {
    value -= straight.variance[20];
  }
  EXPECT_FALSE(FindMeanGain(CurveOf(straight.levels, negative), 2));
  // A parabola needs at least four bins, at different levels.
  VarianceCurve few = CurveOf(straight.levels, straight.variance);
  few.bins.resize(3);
  EXPECT_FALSE(FindMeanGain(few, 2));
  VarianceCurve level = CurveOf(straight.levels, straight.variance);
  for (CurveBin & bin : level.bins)
  {
    bin.x = 0.0;
  }
  EXPECT_FALSE(FindMeanGain(level, 2));
}
