// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/PolynomialFit.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Frames = 50;

struct Scatter
{
  std::vector<double>       mean;
  std::vector<double>       variance;
  std::vector<std::uint8_t> mask;

  RegressionData
  Data() const
  {
    return { mean.data(), variance.data(), mask.data(), mean.size() };
  }
};

/** Points of variance = intercept + slope mean + curvature mean^2 at means from \a lowest to \a highest. */
Scatter
ExactScatter(std::size_t pixels, double lowest, double highest, double intercept, double slope, double curvature)
{
  Scatter scatter;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    const double mean = lowest + (highest - lowest) * static_cast<double>(p) / static_cast<double>(pixels - 1);
    scatter.mean.push_back(mean);
    scatter.variance.push_back(intercept + slope * mean + curvature * mean * mean);
    scatter.mask.push_back(1);
  }
  return scatter;
}

/** Replaces each variance V by a sample variance of normal frames: V chi-square(T-1) / (T-1). */
Scatter
WithSamplingNoise(Scatter scatter)
{
  std::mt19937_64                 random(31);
  std::chi_squared_distribution<> chiSquare(Frames - 1.0);
  for (double & variance : scatter.variance)
  {
    variance *= chiSquare(random) / (Frames - 1.0);
  }
  return scatter;
}

/** Returns the standard deviation of the mean of (v - V)^2 / Var(v): the kurtosis of chi-square(d) is 3 + 12/d. */
double
SdOfReducedChi2(std::size_t pixels)
{
  return std::sqrt((2.0 + 12.0 / (Frames - 1.0)) / static_cast<double>(pixels));
}
} // namespace

TEST(SensorNoisePolynomialFit, LineIsRecoveredExactly)
{
  const PolynomialFit fit = FitLine(ExactScatter(1000, 100.0, 4000.0, -50.0, 1.25, 0.0).Data());
  EXPECT_TRUE(fit.isDetermined);
  EXPECT_EQ(fit.pixels, 1000u);
  EXPECT_NEAR(fit.slope, 1.25, 1e-10);
  EXPECT_NEAR(fit.intercept, -50.0, 1e-10 * 4000.0);
  EXPECT_EQ(fit.curvature, 0.0);
}

TEST(SensorNoisePolynomialFit, ParabolaIsRecoveredExactly)
{
  const PolynomialFit fit = FitLineAndParabola(ExactScatter(1000, 100.0, 4000.0, -50.0, 1.25, 0.0025).Data()).parabola;
  EXPECT_TRUE(fit.isDetermined);
  EXPECT_NEAR(fit.curvature, 0.0025, 1e-10 * 0.0025);
  EXPECT_NEAR(fit.slope, 1.25, 1e-10 * 1.25);
  EXPECT_NEAR(fit.intercept, -50.0, 1e-10 * 45000.0); // relative to the largest variance
}

TEST(SensorNoisePolynomialFit, LineAndParabolaOfOneWalkAreThoseOfTwo)
{
  const auto scatter = ExactScatter(40000, 100.0, 4000.0, -50.0, 1.25, 0.0025);
  const auto both = FitLineAndParabola(scatter.Data());
  const auto line = FitLine(scatter.Data());
  const auto parabola = FitLineAndParabola(scatter.Data()).parabola;
  EXPECT_EQ(both.line.pixels, line.pixels);
  EXPECT_EQ(both.line.slope, line.slope);
  EXPECT_EQ(both.line.intercept, line.intercept);
  EXPECT_EQ(both.line.curvature, 0.0);
  EXPECT_EQ(both.parabola.slope, parabola.slope);
  EXPECT_EQ(both.parabola.intercept, parabola.intercept);
  EXPECT_EQ(both.parabola.curvature, parabola.curvature);
}

TEST(SensorNoisePolynomialFit, LargeOffsetsOfTheMeanKeepTheDigits)
{
  // Means from 1e7 to 1e7 + 100: the variances themselves are rounded to 1e7 * 1e-16 = 1e-9, the slope to that / 100.
  const PolynomialFit line = FitLine(ExactScatter(500, 1e7, 1e7 + 100.0, -1e7, 1.0, 0.0).Data());
  EXPECT_NEAR(line.slope, 1.0, 1e-10);
  EXPECT_NEAR(line.intercept, -1e7, 1e7 * 1e-10);
  Scatter curved = ExactScatter(500, 0.0, 100.0, 30.0, 2.0, 0.01);
  for (double & mean : curved.mean)
  {
    mean += 1e6;
  }
  const PolynomialFit parabola = FitLineAndParabola(curved.Data()).parabola;
  EXPECT_NEAR(parabola.curvature, 0.01, 1e-9 * 0.01); // sums of 500 means, each rounded to 1e-10 of 100
  EXPECT_NEAR(parabola.slope + 2.0 * parabola.curvature * 1e6, 2.0, 1e-6);
}

TEST(SensorNoisePolynomialFit, MaskedAndUnknownPixelsTakeNoPart)
{
  Scatter scatter = ExactScatter(100, 100.0, 4000.0, 10.0, 2.0, 0.0);
  scatter.variance[0] = std::numeric_limits<double>::quiet_NaN();
  scatter.variance[7] = std::numeric_limits<double>::infinity();
  scatter.mask[50] = 0;
  scatter.variance[50] = 1e9;
  scatter.mask[51] = 0;
  scatter.mean[51] = std::numeric_limits<double>::quiet_NaN();
  const PolynomialFit fit = FitLine(scatter.Data());
  EXPECT_EQ(fit.pixels, 96u);
  EXPECT_NEAR(fit.slope, 2.0, 1e-10);
  EXPECT_NEAR(fit.intercept, 10.0, 1e-8);
  const FitQuality quality = EvaluateLineFit(scatter.Data(), fit, Frames);
  EXPECT_NEAR(quality.reducedChi2, 0.0, 1e-12);
}

