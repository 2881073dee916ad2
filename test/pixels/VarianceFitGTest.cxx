// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceFit.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceLine.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Pixels = 20000; // more than two blocks
constexpr float       Dof = 30.0F;
constexpr double      Gain = 0.05; // many electrons per DN, so that the noise is nearly normal
constexpr double      Intercept = -2.0;

/** Maps with means from 100 to 1,100 DN, and with variances about a line. */
struct Maps
{
  std::vector<double>       mean;
  std::vector<float>        neighbourMean;
  std::vector<double>       variance;
  std::vector<float>        dof = std::vector<float>(Pixels, Dof);
  std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(Pixels, 1);

  explicit Maps(bool isNoisy)
  {
    std::mt19937                     random(41);
    std::uniform_real_distribution<> uniform(100.0, 1100.0);
    std::chi_squared_distribution<>  chiSquare(Dof);
    std::normal_distribution<>       normal;
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      mean.push_back(uniform(random));
      neighbourMean.push_back(static_cast<float>(mean.back() + (isNoisy ? 5.0 * normal(random) : 0.0)));
      variance.push_back((Intercept + Gain * mean.back()) * (isNoisy ? chiSquare(random) / Dof : 1.0));
    }
  }
  VarianceData
  Data() const
  {
    return { mean.data(), neighbourMean.data(), { variance.data() }, dof.data(), mask.data(), Pixels };
  }
  VarianceLine
  Fit(const ParallelFor & parallelFor = SerialFor) const
  {
    VarianceFit fit(this->Data(), parallelFor, std::nullopt);
    fit.Iterate(8);
    fit.FillErrors();
    return fit.GetLine();
  }
};
} // namespace

TEST(SensorNoiseVarianceFit, ExactLineIsRecovered)
{
  // Every variance is on the line, but is treated as the mean of a trimmed distribution.
  const double trimmed = ChiSquareTrim(Dof, Dof).Of(Dof).mean;
  const auto   line = Maps(false).Fit();
  ASSERT_TRUE(line.isDetermined);
  EXPECT_NEAR(line.gain * trimmed, Gain, 1e-9);
  EXPECT_NEAR(line.intercept * trimmed, Intercept, 1e-6);
  EXPECT_NEAR(line.At(500.0) * trimmed, Intercept + 500.0 * Gain, 1e-6);
  EXPECT_GE(line.At(-1e9), line.lowestDn2); // the line is cut at its lowest variance
  EXPECT_GT(line.lowestDn2, 0.0);
  EXPECT_EQ(line.trimmedFraction, 0.0);
}

TEST(SensorNoiseVarianceFit, NoisyLineIsRecoveredWithinItsErrors)
{
  const Maps maps(true);
  const auto line = maps.Fit();
  ASSERT_TRUE(line.isDetermined);
  EXPECT_NEAR(line.gain, Gain, 4.0 * std::sqrt(line.covariance(0, 0)));
  EXPECT_NEAR(line.intercept, Intercept, 4.0 * std::sqrt(line.covariance(1, 1)));
  EXPECT_NEAR(line.curvature, 0.0, 4.0 * line.curvatureSd);
  // Two tails of 1e-4 of 20,000 pixels: 4 pixels, Poisson distributed.
  EXPECT_LT(line.trimmedFraction, 20.0 / Pixels);
  // With the right weights the sandwich covariance is the inverse information, sum dof / (2 V^2) (x, 1)'(x, 1).
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (const double mean : maps.mean)
  {
    const Eigen::Vector2d row(mean, 1.0);
    information += 0.5 * Dof / std::pow(Intercept + Gain * mean, 2) * row * row.transpose();
  }
  const Eigen::Matrix2d fisher = information.inverse();
  EXPECT_NEAR(line.covariance(0, 0) / fisher(0, 0), 1.0, 0.1); // sd of a sum of 20,000 squares and wrong weights: 3 %
  EXPECT_NEAR(line.covariance(1, 1) / fisher(1, 1), 1.0, 0.1);
  EXPECT_NEAR(line.covariance(0, 1) / fisher(0, 1), 1.0, 0.1);
}

