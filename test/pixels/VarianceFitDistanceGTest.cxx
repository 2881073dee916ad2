// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceFit.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "moments/Constants.h"
#include "moments/DarkFrames.h"
#include "pixels/VarianceLine.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <vector>

// TrimRule::Distance: the line fits the mean variance of pixels whose read noise differs.

using namespace sensornoise;

namespace
{
constexpr std::size_t Pixels = 40000;
constexpr float       Dof = 30.0F;
constexpr double      Gain = 0.05; // many electrons per DN, so that the noise is nearly normal
constexpr double      BlackDn = 100.0;

/** Maps with means from 110 to 600 DN. \a readVarianceOf draws the variance of the read noise [DN^2]. */
struct Maps
{
  std::vector<double>       mean;
  std::vector<float>        neighbourMean;
  std::vector<double>       variance;
  std::vector<double>       readVariance;
  std::vector<float>        dof = std::vector<float>(Pixels, Dof);
  std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(Pixels, 1);

  explicit Maps(const std::function<double(std::mt19937 &)> & readVarianceOf)
  {
    std::mt19937                     random(43);
    std::uniform_real_distribution<> uniform(110.0, 600.0);
    std::chi_squared_distribution<>  chiSquare(Dof);
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      mean.push_back(uniform(random));
      neighbourMean.push_back(static_cast<float>(mean.back()));
      readVariance.push_back(readVarianceOf(random));
      variance.push_back((readVariance[p] + Gain * (mean[p] - BlackDn)) * chiSquare(random) / Dof);
    }
  }
  VarianceData
  Data() const
  {
    return { mean.data(), neighbourMean.data(), { variance.data() }, dof.data(), mask.data(), Pixels };
  }
  VarianceFit
  Fit(TrimRule rule, const ParallelFor & parallelFor = SerialFor) const
  {
    VarianceFit fit(this->Data(), parallelFor, std::nullopt, rule, BlackDn);
    fit.Iterate(8);
    fit.FillErrors();
    return fit;
  }
  double
  MeanReadVariance() const
  {
    double sum = 0.0;
    for (const double value : readVariance)
    {
      sum += value / Pixels;
    }
    return sum;
  }
};

/** Draws the variance of a read noise with the median 1 DN, whose logarithm has the standard deviation \a spread. */
std::function<double(std::mt19937 &)>
LogNormal(double spread)
{
  return [=](std::mt19937 & random) { return std::exp(2.0 * spread * std::normal_distribution<>()(random)); };
}

/** Returns the deviation of the line from the truth at a level, in standard errors of the line. */
double
ErrorAt(const VarianceLine & line, double level, double truth)
{
  const Eigen::Vector2d at(level, 1.0);
  return (line.intercept + line.gain * level - truth) / std::sqrt(at.dot(line.covariance * at));
}
} // namespace

TEST(SensorNoiseVarianceFitDistance, LineOfLogNormalNoiseIsThatOfTheMean)
{
  const Maps         maps(LogNormal(0.4));
  const double       read = maps.MeanReadVariance(); // exp(2 0.4^2) = 1.38 times the median
  const VarianceFit  fit = maps.Fit(TrimRule::Distance);
  const VarianceLine mean = fit.GetLine();
  const VarianceLine level = maps.Fit(TrimRule::Level).GetLine();
  ASSERT_TRUE(mean.isDetermined && level.isDetermined);
  EXPECT_NEAR(mean.gain, Gain, 5.0 * std::sqrt(mean.covariance(0, 0)));
  EXPECT_LT(std::abs(ErrorAt(mean, BlackDn, read)), 5.0);
  // In the dark the noisy pixels are beyond the tails of chi-square, at high signals they are not.
  EXPECT_GT(level.gain, Gain + 5.0 * std::sqrt(level.covariance(0, 0)));
  EXPECT_LT(ErrorAt(level, BlackDn, read), -5.0);
  EXPECT_LT(mean.trimmedFraction, 1e-3);
}

