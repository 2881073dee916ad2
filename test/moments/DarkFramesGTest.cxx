// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/DarkFrames.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "moments/TemporalMoments.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
/** Returns settings of dark frames of camera B. The dark offset is between two digital numbers. */
SimulationSettings
DarkSettings(std::size_t frames, double readNoiseDn = 8.0, std::uint64_t seed = 1)
{
  SimulationSettings settings;
  settings.camera = { 1e-9, 1.0, 100.3, readNoiseDn };
  settings.conditions = { 0.0, 0.0, 0.0 };
  settings.frames = frames;
  settings.seed = seed;
  return settings;
}

template <typename TPixel = unsigned short>
Stack<TPixel>
SimulateDark(const SimulationSettings & settings, std::size_t size = 64)
{
  return Simulate<TPixel>(settings, size, size, std::vector<double>(size * size, 1.0));
}

template <typename TPixel>
KnownOffset
Measure(const Stack<TPixel> &             stack,
        const DnSettings &                dnSettings = {},
        const std::vector<std::uint8_t> & mask = {},
        const ParallelFor &               parallelFor = SerialFor)
{
  const std::size_t       pixels = stack.width * stack.height;
  TemporalMoments<TPixel> moments(pixels);
  moments.AddFrames(stack.Frame(0), pixels, stack.frames, 0, pixels);
  moments.AdvanceFrames(stack.frames);
  return MeasureDarkFrames<TPixel>(std::move(moments), dnSettings, mask, parallelFor);
}

/** Expects that offset and variance deviate from the truth by at most 4 standard errors. */
void
ExpectTheTruth(const KnownOffset & dark, const SimulationSettings & settings, double roundingDn2 = 1.0 / 12.0)
{
  EXPECT_NEAR(dark.valueDn, settings.camera.offsetDn, 4.0 * dark.standardErrorDn);
  ASSERT_TRUE(dark.variance);
  const double readNoise = settings.camera.readNoiseDn;
  EXPECT_NEAR(dark.variance->valueDn2, readNoise * readNoise + roundingDn2, 4.0 * dark.variance->standardErrorDn2);
}

std::string
ErrorOf(const Stack<unsigned short> & stack, const std::vector<std::uint8_t> & mask = {})
{
  try
  {
    Measure(stack, {}, mask);
  }
  catch (const std::invalid_argument & error)
  {
    return error.what();
  }
  return "none";
}
} // namespace

TEST(SensorNoiseDarkFrames, MeanWithinIsThatOfTheValuesInside)
{
  const MeanOfPixels mean = MeanWithin({ 1.0, 2.0, 6.0, 100.0, -50.0 }, 1.0, 6.0);
  EXPECT_DOUBLE_EQ(mean.value, 3.0);
  EXPECT_DOUBLE_EQ(mean.standardError, std::sqrt((4.0 + 1.0 + 9.0) / 2.0 / 3.0));
}

TEST(SensorNoiseDarkFrames, OffsetAndVarianceAreRecoveredWithTheErrorsOfTemporalNoise)
{
  const SimulationSettings settings = DarkSettings(20);
  const KnownOffset        dark = Measure(SimulateDark(settings));
  ExpectTheTruth(dark, settings);
  EXPECT_EQ(dark.darkFrames, 20u);
  // sigma / sqrt(N T), and V sqrt(2 / (N (T - 1))). They are measured from 4096 pixels, within about 2 %.
  EXPECT_NEAR(dark.standardErrorDn, 8.0 / std::sqrt(4096.0 * 20.0), 0.1 * 0.028);
  EXPECT_NEAR(dark.variance->standardErrorDn2, 64.1 * std::sqrt(2.0 / 4096.0 / 19.0), 0.1 * 0.325);

  ExpectTheTruth(Measure(SimulateDark<double>(settings)), settings, 0.0);
}

