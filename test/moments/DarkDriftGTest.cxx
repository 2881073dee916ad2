// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/DarkFrames.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "simulation/Random.h"
#include "helpers/DarkPixelsTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Pixels = 4096;

/** Returns levels with a standard deviation of 5 DN. */
std::vector<double>
DriftOf(std::size_t frames)
{
  CounterSeededRandom random(9);
  std::vector<double> drift(frames);
  for (double & level : drift)
  {
    level = 5.0 * random.Normal();
  }
  return drift;
}

double
VarianceOfNumbers(const std::vector<double> & values)
{
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : values)
  {
    sum += value;
    squares += value * value;
  }
  const auto count = static_cast<double>(values.size());
  return (squares - sum * sum / count) / (count - 1.0);
}
} // namespace

TEST(SensorNoiseDarkDrift, SquaresAreThoseOfTheDeviationsFromTheFramesMeans)
{
  const std::vector<double> frames{ 1.0, 2.0, 6.0, 4.0, 0.5, 3.0, 2.0, 2.0, 8.0 }; // three frames of three pixels
  DarkDrift                 drift(3);
  drift.AddFrames(frames.data(), 3, SerialFor);
  for (std::size_t p = 0; p < 3; ++p)
  {
    double mean = 0.0;
    double squares = 0.0;
    double deviations = 0.0;
    for (std::size_t t = 0; t < 3; ++t)
    {
      mean += frames[3 * t + p] / 3.0;
    }
    std::vector<double> rest;
    double              restMean = 0.0;
    for (std::size_t t = 0; t < 3; ++t)
    {
      const double level = (frames[3 * t] + frames[3 * t + 1] + frames[3 * t + 2]) / 3.0;
      rest.push_back(frames[3 * t + p] - level);
      restMean += rest.back() / 3.0;
      squares += std::pow(frames[3 * t + p] - mean, 2);
    }
    for (const double value : rest)
    {
      deviations += std::pow(value - restMean, 2);
    }
    // The mean of three pixels contains a third of the noise of each.
    EXPECT_NEAR(drift.SquaresWithoutDrift(p, squares, mean), 1.5 * deviations, 1e-12) << p;
  }
}

TEST(SensorNoiseDarkDrift, WithoutFramesNothingIsSubtracted)
{
  EXPECT_EQ(DarkDrift().SquaresWithoutDrift(0, 7.0, 100.0), 7.0);
  EXPECT_EQ(DarkDrift().GetVarianceDn2(1.0), 0.0);
}

TEST(SensorNoiseDarkDrift, ItAddsNothingToThePixelsVariances)
{
  const DarkSensor  sensor = MakeDarkSensor(Pixels, 4.0, LogNormalNoise(0.3));
  const KnownOffset steady = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, 8));
  const KnownOffset drifting = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, 8, DriftOf(8)));
  EXPECT_NEAR(drifting.variance->valueDn2, steady.variance->valueDn2, 0.02 * steady.variance->valueDn2);
  // The noise is the same but for the rounding: it agrees pixel by pixel, not only on average.
  double difference = 0.0;
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    difference += std::abs(drifting.maps->varianceDn2[p] - steady.maps->varianceDn2[p]) / Pixels;
  }
  EXPECT_LT(difference, 0.1 * steady.variance->valueDn2);
  EXPECT_NEAR(drifting.driftVarianceDn2, VarianceOfNumbers(DriftOf(8)), 0.05 * VarianceOfNumbers(DriftOf(8)));
  EXPECT_LT(steady.driftVarianceDn2, 0.02);
  // The error of the offset is the standard error of the mean of 8 levels.
  EXPECT_NEAR(drifting.standardErrorDn, std::sqrt(drifting.driftVarianceDn2 / 8.0), 0.05 * drifting.standardErrorDn);
}

