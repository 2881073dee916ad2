// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/ChiSquare.h"
#include "single/Constants.h"
#include "single/LevelSums.h"
#include "single/NoiseLine.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

namespace
{
std::vector<LevelSet>
SetsOnLine(double slope, double intercept, double details)
{
  std::vector<LevelSet> sets;
  for (const double level : { 100.0, 400.0, 900.0, 1600.0, 2500.0 })
  {
    sets.push_back({ level, slope * level + intercept, details });
  }
  return sets;
}
} // namespace

TEST(SensorNoiseNoiseLine, ExactVariancesGiveTheirLine)
{
  const NoiseLine fit = FitNoiseLine(SetsOnLine(0.5, -20.0, 1000.0), {}, 1e-6, { 0.0, 1.0, 100.0 });
  ASSERT_TRUE(fit.isDetermined);
  EXPECT_NEAR(fit.line.slopeDn, 0.5, 1e-7);
  EXPECT_NEAR(fit.InterceptDn2(), -20.0, 1e-4);
  EXPECT_NEAR(fit.reducedChi2, 0.0, 1e-10);
}

TEST(SensorNoiseNoiseLine, ErrorsAreThoseOfWeightedLeastSquares)
{
  // The variance of n details has a relative variance of truncatedVariance / n: weights n / (truncatedVariance v^2).
  const std::vector<LevelSet> sets = SetsOnLine(0.5, -20.0, 1000.0);
  double                      w = 0.0;
  double                      wx = 0.0;
  double                      wxx = 0.0;
  for (const LevelSet & set : sets)
  {
    const double weight = set.details / (TruncatedVariance * set.varianceDn2 * set.varianceDn2);
    w += weight;
    wx += weight * set.levelDn;
    wxx += weight * set.levelDn * set.levelDn;
  }
  const double    determinant = w * wxx - wx * wx;
  const NoiseLine fit = FitNoiseLine(sets, {}, 1e-6, { 0.0, 1.0, 100.0 });
  EXPECT_NEAR(fit.slopeVariance, w / determinant, 1e-4 * w / determinant);
  EXPECT_NEAR(fit.InterceptVariance(), wxx / determinant, 1e-3 * wxx / determinant);
  EXPECT_NEAR(fit.InterceptCovariance(), -wx / determinant, 1e-3 * wx / determinant);
}

TEST(SensorNoiseNoiseLine, ClippedLevelSetsGiveTheLineBeforeClipping)
{
  const CentredLine     truth{ 0.0, 2.0, 100.0 };
  const ClipLevels      levels{ 0.0, 1000.0 };
  std::vector<LevelSet> sets;
  for (const double level : { 15.0, 20.0, 300.0, 600.0, 930.0, 940.0 })
  {
    const ClippedMoments moments = MomentsOfClipped(level, std::sqrt(truth.At(level)), levels);
    sets.push_back({ moments.meanDn, moments.varianceDn2, 5000.0 });
  }
  const NoiseLine fit = FitNoiseLine(sets, levels, 1e-6, { 0.0, 1.0, 200.0 });
  ASSERT_TRUE(fit.isDetermined);
  EXPECT_NEAR(fit.line.slopeDn, 2.0, 1e-6);
  EXPECT_NEAR(fit.InterceptDn2(), 100.0, 1e-4);
}

TEST(SensorNoiseNoiseLine, OneLevelDeterminesNoLine)
{
  const std::vector<LevelSet> sets{ { 100.0, 50.0, 1000.0 }, { 100.0, 51.0, 1000.0 }, { 100.0, 49.0, 1000.0 } };
  EXPECT_FALSE(FitNoiseLine(sets, {}, 1e-6, { 0.0, 1.0, 100.0 }).isDetermined);
}

TEST(SensorNoiseNoiseLine, ScatterBeyondChanceEntersTheErrors)
{
  std::vector<LevelSet> sets = SetsOnLine(0.5, -20.0, 1000.0);
  const NoiseLine       even = FitNoiseLine(sets, {}, 1e-6, { 0.0, 1.0, 100.0 });
  sets[1].varianceDn2 *= 1.5;
  sets[3].varianceDn2 *= 0.7;
  const NoiseLine uneven = FitNoiseLine(sets, {}, 1e-6, { 0.0, 1.0, 100.0 });
  EXPECT_GT(uneven.reducedChi2, 10.0);
  EXPECT_GT(uneven.slopeVariance, 5.0 * even.slopeVariance);
}

TEST(SensorNoiseVarianceOfTruncated, IsFoundFromTheTruncatedMeanSquare)
{
  // By the midpoint rule: mean of z^2 of a normal distribution of variance v, of the values below the limit.
  const double limit = 3.0;
  for (const double variance : { 0.25, 0.9, 1.0, 1.2, 2.0 })
  {
    constexpr int steps = 100000;
    double        weight = 0.0;
    double        squares = 0.0;
    for (int i = 0; i < steps; ++i)
    {
      const double z = limit * (i + 0.5) / steps;
      const double density = std::exp(-0.5 * z * z / variance);
      weight += density;
      squares += density * z * z;
    }
    EXPECT_NEAR(VarianceOfTruncated(squares / weight, limit), variance, 1e-6 * variance);
  }
  EXPECT_TRUE(std::isinf(VarianceOfTruncated(limit * limit / 2.9, limit))); // a uniform density has a third
}
