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

namespace
{
/** Returns the sample of frames of noise of the standard deviation \a sd, in quantization steps. Row y of frame t
 * equals the row before it where isCopy(t, y). */
template <typename TIsCopy>
FrameSample
SampleWithCopies(double sd, TIsCopy isCopy)
{
  std::mt19937               random(5);
  std::normal_distribution<> noise(0.0, sd);
  std::vector<std::uint16_t> greyValues(Frames * Side * Side);
  for (std::size_t i = 0; i < greyValues.size(); ++i)
  {
    const std::size_t t = i / (Side * Side);
    const std::size_t y = i / Side % Side;
    const auto        own = static_cast<std::uint16_t>(std::round(100.0 + noise(random)));
    greyValues[i] = y > 0 && isCopy(t, y) ? greyValues[i - Side] : own;
  }
  FrameSample sample = FrameSample::Of<unsigned short>(Geometry, Frames);
  sample.AddFrames(greyValues.data(), 0, Frames, {});
  return sample;
}
} // namespace

TEST(SensorNoiseCopiedFraction, RowsThatEqualTheRowBeforeInSingleFramesAreCounted)
{
  const std::vector<std::uint8_t> all(Side * Side, 1);
  // One row in 20 of each frame, elsewhere in each frame.
  const FrameSample single = SampleWithCopies(3.0, [](std::size_t t, std::size_t y) { return (y + 7 * t) % 20 == 3; });
  EXPECT_NEAR(single.CopiedFraction(all, LineAxis::Rows), 0.05, 0.01);
  EXPECT_EQ(single.CopiedFraction(all, LineAxis::Columns), 0.0);
  EXPECT_EQ(single.CopiedFraction(std::vector<std::uint8_t>(Side * Side, 0), LineAxis::Rows), 0.0);
}

TEST(SensorNoiseCopiedFraction, NoiseAndRowsThatAreAlwaysCopiesHaveNone)
{
  const std::vector<std::uint8_t> all(Side * Side, 1);
  const FrameSample               noise = SampleWithCopies(0.5, [](std::size_t, std::size_t) { return false; });
  EXPECT_LT(noise.CopiedFraction(all, LineAxis::Rows), 0.0005);
  const FrameSample hidden = SampleWithCopies(0.1, [](std::size_t, std::size_t) { return false; });
  EXPECT_EQ(hidden.CopiedFraction(all, LineAxis::Rows), 0.0);
  const FrameSample dead = SampleWithCopies(3.0, [](std::size_t, std::size_t y) { return y % 20 == 3; });
  EXPECT_EQ(dead.CopiedFraction(all, LineAxis::Rows), 0.0);
}

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