TEST(SensorNoiseVarianceFit, FollowsTheUnitsAndTheLevel)
{
  const Maps       maps(true);
  const auto       line = maps.Fit();
  constexpr double scale = 3.7; // scale of the samples
  constexpr double added = 2000.0;
  Maps             changed = maps;
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    changed.mean[p] = scale * maps.mean[p] + added;
    changed.neighbourMean[p] = static_cast<float>(scale * maps.neighbourMean[p] + added);
    changed.variance[p] = scale * scale * maps.variance[p];
  }
  const auto other = changed.Fit();
  EXPECT_NEAR(other.gain, scale * line.gain, 1e-9 * scale * line.gain);
  EXPECT_NEAR(other.intercept, scale * scale * line.intercept - other.gain * added, 1e-6);
  EXPECT_NEAR(other.covariance(0, 0), scale * scale * line.covariance(0, 0), 1e-7 * other.covariance(0, 0));
  EXPECT_NEAR(other.curvature, line.curvature, 1e-6 * line.curvatureSd);
  EXPECT_EQ(other.trimmedFraction, line.trimmedFraction);
}

TEST(SensorNoiseVarianceFit, CurvatureOfAParabolaIsFound)
{
  Maps             maps(false);
  constexpr double curvature = 2e-6;
  const auto       parabola = [&](double x) { return Intercept + Gain * x + curvature * x * x; };
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    maps.variance[p] = parabola(maps.mean[p]);
  }
  const double trimmed = ChiSquareTrim(Dof, Dof).Of(Dof).mean;
  const auto   line = maps.Fit();
  EXPECT_NEAR(line.curvature * trimmed, curvature, 1e-6 * curvature);
}

TEST(SensorNoiseVarianceFit, OutliersAndPixelsOutsideTheMaskHaveNoPart)
{
  const Maps maps(true);
  const auto expected = maps.Fit();
  Maps       spoiled = maps;
  for (std::size_t p = 0; p < Pixels; p += 100)
  {
    spoiled.variance[p] *= p % 200 == 0 ? 1e4 : 1e-4;
  }
  const auto line = spoiled.Fit();
  EXPECT_NEAR(line.gain, expected.gain, 0.5 * std::sqrt(expected.covariance(0, 0)));
  EXPECT_NEAR(line.trimmedFraction, 0.01, 1e-3);
  Maps masked = maps;
  for (std::size_t p = 0; p < Pixels; p += 3)
  {
    masked.mask[p] = 0;
  }
  const auto part = masked.Fit();
  for (std::size_t p = 0; p < Pixels; p += 3)
  {
    masked.variance[p] = masked.mean[p] = std::nan("");
    masked.neighbourMean[p] = std::nanf("");
    masked.dof[p] = 0.0F;
  }
  EXPECT_EQ(masked.Fit().gain, part.gain);
  EXPECT_EQ(masked.Fit().covariance, part.covariance);
}

TEST(SensorNoiseVarianceFit, TrimmedPixelsAreReported)
{
  Maps maps(true);
  for (std::size_t p = 0; p < Pixels; p += 100)
  {
    maps.variance[p] *= p % 200 == 0 ? 1e4 : 1e-4;
    maps.mask[p] = p % 300 == 0 ? 0 : 1;
  }
  VarianceFit fit(maps.Data(), test::Threads(3), std::nullopt);
  fit.Iterate(8);
  fit.FillErrors();
  const std::vector<std::uint8_t> trimmed = fit.FindTrimmed();
  ASSERT_EQ(trimmed.size(), Pixels);
  for (std::size_t p = 0; p < Pixels; p += 100)
  {
    EXPECT_EQ(trimmed[p], maps.mask[p]) << p;
  }
  const auto used = static_cast<double>(std::count(maps.mask.begin(), maps.mask.end(), std::uint8_t{ 1 }));
  const auto count = static_cast<double>(std::count(trimmed.begin(), trimmed.end(), std::uint8_t{ 1 }));
  EXPECT_EQ(fit.GetLine().trimmedFraction, count / used);
}

