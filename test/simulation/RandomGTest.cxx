// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace
{
using sensornoise::CounterSeededRandom;

/** Returns the probability of k for a Poisson law. */
double
PoissonProbability(double mean, int k)
{
  return std::exp(k * std::log(mean) - mean - std::lgamma(k + 1.0));
}

/** Draws and checks mean, variance and the chi-square distance to the probabilities. */
void
CheckPoisson(double mean)
{
  SCOPED_TRACE(mean);
  constexpr int       draws = 400000;
  CounterSeededRandom random(11, 0, static_cast<std::uint64_t>(mean * 100.0));
  std::vector<double> histogram(static_cast<std::size_t>(mean + 20.0 * std::sqrt(mean) + 40.0), 0.0);
  double              sum = 0.0;
  double              sumOfSquares = 0.0;
  for (int i = 0; i < draws; ++i)
  {
    const auto k = static_cast<double>(random.Poisson(mean));
    ASSERT_GE(k, 0.0);
    ASSERT_LT(k, static_cast<double>(histogram.size())); // 20 standard deviations above the mean
    histogram[static_cast<std::size_t>(k)] += 1.0;
    sum += k - mean;
    sumOfSquares += (k - mean) * (k - mean);
  }
  // 5 standard errors; the fourth central moment of a Poisson law is mean + 3 mean^2, so Var(s^2) = (mean + 2
  // mean^2)/n.
  EXPECT_NEAR(sum / draws, 0.0, 5.0 * std::sqrt(mean / draws));
  EXPECT_NEAR(sumOfSquares / draws, mean, 5.0 * std::sqrt((mean + 2.0 * mean * mean) / draws));

  // Neighbouring counts are pooled until 20 are expected, as the chi-square law asks for.
  double chiSquare = 0.0;
  double expected = 0.0;
  double found = 0.0;
  double expectedSoFar = 0.0;
  int    classes = 0;
  for (std::size_t k = 0; k < histogram.size(); ++k)
  {
    expected += draws * PoissonProbability(mean, static_cast<int>(k));
    found += histogram[k];
    if (expected >= 20.0 && draws - expectedSoFar - expected >= 20.0)
    {
      chiSquare += (found - expected) * (found - expected) / expected;
      expectedSoFar += expected;
      ++classes;
      expected = 0.0;
      found = 0.0;
    }
  }
  chiSquare += (found - expected) * (found - expected) / expected;
  // Exceeded with probability below exp(-14) = 1e-6 (Laurent and Massart, Ann. Statist. 28(5), 2000, lemma 1).
  const double dof = classes;
  EXPECT_LT(chiSquare, dof + 2.0 * std::sqrt(14.0 * dof) + 2.0 * 14.0);
}
} // namespace

TEST(SensorNoiseRandom, BitsAreThoseOfAnIndependentImplementation)
{
  // From a Python implementation of SplitMix64 and xoshiro256++.
  CounterSeededRandom random(1, 2, 3, 4);
  EXPECT_EQ(random.Bits(), 0x3ebee22cb97f784dULL);
  EXPECT_EQ(random.Bits(), 0x5d39b9f76660b744ULL);
  EXPECT_EQ(random.Bits(), 0xcd6359c72c3ad6e8ULL);
  for (int i = 3; i < 19; ++i)
  {
    random.Bits();
  }
  EXPECT_EQ(random.Bits(), 0x9401606bbc6322fcULL);
}

TEST(SensorNoiseRandom, EachCounterMatters)
{
  const auto first = CounterSeededRandom(1, 2, 3, 4).Bits();
  EXPECT_EQ(first, CounterSeededRandom(1, 2, 3, 4).Bits());
  EXPECT_NE(first, CounterSeededRandom(5, 2, 3, 4).Bits());
  EXPECT_NE(first, CounterSeededRandom(1, 5, 3, 4).Bits());
  EXPECT_NE(first, CounterSeededRandom(1, 2, 5, 4).Bits());
  EXPECT_NE(first, CounterSeededRandom(1, 2, 3, 5).Bits());
  EXPECT_NE(CounterSeededRandom(1, 2, 3, 4).Bits(), CounterSeededRandom(1, 2, 4, 3).Bits());
}