TEST(SensorNoiseVarianceFitDistance, DispersionOfTheNoiseOfThePixelsIsFound)
{
  const Maps   maps(LogNormal(0.3));
  const double mean = maps.MeanReadVariance();
  double       spread = 0.0;
  for (const double value : maps.readVariance)
  {
    spread += (value - mean) * (value - mean) / Pixels;
  }
  // The dispersion has heavy tails and is determined mainly by the dark pixels: it is known within a fifth.
  EXPECT_NEAR(maps.Fit(TrimRule::Distance).GetLine().noiseDispersionDn4 / spread, 1.0, 0.5);
  // Pixels of equal noise have no dispersion, and keep the weights of chi-square.
  EXPECT_EQ(Maps([](std::mt19937 &) { return 1.0; }).Fit(TrimRule::Distance).GetLine().noiseDispersionDn4, 0.0);
}

TEST(SensorNoiseVarianceFitDistance, ErrorsAreThoseOfTheWeights)
{
  // With the right weights the sandwich covariance is the inverse information, sum (x, 1)'(x, 1) / (2 V^2 / dof + S).
  const Maps         maps(LogNormal(0.3));
  const VarianceLine line = maps.Fit(TrimRule::Distance).GetLine();
  Eigen::Matrix2d    information = Eigen::Matrix2d::Zero();
  for (const double mean : maps.mean)
  {
    const Eigen::Vector2d row(mean, 1.0);
    information += row * row.transpose() / (2.0 * std::pow(line.At(mean), 2) / Dof + line.noiseDispersionDn4);
  }
  const Eigen::Matrix2d fisher = information.inverse();
  EXPECT_NEAR(line.covariance(0, 0) / fisher(0, 0), 1.0, 0.2); // heavy tails: twice the scatter of normal noise
  EXPECT_NEAR(line.covariance(1, 1) / fisher(1, 1), 1.0, 0.2);
}

TEST(SensorNoiseVarianceFitDistance, NoisyPixelsRaiseTheLineByTheirFraction)
{
  // 4 % of the pixels have 60 % more variance. They are not identifiable one by one, and are part of the mean.
  Maps         maps([](std::mt19937 &) { return 1.0; });
  VarianceLine plain = maps.Fit(TrimRule::Distance).GetLine();
  for (std::size_t p = 0; p < Pixels; p += 25)
  {
    maps.variance[p] *= 1.6;
  }
  const VarianceLine raised = maps.Fit(TrimRule::Distance).GetLine();
  for (const double level : { 150.0, plain.pivotDn, 550.0 })
  {
    EXPECT_LT(std::abs(ErrorAt(raised, level, 1.024 * (1.0 + Gain * (level - BlackDn)))), 5.0) << level;
  }
  EXPECT_GT(ErrorAt(raised, plain.pivotDn, 1.0 + Gain * (plain.pivotDn - BlackDn)), 5.0);
}

TEST(SensorNoiseVarianceFitDistance, DefectivePixelsAreTrimmedAtTheSameDistanceEverywhere)
{
  Maps                            maps([](std::mt19937 &) { return 1.0; });
  const double                    factor = InMoments.defectiveNoiseFactor * InMoments.defectiveNoiseFactor;
  const std::vector<std::uint8_t> before = maps.Fit(TrimRule::Distance).FindTrimmed();
  EXPECT_LE(std::count(before.begin(), before.end(), std::uint8_t{ 1 }), 4); // 1e-5 of the brightest pixels
  for (std::size_t p = 0; p < Pixels; p += 100)
  {
    maps.variance[p] = 1.0 + Gain * (maps.mean[p] - BlackDn) + (p % 200 == 0 ? 1.5 : 0.5) * factor;
  }
  const VarianceFit               fit = maps.Fit(TrimRule::Distance);
  const std::vector<std::uint8_t> trimmed = fit.FindTrimmed();
  // The typical noise is known within one per cent.
  EXPECT_NEAR(fit.GetReachDn2() / (factor - 1.0), 1.0, 0.2);
  for (std::size_t p = 0; p < Pixels; p += 100)
  {
    EXPECT_EQ(trimmed[p], p % 200 == 0 ? 1 : 0) << p << ' ' << maps.mean[p];
  }
}

TEST(SensorNoiseVarianceFitDistance, ThreadsChangeNoBit)
{
  const Maps         maps(LogNormal(0.3));
  const VarianceLine expected = maps.Fit(TrimRule::Distance).GetLine();
  const VarianceLine line = maps.Fit(TrimRule::Distance, test::Threads(3)).GetLine();
  EXPECT_EQ(line.gain, expected.gain);
  EXPECT_EQ(line.covariance, expected.covariance);
  EXPECT_EQ(line.noiseDispersionDn4, expected.noiseDispersionDn4);
}
