// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/DarkFrames.h"
#include "sensornoise/Settings.h"
#include "simulation/Random.h"
#include "helpers/DarkPixelsTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
/** Draws the variance of a pixel over \a frames with Gaussian noise. */
double
VarianceOfPixel(double noiseDn, std::size_t frames, CounterSeededRandom & random)
{
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t t = 0; t < frames; ++t)
  {
    const double value = random.Normal();
    sum += value;
    squares += value * value;
  }
  const auto count = static_cast<double>(frames);
  return noiseDn * noiseDn * (squares - sum * sum / count) / (count - 1.0);
}

struct NoiseCase
{
  std::string                                  name;
  std::function<double(CounterSeededRandom &)> noise;
  double                                       median; // median of the population [DN]
};

/** Returns the median of a population with a tail, by bisection of its distribution function. */
double
MedianWithTail(double spread, double tail)
{
  const auto below = [&](double x) { // P(ln noise/3 < x), integrated over the excess of the tail
    double sum = 0.0;
    double weight = 0.0;
    for (int i = 0; i < 4000; ++i)
    {
      const double z = 0.002 * (i + 0.5);
      const double w = std::exp(-0.5 * z * z);
      sum += w * 0.5 * std::erfc(-(x - z) / spread / std::sqrt(2.0));
      weight += w;
    }
    return (1.0 - tail) * 0.5 * std::erfc(-x / spread / std::sqrt(2.0)) + tail * sum / weight;
  };
  double low = -1.0;
  double high = 1.0;
  for (int i = 0; i < 50; ++i)
  {
    (below(0.5 * (low + high)) < 0.5 ? low : high) = 0.5 * (low + high);
  }
  return 3.0 * std::exp(0.5 * (low + high));
}

std::vector<NoiseCase>
NoiseCases()
{
  return { { "alike", [](CounterSeededRandom &) { return 3.0; }, 3.0 },
           { "spread 0.3", LogNormalNoise(0.3), 3.0 },
           { "spread 0.6", LogNormalNoise(0.6), 3.0 },
           { "spread 0.3 and a tail", LogNormalNoise(0.3, 0.15), MedianWithTail(0.3, 0.15) },
           { "spread 0.4 and a tail", LogNormalNoise(0.4, 0.1), MedianWithTail(0.4, 0.1) } };
}

std::optional<MedianReadNoise>
MedianOfCase(const NoiseCase & noise, std::size_t frames, std::size_t pixels, std::uint64_t seed)
{
  CounterSeededRandom random(seed, frames);
  std::vector<double> variances;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    variances.push_back(VarianceOfPixel(noise.noise(random), frames, random));
  }
  return MedianReadNoiseOf(variances, static_cast<double>(frames) - 1.0, 0.0);
}
} // namespace

TEST(SensorNoiseNoiseMedian, ItIsThePopulationsWhateverTheShape)
{
  for (const NoiseCase & noise : NoiseCases())
  {
    for (const std::size_t frames : { 6u, 8u, 20u, 100u })
    {
      const auto found = MedianOfCase(noise, frames, 40000, 1);
      ASSERT_TRUE(found);
      // 0.4 % is the standard error of 40,000 pixels at a spread of 0.6
      EXPECT_NEAR(found->valueDn / noise.median, 1.0, 0.012) << noise.name << ", " << frames;
      EXPECT_NEAR(found->valueDn, noise.median, 4.0 * found->standardErrorDn) << noise.name << ", " << frames;
    }
  }
}

// 57 ± 1.7 of 60 results are within 1.96 standard errors, and more if the allowance for bias is large.
TEST(SensorNoiseNoiseMedian, ErrorsAreAsLargeAsTheySay)
{
  for (const NoiseCase & noise : NoiseCases())
  {
    int inside = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
    {
      const auto found = MedianOfCase(noise, 8, 500, seed);
      inside += found && std::abs(found->valueDn - noise.median) < 1.96 * found->standardErrorDn ? 1 : 0;
    }
    EXPECT_GE(inside, 52) << noise.name;
  }
}

TEST(SensorNoiseNoiseMedian, RoundingIsSubtracted)
{
  std::vector<double> variances(1000);
  CounterSeededRandom random(1);
  for (double & variance : variances)
  {
    variance = VarianceOfPixel(std::sqrt(9.0 + 16.0 / 12.0), 50, random);
  }
  const auto found = MedianReadNoiseOf(variances, 49.0, 4.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->valueDn, 3.0, 4.0 * found->standardErrorDn);
  EXPECT_LT(found->standardErrorDn, 0.05);
}

// Rounded frames have few different variances: with noise of one step and 8 frames the error of their median is 4 %.
TEST(SensorNoiseNoiseMedian, FewNumbersThatRoundingLeavesAreNoBias)
{
  for (const double spread : { 0.0, 0.3 })
  {
    for (const double scale : { 0.3, 0.5, 1.0 })
    {
      DarkSensor sensor = MakeDarkSensor(40000, 4.0, LogNormalNoise(spread, 0.05));
      for (double & noise : sensor.readNoiseDn)
      {
        noise *= scale;
      }
      const KnownOffset dark = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, 8));
      ASSERT_TRUE(dark.readNoiseMedian);
      const double truth = MedianOfPixels(sensor.readNoiseDn);
      EXPECT_NEAR(dark.readNoiseMedian->valueDn / truth, 1.0, 0.015) << spread << ", " << scale;
      EXPECT_NEAR(dark.readNoiseMedian->valueDn, truth, 3.0 * dark.readNoiseMedian->standardErrorDn)
        << spread << ", " << scale;
    }
  }
}

TEST(SensorNoiseNoiseMedian, UndeterminedMedianIsNull)
{
  const std::vector<double> some(1000, 2.0);
  EXPECT_TRUE(MedianReadNoiseOf(some, 5.0, 1.0));
  EXPECT_FALSE(MedianReadNoiseOf(some, 4.0, 1.0));
  EXPECT_FALSE(MedianReadNoiseOf(std::vector<double>(99, 2.0), 19.0, 1.0));
  EXPECT_FALSE(MedianReadNoiseOf(some, 19.0, 3.0)); // sqrt(2) is below half a step
  EXPECT_FALSE(MedianReadNoiseOf(std::vector<double>(1000, 0.0), 19.0, 0.0));
  EXPECT_FALSE(MedianReadNoiseOf({}, 19.0, 0.0));
}