// With z the error in standard errors, the mean of 40 z^2 has the standard deviation sqrt(2 / 40) = 0.22. 4 of these
// are allowed.
TEST(SensorNoiseDarkFrames, ErrorsAreAsLargeAsTheySay)
{
  for (const std::size_t frames : { 1u, 2u, 8u })
  {
    for (const double fixedPatternDn : { 0.0, 4.0 })
    {
      double offset = 0.0;
      double variance = 0.0;
      for (std::uint64_t seed = 1; seed <= 40; ++seed)
      {
        SimulationSettings settings = DarkSettings(frames, 8.0, seed);
        settings.dsnuSdDn = fixedPatternDn;
        const KnownOffset dark = Measure(SimulateDark(settings, 32));
        offset += std::pow((dark.valueDn - 100.3) / dark.standardErrorDn, 2) / 40.0;
        ASSERT_EQ(dark.variance.has_value(), frames > 1);
        if (dark.variance)
        {
          variance +=
            std::pow((dark.variance->valueDn2 - 64.0 - 1.0 / 12.0) / dark.variance->standardErrorDn2, 2) / 40.0;
        }
      }
      EXPECT_NEAR(offset, 1.0, 0.9) << frames << " frames, fixed pattern " << fixedPatternDn;
      EXPECT_NEAR(variance, frames > 1 ? 1.0 : 0.0, 0.9) << frames << " frames, fixed pattern " << fixedPatternDn;
    }
  }
}

TEST(SensorNoiseDarkFrames, HotNoisyAndDeadPixelsDoNotCarryThemOff)
{
  SimulationSettings settings = DarkSettings(20);
  settings.hotPixelFraction = 0.01;
  Stack<unsigned short> stack = SimulateDark(settings);
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    for (std::size_t p = 0; p < 30; ++p)
    {
      stack.pixels[t * 4096 + 101 * p] = static_cast<unsigned short>(300 + 40 * p); // hot
      stack.pixels[t * 4096 + 103 * p + 50] = 0;                                    // dead
    }
  }
  ExpectTheTruth(Measure(stack), settings);
}

TEST(SensorNoiseDarkFrames, RoundingThatHidesTheLevelIsInItsError)
{
  // Hardly any noise: a single frame contains the digital numbers 100 and 101 with a mean of about 100.16.
  const KnownOffset dark = Measure(SimulateDark(DarkSettings(1, 0.2)));
  EXPECT_NEAR(dark.valueDn, 100.3, 2.0 * dark.standardErrorDn);
  EXPECT_GT(dark.standardErrorDn, 0.1);
  // With noise of one step the rounding has no bias: the variance is sigma^2 + 1/12, over 4096 pixels.
  EXPECT_NEAR(Measure(SimulateDark(DarkSettings(1, 1.0))).standardErrorDn, std::sqrt(13.0 / 12.0 / 4096.0), 0.001);
}

TEST(SensorNoiseDarkFrames, MaskedPixelsTakeNoPart)
{
  const SimulationSettings  settings = DarkSettings(6);
  Stack<unsigned short>     stack = SimulateDark(settings);
  std::vector<std::uint8_t> mask(4096, 1);
  for (std::size_t p = 0; p < 2048; ++p)
  {
    mask[2 * p] = 0;
    for (std::size_t t = 0; t < 6; ++t)
    {
      stack.pixels[t * 4096 + 2 * p] = 0;
    }
  }
  ExpectTheTruth(Measure(stack, {}, mask), settings);
  EXPECT_EQ(ErrorOf(stack).rfind("50 % of the pixels of the dark frames reach a clip level, 0 or ", 0), 0U)
    << ErrorOf(stack);
  EXPECT_EQ(ErrorOf(stack).find("000000"), std::string::npos) << ErrorOf(stack);
  std::fill(mask.begin(), mask.end() - 29, std::uint8_t{ 0 });
  EXPECT_NE(ErrorOf(stack, mask).find("pixels of the dark frames are usable; expected at least 30"), std::string::npos);
}

TEST(SensorNoiseDarkFrames, BlackLevelThatIsCutOffIsRefused)
{
  SimulationSettings settings = DarkSettings(10);
  settings.camera.offsetDn = 12.0; // 7 % of the samples would be below 0
  EXPECT_NE(ErrorOf(SimulateDark(settings)).find("their black level is cut off"), std::string::npos);
  settings.camera.offsetDn = 40.0;
  EXPECT_EQ(ErrorOf(SimulateDark(settings)), "none");
}

TEST(SensorNoiseDarkFrames, NaNIsPassedOverAndThreadsChangeNothing)
{
  const SimulationSettings settings = DarkSettings(6);
  Stack<float>             stack = SimulateDark<float>(settings);
  for (std::size_t p = 0; p < 1000; ++p)
  {
    stack.pixels[4096 * (p % 6) + 3 * p] = std::numeric_limits<float>::quiet_NaN();
  }
  const KnownOffset dark = Measure(stack);
  ExpectTheTruth(dark, settings, 0.0);
  const KnownOffset threaded = Measure(stack, {}, {}, Threads(3));
  EXPECT_EQ(dark.valueDn, threaded.valueDn);
  EXPECT_EQ(dark.variance->valueDn2, threaded.variance->valueDn2);
}