TEST(SensorNoiseDarkDrift, ALevelThatSettlesIsInTheErrorOfTheOffset)
{
  const DarkSensor    sensor = MakeDarkSensor(Pixels, 4.0, LogNormalNoise(0.3));
  std::vector<double> settling(16);
  std::vector<double> reversed(16);
  double              mean = 0.0;
  for (std::size_t t = 0; t < 16; ++t)
  {
    settling[t] = 20.0 * std::exp(-static_cast<double>(t) / 4.0);
    reversed[15 - t] = settling[t];
    mean += settling[t] / 16.0;
  }
  const double halves = 2.0 * mean * (1.0 - std::exp(-2.0)) / (1.0 + std::exp(-2.0)); // the series is geometric
  for (const auto & levels : { settling, reversed })
  {
    const KnownOffset dark = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, 16, levels));
    // The halves differ far beyond chance, so that half of their difference is in the error.
    EXPECT_GT(dark.standardErrorDn, 0.5 * 0.9 * halves);
    EXPECT_LT(dark.standardErrorDn, 0.5 * 1.2 * halves);
  }
  // The same levels in an order without a trend: the standard error of their mean.
  std::vector<double> mixed(16);
  for (std::size_t t = 0; t < 16; ++t)
  {
    mixed[t] = settling[t * 5 % 16];
  }
  const KnownOffset dark = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, 16, mixed));
  EXPECT_NEAR(dark.standardErrorDn, std::sqrt(dark.driftVarianceDn2 / 16.0), 0.05 * dark.standardErrorDn);
}

TEST(SensorNoiseDarkDrift, BlinkingPixelsAndMaskedOnesAreNoDrift)
{
  const DarkSensor          sensor = MakeDarkSensor(Pixels, 2.0, LogNormalNoise(0.0));
  Stack<unsigned short>     stack = DarkStackOf<unsigned short>(sensor, 10);
  std::vector<std::uint8_t> mask(Pixels, 1);
  for (std::size_t t = 0; t < 10; t += 3)
  {
    for (std::size_t p = 0; p < 20; ++p)
    {
      stack.pixels[t * Pixels + 200 * p] = 3000;
    }
    for (std::size_t p = 1000; p < 2000; ++p) // illumination by the camera itself
    {
      stack.pixels[t * Pixels + p] += 4;
      mask[p] = 0;
    }
  }
  const KnownOffset dark = MeasureDarkStack(stack, mask);
  EXPECT_LT(dark.driftVarianceDn2, 0.02);
  EXPECT_NEAR(dark.variance->valueDn2, 9.0 + 1.0 / 12.0, 4.0 * dark.variance->standardErrorDn2);
}

TEST(SensorNoiseDarkDrift, ChunksThreadsAndWhatIsNotFiniteChangeNoBit)
{
  const DarkSensor sensor = MakeDarkSensor(20000, 4.0, LogNormalNoise(0.3));
  Stack<float>     stack = DarkStackOf<float>(sensor, 9, DriftOf(9));
  stack.pixels[5] = std::numeric_limits<float>::quiet_NaN();
  stack.pixels[20003] = std::numeric_limits<float>::infinity();
  const KnownOffset expected = MeasureDarkStack(stack);
  EXPECT_NEAR(expected.variance->valueDn2, 9.0 * std::exp(0.18), 4.0 * expected.variance->standardErrorDn2);
  EXPECT_EQ(expected.maps->usable[5], 0);
  EXPECT_TRUE(std::isnan(expected.maps->offsetDn[3]));
  for (const std::size_t chunk : { 1u, 4u })
  {
    const KnownOffset found = MeasureDarkStack(stack, {}, Threads(3), chunk);
    EXPECT_TRUE(HaveSameBits(found.maps->varianceDn2, expected.maps->varianceDn2)) << chunk;
    EXPECT_EQ(found.variance->valueDn2, expected.variance->valueDn2);
    EXPECT_EQ(found.driftVarianceDn2, expected.driftVarianceDn2);
    EXPECT_EQ(found.readNoiseMedian->standardErrorDn, expected.readNoiseMedian->standardErrorDn);
  }
}
