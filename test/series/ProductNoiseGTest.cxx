// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameEquations.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "series/FrameEquations.h"
#include "series/FrameRegressors.h"
#include "series/FrameSums.h"
#include "series/OffsetLine.h"
#include "series/SceneSeries.h"
#include "helpers/FrameTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 120;
constexpr std::size_t Height = 90;
constexpr std::size_t LastClass = GradientClasses - 1;

/** Returns the variances of the initial noise model, times \a factor where the mean is above \a levelDn. */
std::vector<double>
VarianceWith(const SyntheticFrames & frames, double levelDn, double factor)
{
  std::vector<double> variance;
  for (std::size_t p = 0; p < frames.Pixels(); ++p)
  {
    variance.push_back((frames.reference.mean[p] > levelDn ? factor : 1.0) / frames.Weight(p));
  }
  return variance;
}

/** Adds noise to frames that have none: of the variances \a variance. */
void
AddNoise(SyntheticFrames & frames, const std::vector<double> & variance, unsigned int seed)
{
  std::mt19937               random(seed);
  std::normal_distribution<> normal(0.0, 1.0);
  for (std::size_t i = 0; i < frames.pixels.size(); ++i)
  {
    frames.pixels[i] += std::sqrt(variance[i % frames.Pixels()]) * normal(random);
  }
}

RegressorNoise
NoiseWith(const FrameSums & sums, const std::vector<double> & variance)
{
  RegressorNoise noise = NoiseOfModel(sums.GetRegressors());
  noise.ofProducts = CovarianceOfProducts(sums.GetRegressors(), variance, SerialFor);
  return noise;
}
} // namespace

TEST(SensorNoiseProductNoise, IsTheGramMatrixWhereTheWeightsAreRight)
{
  const SyntheticFrames frames(Width, Height, FlickerAndMotion(12, 120.0, 0.2));
  const FrameSums       sums = frames.Sums();
  std::vector<double>   variance = VarianceWith(frames, 0.0, 3.0);
  const auto            covariance = CovarianceOfProducts(sums.GetRegressors(), variance, SerialFor);
  ASSERT_EQ(covariance.size(), GradientClasses);
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    const FrameSums::ClassMatrix & gram = sums.GetClassGram(c);
    EXPECT_LT((covariance[c] - 3.0 * gram).norm(), 3.0 * RoundingOfProducts * gram.norm()) << c;
  }
}

TEST(SensorNoiseProductNoise, APixelWithoutAVarianceHasTheModels)
{
  const SyntheticFrames     frames(Width, Height, std::vector<FrameChange>(5));
  const FrameSums           sums = frames.Sums();
  const std::vector<double> unknown(frames.Pixels(), std::numeric_limits<double>::quiet_NaN());
  const auto                covariance = CovarianceOfProducts(sums.GetRegressors(), unknown, SerialFor);
  EXPECT_LT((covariance[0] - sums.GetClassGram(0)).norm(), RoundingOfProducts * sums.GetClassGram(0).norm());
}

TEST(SensorNoiseProductNoise, EquationsHaveTheCovarianceOfTheirRightHandSide)
{
  // Noise alone, 9 times the model's variance in bright pixels: over the frames, response has the covariance
  // illumination.
  SyntheticFrames           frames(Width, Height, std::vector<FrameChange>(400));
  const std::vector<double> variance = VarianceWith(frames, 1000.0, 9.0);
  AddNoise(frames, variance, 3);
  const FrameSums       sums = frames.Sums();
  const FrameEquations  equations = MakeFrameEquations(sums, NoiseWith(sums, variance), LastClass);
  const Eigen::Matrix2d scatter = equations.response.transpose() * equations.response / 400.0;
  const Eigen::Matrix2d ratio = equations.illumination.inverse() * scatter;
  // Variances of 400 frames: 5 standard errors.
  const double slack = 5.0 * std::sqrt(2.0 / 400.0);
  EXPECT_NEAR(ratio(0, 0), 1.0, slack);
  EXPECT_NEAR(ratio(1, 1), 1.0, slack);
  const FrameEquations  unweighted = MakeFrameEquations(sums, NoiseOfModel(sums.GetRegressors()), LastClass);
  const Eigen::Matrix2d wrong =
    unweighted.illumination.inverse() * (unweighted.response.transpose() * unweighted.response) / 400.0;
  EXPECT_GT(wrong(1, 1), 1.0 + slack);
}

TEST(SensorNoiseProductNoise, WeightingKeepsTheLineOfFramesWithoutNoise)
{
  const SyntheticFrames frames(Width, Height, FlickerAndMotion(24, 120.0, 0.0));
  const FrameSums       sums = frames.Sums();
  const auto            line =
    FitOffsetLine(MakeFrameEquations(sums, NoiseWith(sums, VarianceWith(frames, 1000.0, 9.0)), LastClass));
  ASSERT_TRUE(line);
  const auto unweighted = FitOffsetLine(MakeFrameEquations(sums, NoiseOfModel(sums.GetRegressors()), LastClass));
  ASSERT_TRUE(unweighted);
  EXPECT_NEAR(line->offset, unweighted->offset, 0.5); // both are off by the noise of the means that is subtracted
  for (std::size_t t = 0; t < line->gamma.size(); ++t)
  {
    EXPECT_NEAR(line->gamma[t], unweighted->gamma[t], 1e-3) << t;
  }
}

TEST(SensorNoiseProductNoise, NoiseBeyondTheModelIsNoFlicker)
{
  // A steady light source. The model has a hundredth of the variance that bright pixels have.
  SyntheticFrames           frames(Width, Height, std::vector<FrameChange>(24));
  const std::vector<double> variance = VarianceWith(frames, 1200.0, 100.0);
  AddNoise(frames, variance, 5);
  const FrameSums   sums = frames.Sums();
  const SceneSeries blind = FindSceneSeries(sums, RollingShutter::Off);
  EXPECT_TRUE(blind.isOffsetIdentifiable) << "the case is too easy";
  const auto        raw = CovarianceOfProducts(sums.GetRegressors(), variance, SerialFor);
  const SceneSeries series = FindSceneSeries(sums, RollingShutter::Off, std::nullopt, 0.0, false, raw);
  EXPECT_FALSE(series.isOffsetIdentifiable);
}

TEST(SensorNoiseProductNoise, NoiseBeyondTheModelIsNoUnevenFlicker)
{
  // A steady light source. In the left third of the frame, the noise has 25 times the variance of the model.
  SyntheticFrames     frames(Width, Height, std::vector<FrameChange>(24));
  std::vector<double> variance = VarianceWith(frames, 0.0, 1.0);
  for (std::size_t p = 0; p < frames.Pixels(); ++p)
  {
    variance[p] *= 3 * (p % Width) < Width ? 25.0 : 1.0;
  }
  AddNoise(frames, variance, 7);
  const SceneSeries series = FindSceneSeries(frames.Sums(), RollingShutter::Auto);
  EXPECT_FALSE(series.local.unevenness.Counts()) << series.local.unevenness.size << ' ' << series.local.unevenness.z;
}