TEST(SensorNoisePolynomialFit, OneIntensityDoesNotDetermineALine)
{
  Scatter scatter = ExactScatter(100, 500.0, 500.0, 10.0, 2.0, 0.0);
  EXPECT_FALSE(FitLine(scatter.Data()).isDetermined);
  EXPECT_FALSE(FitLineAndParabola(scatter.Data()).parabola.isDetermined);
  scatter.mask.assign(100, 0);
  EXPECT_FALSE(FitLine(scatter.Data()).isDetermined);
  EXPECT_EQ(FitLine(scatter.Data()).pixels, 0u);
  EXPECT_EQ(EvaluateLineFit(scatter.Data(), FitLine(scatter.Data()), Frames).curvatureZ, 0.0);
}

TEST(SensorNoisePolynomialFit, TwoIntensitiesDetermineALineAndShowNoCurvature)
{
  Scatter scatter = ExactScatter(100, 0.0, 100.0, 10.0, 2.0, 0.0);
  for (std::size_t p = 0; p < 100; ++p)
  {
    scatter.mean[p] = p % 2 == 0 ? 500.0 : 900.0;
    scatter.variance[p] = 10.0 + 2.0 * scatter.mean[p];
  }
  scatter = WithSamplingNoise(scatter);
  const PolynomialFit line = FitLine(scatter.Data());
  EXPECT_TRUE(line.isDetermined);
  EXPECT_LT(std::abs(EvaluateLineFit(scatter.Data(), line, Frames).curvatureZ), 1.0);
}

TEST(SensorNoisePolynomialFit, SamplingNoiseAloneHasReducedChi2OfOneAndNoCurvature)
{
  const Scatter       scatter = WithSamplingNoise(ExactScatter(20000, 100.0, 4000.0, 64.0, 1.0, 0.0));
  const PolynomialFit line = FitLine(scatter.Data());
  const FitQuality    quality = EvaluateLineFit(scatter.Data(), line, Frames);
  EXPECT_NEAR(quality.reducedChi2, 1.0, 5.0 * SdOfReducedChi2(20000));
  EXPECT_LT(std::abs(quality.curvatureZ), 5.0);
  // Ordinary regression: sd(slope) = sqrt(2/(T-1)) V_rms / (sd(u) sqrt(N)) = 0.2 * 2400 / (1126 * 141).
  EXPECT_NEAR(line.slope, 1.0, 5.0 * 0.0031);
}

TEST(SensorNoisePolynomialFit, ExcessScatterRaisesReducedChi2)
{
  Scatter scatter = WithSamplingNoise(ExactScatter(20000, 100.0, 4000.0, 64.0, 1.0, 0.0));
  for (std::size_t p = 0; p < scatter.variance.size(); ++p)
  {
    scatter.variance[p] *= p % 2 == 0 ? 1.4 : 0.6;
  }
  // Var = 2/(T-1) (1 + 0.16) + 0.16, over 2/(T-1): 5.08; the fourth moment is about twice the moment of one chi-square.
  const FitQuality quality = EvaluateLineFit(scatter.Data(), FitLine(scatter.Data()), Frames);
  EXPECT_NEAR(quality.reducedChi2, 1.16 + 0.16 * (Frames - 1.0) / 2.0, 5.0 * 5.08 * 2.0 * SdOfReducedChi2(20000));
}

TEST(SensorNoisePolynomialFit, CurvatureIsFoundWithItsError)
{
  constexpr double curvature = 1e-4; // 10 % of the variance at the bright end
  const Scatter    scatter = WithSamplingNoise(ExactScatter(20000, 100.0, 4000.0, 64.0, 1.0, curvature));
  const FitQuality quality = EvaluateLineFit(scatter.Data(), FitLine(scatter.Data()), Frames);
  EXPECT_GT(quality.curvatureZ, 5.0);
  EXPECT_NEAR(quality.curvature, curvature, 5.0 * quality.curvature / quality.curvatureZ);
  const Scatter down = WithSamplingNoise(ExactScatter(20000, 100.0, 4000.0, 64.0, 1.0, -curvature));
  EXPECT_LT(EvaluateLineFit(down.Data(), FitLine(down.Data()), Frames).curvatureZ, -5.0);
}

TEST(SensorNoisePolynomialFit, CurvatureErrorIsThatOfManyRepetitions)
{
  // z of a straight line is standard normal: over 400 repetitions mean square 1 with sd sqrt(2 / 400).
  constexpr int                   repetitions = 400;
  const Scatter                   exact = ExactScatter(300, 500.0, 2000.0, 64.0, 1.0, 0.0);
  std::mt19937_64                 random(33);
  std::chi_squared_distribution<> chiSquare(Frames - 1.0);
  double                          squares = 0.0;
  for (int i = 0; i < repetitions; ++i)
  {
    Scatter scatter = exact;
    for (double & variance : scatter.variance)
    {
      variance *= chiSquare(random) / (Frames - 1.0);
    }
    const double z = EvaluateLineFit(scatter.Data(), FitLine(scatter.Data()), Frames).curvatureZ;
    squares += z * z / repetitions;
  }
  // The error is widened where reduced chi-square exceeds 1, by 3 % on average: 6 % off the mean square.
  EXPECT_NEAR(squares, 0.95, 4.0 * std::sqrt(2.0 / repetitions));
}