TEST(SensorNoiseRandom, NeighbouringRowsAreUncorrelated)
{
  constexpr int draws = 200000;
  double        alongRows = 0.0;
  double        alongFrames = 0.0;
  for (int i = 0; i < draws; ++i)
  {
    const auto   row = static_cast<std::uint64_t>(i);
    const double here = CounterSeededRandom(1, 2, 7, row).Normal();
    alongRows += here * CounterSeededRandom(1, 2, 7, row + 1).Normal();
    alongFrames += here * CounterSeededRandom(1, 2, 8, row).Normal();
  }
  // Products of independent standard normals have variance 1: 5 standard errors.
  EXPECT_NEAR(alongRows / draws, 0.0, 5.0 / std::sqrt(draws));
  EXPECT_NEAR(alongFrames / draws, 0.0, 5.0 / std::sqrt(draws));
}

TEST(SensorNoiseRandom, UniformHasTheMomentsOfTheUnitInterval)
{
  constexpr int       draws = 1000000;
  CounterSeededRandom random(3);
  double              sum = 0.0;
  double              sumOfSquares = 0.0;
  for (int i = 0; i < draws; ++i)
  {
    const double u = random.Uniform();
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u - 0.5;
    sumOfSquares += (u - 0.5) * (u - 0.5);
  }
  // Variance 1/12, fourth central moment 1/80, so Var(s^2) = (1/80 - 1/144)/n: 5 standard errors each.
  EXPECT_NEAR(sum / draws, 0.0, 5.0 * std::sqrt(1.0 / 12.0 / draws));
  EXPECT_NEAR(sumOfSquares / draws, 1.0 / 12.0, 5.0 * std::sqrt((1.0 / 80.0 - 1.0 / 144.0) / draws));
}

TEST(SensorNoiseRandom, NormalHasTheMomentsAndTailsOfTheNormalLaw)
{
  constexpr int       draws = 2000000;
  CounterSeededRandom random(4);
  double              moments[5] = {};
  double              beyondTwo = 0.0;
  double              products = 0.0;
  double              previous = 0.0;
  for (int i = 0; i < draws; ++i)
  {
    const double z = random.Normal();
    double       power = 1.0;
    for (double & moment : moments)
    {
      moment += power / draws;
      power *= z;
    }
    beyondTwo += std::abs(z) > 2.0 ? 1.0 / draws : 0.0;
    products += z * previous / draws;
    previous = z;
  }
  // E z^k = 1, 0, 1, 0, 3; Var z^k = 0, 1, 2, 15, 96: 5 standard errors each.
  const double error = 5.0 / std::sqrt(draws);
  EXPECT_NEAR(moments[1], 0.0, error);
  EXPECT_NEAR(moments[2], 1.0, error * std::sqrt(2.0));
  EXPECT_NEAR(moments[3], 0.0, error * std::sqrt(15.0));
  EXPECT_NEAR(moments[4], 3.0, error * std::sqrt(96.0));
  // erfc(2 / sqrt 2) = 0.0455, a binomial share; the two numbers of a pair are independent.
  EXPECT_NEAR(beyondTwo, 0.045500, error * std::sqrt(0.0455 * 0.9545));
  EXPECT_NEAR(products, 0.0, error);
}

TEST(SensorNoiseRandom, PoissonFollowsItsLaw)
{
  for (const double mean : { 0.1, 1.0, 5.0, 9.999, 10.0, 10.5, 30.0, 200.0, 3000.0 })
  {
    CheckPoisson(mean);
  }
}

TEST(SensorNoiseRandom, PoissonAtTheEndsOfItsRange)
{
  CounterSeededRandom random(5);
  EXPECT_EQ(random.Poisson(0.0), 0);
  EXPECT_EQ(random.Poisson(-3.0), 0);
  EXPECT_EQ(random.Poisson(std::nan("")), 0);
  EXPECT_EQ(random.Poisson(1e-300), 0);
  constexpr int draws = 10000;
  double        sum = 0.0;
  for (int i = 0; i < draws; ++i)
  {
    sum += static_cast<double>(random.Poisson(1e9)) - 1e9;
  }
  EXPECT_NEAR(sum / draws, 0.0, 5.0 * std::sqrt(1e9 / draws)); // 5 standard errors
}

TEST(SensorNoiseRandom, LogFactorialAgreesWithLogGamma)
{
  for (double k = 0.0; k < 1e9; k = std::floor(k * 1.3) + 1.0)
  {
    // 1e-11 as documented; relative 1e-15 for the rounding of the terms.
    EXPECT_NEAR(CounterSeededRandom::LogFactorial(k), std::lgamma(k + 1.0), 1e-11 + 1e-15 * k * std::log(k + 1.0)) << k;
  }
}
