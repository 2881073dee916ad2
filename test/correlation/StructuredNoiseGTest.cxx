// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Settings.h"
#include "simulation/Random.h"
#include "helpers/DarkPixelsTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

// The noise that the pixels of dark frames have in common: of whole rows, of whole columns and of waves, in frames of 3
// DN of white noise whose common level drifts.

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 160;
constexpr std::size_t Height = 128;

struct SharedNoise
{
  double rowsDn{ 0.0 };
  double columnsDn{ 0.0 };
  double waveDn{ 0.0 }; ///< rms
  double cyclesPerColumn{ 0.173 };
  double cyclesPerRow{ 0.091 };
};

template <typename TPixel = unsigned short>
Stack<TPixel>
DarkStack(const SharedNoise & noise, std::size_t frames, std::size_t width = Width, std::size_t height = Height)
{
  Stack<TPixel> stack{ width, height, frames, std::vector<TPixel>(width * height * frames) };
  const double  cycle = 2.0 * std::acos(-1.0);
  for (std::size_t t = 0; t < frames; ++t)
  {
    CounterSeededRandom random(3, 8, t);
    const double        driftDn = 4.0 * random.Normal();
    const double        phase = cycle * 0.6180339887 * static_cast<double>(t); // the mean of the waves is near 0
    std::vector<double> rows(height);
    std::vector<double> columns(width);
    for (double & value : rows)
    {
      value = noise.rowsDn * random.Normal();
    }
    for (double & value : columns)
    {
      value = noise.columnsDn * random.Normal();
    }
    for (std::size_t p = 0; p < width * height; ++p)
    {
      const std::size_t x = p % width;
      const std::size_t y = p / width;
      const double      cycles =
        noise.cyclesPerColumn * static_cast<double>(x) + noise.cyclesPerRow * static_cast<double>(y);
      const double wave = std::sqrt(2.0) * noise.waveDn * std::sin(cycle * cycles + phase);
      const double value = 200.0 + 3.0 * random.Normal() + driftDn + rows[y] + columns[x] + wave;
      stack.pixels[t * width * height + p] = static_cast<TPixel>(std::lround(value));
    }
  }
  return stack;
}

void
ExpectVariance(const std::optional<StructuredNoise> & found, double expectedDn2, double largestErrorDn2)
{
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->variance.valueDn2, expectedDn2, 4.0 * found->variance.standardErrorDn2);
  EXPECT_GT(found->variance.standardErrorDn2, 0.0);
  EXPECT_LT(found->variance.standardErrorDn2, largestErrorDn2);
}
} // namespace

/** Sample variance of a wave of 2 DN rms over 20 frames, in which its mean is near 0 [DN^2]. */
constexpr double WaveDn2 = 4.0 * 20.0 / 19.0;

TEST(SensorNoiseStructuredNoise, WhiteNoiseHasNone)
{
  const KnownOffset dark = MeasureDarkStack(DarkStack({}, 20));
  ExpectVariance(dark.structured, 0.0, 0.02);
  EXPECT_TRUE(dark.structured->waves.empty());
}

TEST(SensorNoiseStructuredNoise, RowsAndColumnsAreAdded)
{
  const KnownOffset dark = MeasureDarkStack(DarkStack({ 1.5, 1.0, 0.0 }, 40));
  // The scatter of 40 x 128 rows and 40 x 160 columns: 0.045 and 0.018 DN^2.
  ExpectVariance(dark.structured, 1.5 * 1.5 + 1.0, 0.2);
  EXPECT_NEAR(dark.variance->valueDn2, 9.0 + 1.0 / 12.0 + 1.5 * 1.5 + 1.0, 0.25);
}

TEST(SensorNoiseStructuredNoise, WavesAreNamedByTheirFrequency)
{
  const KnownOffset dark = MeasureDarkStack(DarkStack({ 0.0, 0.0, 2.0 }, 20));
  ExpectVariance(dark.structured, WaveDn2, 0.1);
  ASSERT_EQ(dark.structured->waves.size(), 1U);
  EXPECT_NEAR(std::abs(dark.structured->waves.front().cyclesPerColumn), 0.173, 5e-4);
  EXPECT_NEAR(std::abs(dark.structured->waves.front().cyclesPerRow), 0.091, 5e-4);
}

// Twelve and a half periods of bars move the level of a frame. As a temporal component the level would take one of two
// phases: half of their variance.
TEST(SensorNoiseStructuredNoise, TheLevelOfTheFramesTakesNothingOfAWave)
{
  SharedNoise bars{ 0.0, 0.0, 2.0, 0.0, 12.5 / Height };
  ExpectVariance(MeasureDarkStack(DarkStack(bars, 20)).structured, WaveDn2, 0.1);
  // Longer than a tile: distant pixels of a column are opposite.
  bars.cyclesPerRow = 3.0 / Height;
  ExpectVariance(MeasureDarkStack(DarkStack(bars, 20)).structured, WaveDn2, 0.5);
}

TEST(SensorNoiseStructuredNoise, FewFramesAndSmallFramesAreNotMeasured)
{
  EXPECT_FALSE(MeasureDarkStack(DarkStack({ 1.5, 1.0, 0.0 }, 2)).structured);
  EXPECT_FALSE(MeasureDarkStack(DarkStack({ 1.5, 1.0, 0.0 }, 20, 12, 12)).structured);
}

TEST(SensorNoiseStructuredNoise, SameBitsForAnyNumberOfThreadsAndChunks)
{
  const Stack<unsigned short> stack = DarkStack({ 1.0, 0.5, 1.0 }, 80); // more frames than are sampled
  const KnownOffset           one = MeasureDarkStack(stack);
  const KnownOffset           three = MeasureDarkStack(stack, {}, Threads(3), 7);
  ASSERT_TRUE(one.structured);
  ASSERT_TRUE(three.structured);
  EXPECT_EQ(one.structured->variance.valueDn2, three.structured->variance.valueDn2);
  EXPECT_EQ(one.structured->variance.standardErrorDn2, three.structured->variance.standardErrorDn2);
}

TEST(SensorNoiseStructuredNoise, FloatingPointFramesGiveTheSame)
{
  const SharedNoise noise{ 1.0, 0.5, 1.0 };
  const KnownOffset whole = MeasureDarkStack(DarkStack(noise, 20));
  const KnownOffset real = MeasureDarkStack(DarkStack<float>(noise, 20));
  ASSERT_TRUE(whole.structured);
  ASSERT_TRUE(real.structured);
  EXPECT_NEAR(real.structured->variance.valueDn2, whole.structured->variance.valueDn2, 1e-3);
}