TEST(SensorNoiseVarianceFit, StartsBetweenPatchesOfFewLevels)
{
  // Ten levels, the darkest with hardly any noise. Its last intensity bin contains a tenth of the pixels of the next
  // level. With the mean level and the median variance of this bin the first line would be so wrong that it keeps no
  // pixel.
  constexpr double                 gain = 5.0;
  Maps                             maps(true);
  std::mt19937                     random(42);
  std::uniform_real_distribution<> uniform(-1.0, 1.0);
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    const std::size_t patch = p < 2450 ? 0 : 1 + p % 9;
    const double      electrons = 80.0 * static_cast<double>(patch);
    maps.mean[p] = 200.0 + gain * electrons;
    maps.neighbourMean[p] = static_cast<float>(maps.mean[p] + uniform(random));
    const double                    variance = 9.0 + gain * gain * electrons;
    const double                    dof = Dof / (1.0 + 0.5 * gain * gain / variance);
    std::gamma_distribution<double> gamma(0.5 * dof, 2.0 / dof);
    maps.variance[p] = variance * gamma(random);
  }
  const VarianceLine line = maps.Fit();
  ASSERT_TRUE(line.isDetermined);
  EXPECT_NEAR(line.gain, gain, 4.0 * std::sqrt(line.covariance(0, 0)));
  EXPECT_LT(std::sqrt(line.covariance(0, 0)), 0.01 * gain);
}

TEST(SensorNoiseVarianceFit, ThreadsChangeNoBit)
{
  const Maps maps(true);
  const auto expected = maps.Fit();
  const auto line = maps.Fit(test::Threads(3));
  EXPECT_EQ(line.gain, expected.gain);
  EXPECT_EQ(line.intercept, expected.intercept);
  EXPECT_EQ(line.covariance, expected.covariance);
  EXPECT_EQ(line.curvature, expected.curvature);
}

TEST(SensorNoiseVarianceFit, OneIntensityOrTooFewPixelsDetermineNothing)
{
  Maps maps(true);
  maps.mean.assign(Pixels, 500.0);
  maps.neighbourMean.assign(maps.mean.begin(), maps.mean.end());
  EXPECT_FALSE(maps.Fit().isDetermined);
  maps = Maps(true);
  maps.mask.assign(Pixels, 0);
  EXPECT_FALSE(maps.Fit().isDetermined);
  std::fill_n(maps.mask.begin(), 9, std::uint8_t{ 1 });
  EXPECT_FALSE(maps.Fit().isDetermined);
}

TEST(SensorNoiseVarianceFit, FixedPatternOfDarkPixelsDoesNotFlattenTheLineOfTheRejection)
{
  // All but one in 20 pixels are dark and have levels of their own, of 20 DN rms, which are no signal.
  Maps                       maps(true);
  std::mt19937               random(43);
  std::normal_distribution<> normal(0.0, 20.0);
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    if (p % 20 != 0)
    {
      maps.variance[p] *= (Intercept + Gain * 100.0) / (Intercept + Gain * maps.mean[p]);
      maps.mean[p] = 100.0 + normal(random);
      maps.neighbourMean[p] = static_cast<float>(100.0 + normal(random) / std::sqrt(8.0));
    }
  }
  const auto sloped = maps.Fit();
  ASSERT_TRUE(sloped.isDetermined);
  EXPECT_NEAR(sloped.gain, Gain, 4.0 * std::sqrt(sloped.covariance(0, 0)));
  EXPECT_LT(std::sqrt(sloped.covariance(0, 0)), 0.05 * Gain);
  VarianceFit own(maps.Data(), SerialFor, sloped, TrimRule::Distance);
  own.Iterate(8);
  EXPECT_LT(own.GetLine().gain, 0.8 * Gain); // by the pixels' own levels
}
