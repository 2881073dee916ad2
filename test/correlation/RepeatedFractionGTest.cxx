// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/FrameSample.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t   Side = 96;
constexpr std::size_t   Frames = 20;
constexpr FrameGeometry Geometry{ Side, Side, 1 };

/** Returns the fraction of repeated values in frames of noise of the standard deviation \a sd, in quantization steps.
 * Each value is blended with the previous value of its pixel, or repeats it with a probability. */
double
FractionOf(double sd, double blend, double probability, double step = 1.0)
{
  std::mt19937                random(4);
  std::normal_distribution<>  noise(0.0, sd);
  std::bernoulli_distribution isRepeated(probability);
  const std::size_t           pixels = Side * Side;
  std::vector<double>         level(pixels, 100.0);
  std::vector<std::uint16_t>  greyValues(Frames * pixels);
  for (std::size_t i = 0; i < greyValues.size(); ++i)
  {
    double & own = level[i % pixels];
    own = blend * own + (1.0 - blend) * (100.0 + noise(random));
    const bool repeats = i >= pixels && isRepeated(random);
    greyValues[i] = repeats ? greyValues[i - pixels] : static_cast<std::uint16_t>(step * std::round(own));
  }
  const std::vector<double> mean(pixels, 100.0 * step);
  FrameSample               sample = FrameSample::Of<unsigned short>(Geometry, Frames);
  sample.AddFrames(greyValues.data(), 0, Frames, mean);
  return sample.RepeatedFraction(std::vector<std::uint8_t>(pixels, 1), step);
}
} // namespace

TEST(SensorNoiseRepeatedFraction, NoiseAndFiltersHaveNone)
{
  for (const double sd : { 0.7, 1.5, 10.0, 20.0 })
  {
    for (const double blend : { 0.0, 0.6 })
    {
      EXPECT_LT(FractionOf(sd, blend, 0.0), 0.01) << sd << ' ' << blend;
    }
  }
  EXPECT_LT(FractionOf(10.0, 0.0, 0.0, 16.0), 0.01);
}

TEST(SensorNoiseRepeatedFraction, RepeatedValuesAreCounted)
{
  for (const double probability : { 0.1, 0.5 })
  {
    for (const double step : { 1.0, 16.0 })
    {
      EXPECT_NEAR(FractionOf(10.0, 0.0, probability, step), probability, 0.02) << step;
    }
  }
}
