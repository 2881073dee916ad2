// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/ChiSquare.h"
#include "sensornoise/Settings.h"
#include "helpers/DarkPixelsTestHelper.h"
#include "moments/DarkFrames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
double
MeanSquareOf(const std::vector<double> & values)
{
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / static_cast<double>(values.size());
}
} // namespace

TEST(SensorNoiseDarkPixels, TheDefectiveVarianceIsThatOfEightTimesTheTypicalNoise)
{
  // The median of chi-square with 7 degrees of freedom is 6.3458, tabulated.
  EXPECT_NEAR(MedianToMeanOfVariance(7.0), 6.3458 / 7.0, 1e-5);
  EXPECT_NEAR(DefectiveVarianceDn2(4.0 * MedianToMeanOfVariance(7.0), 7.0), 64.0 * 4.0 * 9.0 / 7.0, 1e-9);
}

// The read noise of the pixels is drawn once, and the truth is the mean over these pixels.
TEST(SensorNoiseDarkPixels, TheVarianceHoldsTheTail)
{
  for (const double spread : { 0.3, 0.5 })
  {
    const DarkSensor sensor = MakeDarkSensor(20000, 4.0, LogNormalNoise(spread, 0.05));
    for (const std::size_t frames : { 2u, 4u, 8u, 50u })
    {
      const KnownOffset dark = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, frames));
      // The pixels that are left out exceed 8 times the median.
      std::vector<double> kept = sensor.readNoiseDn;
      kept.erase(std::remove_if(kept.begin(), kept.end(), [](double noise) { return noise > 24.0; }), kept.end());
      EXPECT_NEAR(dark.variance->valueDn2, MeanSquareOf(kept) + 1.0 / 12.0, 3.0 * dark.variance->standardErrorDn2)
        << spread << ", " << frames;
      const double rms = std::sqrt(dark.variance->valueDn2);
      ASSERT_EQ(dark.readNoiseMedian.has_value(), frames > 5);
      if (dark.readNoiseMedian)
      {
        const double median = MedianOfPixels(sensor.readNoiseDn);
        EXPECT_NEAR(dark.readNoiseMedian->valueDn / median, 1.0, 0.03) << spread << ", " << frames;
        EXPECT_LT(dark.readNoiseMedian->valueDn, rms);
      }
    }
  }
}

// With z the error in standard errors, the mean of 40 z^2 has the standard deviation 0.22. Each run has a new sensor.
TEST(SensorNoiseDarkPixels, ErrorsHoldTheDifferencesOfThePixels)
{
  double offset = 0.0;
  double variance = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    const DarkSensor  sensor = MakeDarkSensor(4096, 4.0, LogNormalNoise(0.4), seed);
    const KnownOffset dark = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, 8, {}, seed));
    const double      expected = 9.0 * std::exp(2.0 * 0.16) + 1.0 / 12.0;
    offset += std::pow((dark.valueDn - 100.3) / dark.standardErrorDn, 2) / 40.0;
    variance += std::pow((dark.variance->valueDn2 - expected) / dark.variance->standardErrorDn2, 2) / 40.0;
  }
  EXPECT_NEAR(offset, 1.0, 0.9);
  EXPECT_NEAR(variance, 1.0, 0.9);
}

TEST(SensorNoiseDarkPixels, DefectivePixelsAreCountedAndLeftOut)
{
  DarkSensor sensor = MakeDarkSensor(20000, 4.0, [](CounterSeededRandom &) { return 3.0; });
  for (std::size_t p = 0; p < 100; ++p)
  {
    sensor.readNoiseDn[200 * p] = 60.0; // 20 times the noise of the others, at an offset at which it is not clipped
    sensor.offsetDn[200 * p] = 500.0;
    sensor.readNoiseDn[200 * p + 50] = 0.0; // stuck
  }
  const KnownOffset dark = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, 20));
  EXPECT_EQ(dark.numberDefective, 200u);
  EXPECT_NEAR(dark.variance->valueDn2, 9.0 + 1.0 / 12.0, 4.0 * dark.variance->standardErrorDn2);
  EXPECT_EQ(dark.maps->usable[0] + dark.maps->usable[50], 0);
  EXPECT_EQ(dark.maps->usable[1], 1);
  EXPECT_GT(dark.maps->varianceDn2[0], 900.0) << "what they are is told all the same";
  EXPECT_EQ(dark.maps->frames, 20u);
  EXPECT_EQ(dark.maps->stepDn, 1.0);

  // Two frames do not distinguish stuck pixels: every seventh pixel has the same value in both.
  const KnownOffset two = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, 2));
  EXPECT_LE(two.numberDefective, 100u);
}

