// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "stabilise/NoiseModelCheck.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <stdexcept>

using namespace sensornoise;

// Without read noise the law is Poisson's: two sums.
TEST(PoissonGaussianLaw, IsPoissonsWithoutReadNoise)
{
  constexpr double electrons = 3.0;
  double           probability = std::exp(-electrons);
  double           mean = 0.0;
  double           square = 0.0;
  for (int k = 0; k < 100; ++k)
  {
    mean += probability * 2.0 * std::sqrt(k + 0.375);
    square += probability * 4.0 * (k + 0.375);
    probability *= electrons / (k + 1);
  }
  const StabilisedMoments found = MomentsOfStabilised(electrons, 0.0);
  EXPECT_NEAR(found.mean, mean, 1e-13);
  EXPECT_NEAR(found.variance, square - mean * mean, 1e-12);
  EXPECT_EQ(found.negativeProbability, 0.0);
  EXPECT_NEAR(MomentsOfStabilised(0.0, 0.0).mean, std::sqrt(1.5), 1e-15);
}

// Without signal it is normal: a sum over five million slices.
TEST(PoissonGaussianLaw, IsNormalWithoutSignal)
{
  for (const double readNoise : { 0.05, 0.4, 2.0, 13.0 })
  {
    constexpr int slices = 5000000;
    double        mean = 0.0;
    double        negative = 0.0;
    for (int i = 0; i < slices; ++i)
    {
      const double n = 20.0 * (i + 0.5) / slices - 10.0;
      const double probability = std::exp(-0.5 * n * n) / std::sqrt(8.0 * std::atan(1.0)) * 20.0 / slices;
      const double argument = readNoise * n + 0.375 + readNoise * readNoise;
      mean += probability * 2.0 * std::sqrt(std::max(0.0, argument));
      negative += argument < 0.0 ? probability : 0.0;
    }
    const StabilisedMoments found = MomentsOfStabilised(0.0, readNoise);
    EXPECT_NEAR(found.mean, mean, 1e-8) << readNoise; // the slice at the branch point
    EXPECT_NEAR(found.negativeProbability, negative, 2e-6) << readNoise;
  }
}

// One of the two quadratures takes over from the other.
TEST(PoissonGaussianLaw, HasNoStepBetweenItsQuadratures)
{
  // s^2 + 3/8 = 12 s
  const double root = std::sqrt(36.0 - 0.375);
  for (const double readNoise : { 6.0 - root, 6.0 + root })
  {
    const StabilisedMoments below = MomentsOfStabilised(0.0, readNoise * (1.0 - 1e-12));
    const StabilisedMoments above = MomentsOfStabilised(0.0, readNoise * (1.0 + 1e-12));
    EXPECT_NEAR(below.mean, above.mean, 1e-10) << readNoise;
    EXPECT_NEAR(below.variance, above.variance, 1e-9) << readNoise;
  }
}

// 400,000 draws: 4.5 standard errors, which of 8 numbers one exceeds by chance in 20,000 runs.
TEST(PoissonGaussianLaw, IsThatOfDraws)
{
  std::mt19937_64 random(5);
  for (const double electrons : { 0.7, 6.0 })
  {
    for (const double readNoise : { 0.6, 2.5 })
    {
      std::poisson_distribution<int>   photons(electrons);
      std::normal_distribution<double> read(readNoise * readNoise + 0.375, readNoise);
      constexpr int                    draws = 400000;
      double                           sums[4]{};
      const StabilisedMoments          expected = MomentsOfStabilised(electrons, readNoise);
      for (int i = 0; i < draws; ++i)
      {
        const double d = 2.0 * std::sqrt(std::max(0.0, photons(random) + read(random))) - expected.mean;
        sums[1] += d;
        sums[2] += d * d;
        sums[3] += d * d * d * d;
      }
      const double variance = sums[2] / draws;
      EXPECT_NEAR(sums[1] / draws, 0.0, 4.5 * std::sqrt(variance / draws)) << electrons << ' ' << readNoise;
      const double ofVariance = std::sqrt((sums[3] / draws - variance * variance) / draws);
      EXPECT_NEAR(variance, expected.variance, 4.5 * ofVariance) << electrons << ' ' << readNoise;
    }
  }
}

// The transform's purpose. 0.0153 is the most, at 10 e- and a read noise of 3 e-.
TEST(PoissonGaussianLaw, HasVarianceOneAboveTenElectrons)
{
  for (double electrons = 10.0; electrons < 10001.0; electrons *= 1.6)
  {
    for (double readNoise = 0.0; readNoise < 31.0; readNoise = 1.3 * readNoise + 0.1)
    {
      EXPECT_NEAR(MomentsOfStabilised(electrons, readNoise).variance, 1.0, 0.016) << electrons << ' ' << readNoise;
    }
  }
}

TEST(PoissonGaussianLaw, RefusesWhatIsNoLaw)
{
  EXPECT_THROW(MomentsOfStabilised(-1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(MomentsOfStabilised(1.0, -1.0), std::invalid_argument);
  EXPECT_THROW(MomentsOfStabilised(std::numeric_limits<double>::quiet_NaN(), 1.0), std::invalid_argument);
  EXPECT_THROW(MomentsOfStabilised(1e7, 1.0), std::invalid_argument);
}