// A cosmic ray is in one frame. Its charge adds the variance 2 a^2 per hit, 18 DN^2 on average here, twice the noise.
TEST(SensorNoiseDarkPixels, ValuesOfCosmicRaysAreLeftOut)
{
  constexpr double      chance = 0.001;
  constexpr double      meanDn = 100.0;
  const DarkSensor      sensor = MakeDarkSensor(20000, 4.0, LogNormalNoise(0.3));
  Stack<unsigned short> stack = DarkStackOf<unsigned short>(sensor, 16);
  const KnownOffset     without = MeasureDarkStack(stack);
  CounterSeededRandom   random(3);
  std::size_t           hits = 0;
  for (unsigned short & value : stack.pixels)
  {
    if (random.Uniform() < chance)
    {
      value = static_cast<unsigned short>(value - meanDn * std::log(1.0 - random.Uniform()));
      ++hits;
    }
  }
  const KnownOffset dark = MeasureDarkStack(stack);
  EXPECT_LT(without.numberDefective, 3U); // 0.2 are expected by chance
  EXPECT_GT(dark.numberDefective, hits / 2);
  EXPECT_LT(dark.numberDefective, hits);
  EXPECT_NEAR(dark.valueDn, without.valueDn, without.standardErrorDn);
  EXPECT_NEAR(dark.variance->valueDn2, without.variance->valueDn2, 0.02 * without.variance->valueDn2);
}

TEST(SensorNoiseDarkPixels, AFrameOfAnotherLevelIsNoSpikeOfItsPixels)
{
  const DarkSensor    sensor = MakeDarkSensor(20000, 4.0, LogNormalNoise(0.3));
  std::vector<double> drift(16, 0.0);
  drift[5] = 200.0;
  EXPECT_EQ(MeasureDarkStack(DarkStackOf<unsigned short>(sensor, 16, drift)).numberDefective, 0U);
}

TEST(SensorNoiseDarkPixels, OneFrameHasNoMapsAndNoVariance)
{
  const DarkSensor  sensor = MakeDarkSensor(4096, 4.0, LogNormalNoise(0.3));
  const KnownOffset dark = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, 1));
  EXPECT_FALSE(dark.maps || dark.variance || dark.readNoiseMedian);
  EXPECT_EQ(dark.numberDefective, 0u);
  EXPECT_NEAR(dark.valueDn, 100.3, 4.0 * dark.standardErrorDn);
}

TEST(SensorNoiseDarkPixels, NoiseBelowTheQuantizationStepIsNoReasonToCallPixelsDefective)
{
  const DarkSensor  sensor = MakeDarkSensor(4096, 0.3, [](CounterSeededRandom &) { return 0.1; });
  const KnownOffset dark = MeasureDarkStack(DarkStackOf<unsigned short>(sensor, 20));
  EXPECT_EQ(dark.numberDefective, 0u);
  EXPECT_FALSE(dark.readNoiseMedian);
}

TEST(SensorNoiseDarkPixels, RepeatedFramesCountOnce)
{
  const DarkSensor            sensor = MakeDarkSensor(4000, 4.0, LogNormalNoise(0.3));
  const Stack<unsigned short> once = DarkStackOf<unsigned short>(sensor, 4);
  Stack<unsigned short>       repeated = once;
  for (int k = 0; k < 3; ++k)
  {
    repeated.frames += once.frames;
    repeated.pixels.insert(repeated.pixels.end(), once.pixels.begin(), once.pixels.end());
  }
  const KnownOffset expected = MeasureDarkStack(once);
  for (const std::size_t chunk : { 1U, 3U, 6U, 1000U })
  {
    const KnownOffset dark = MeasureDarkStack(repeated, {}, SerialFor, chunk);
    EXPECT_EQ(dark.darkFrames, 4U) << chunk;
    EXPECT_EQ(dark.valueDn, expected.valueDn) << chunk;
    ASSERT_TRUE(dark.variance) << chunk;
    EXPECT_EQ(dark.variance->valueDn2, expected.variance->valueDn2) << chunk;
    EXPECT_EQ(dark.variance->standardErrorDn2, expected.variance->standardErrorDn2) << chunk;
  }
}

TEST(SensorNoiseDarkPixels, FramesThatAreAllEqualAreOne)
{
  const Stack<unsigned short> equal{ 400, 1, 3, std::vector<unsigned short>(1200, 64) };
  const KnownOffset           dark = MeasureDarkStack(equal);
  EXPECT_EQ(dark.darkFrames, 1U);
  EXPECT_EQ(dark.valueDn, 64.0);
  EXPECT_FALSE(dark.variance);
}
