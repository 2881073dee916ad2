// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/FixedPatternEstimate.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceLine.h"
#include "helpers/PatternTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::pattern;

namespace
{
/** Returns a line without slope through levels of equal weight. Its value is the mean variance. */
VarianceLine
LineOf(const Maps & maps)
{
  VarianceLine line;
  double       sum = 0.0;
  double       squares = 0.0;
  double       variance = 0.0;
  double       pixels = 0.0;
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    if (maps.frame.usable[p] != 0)
    {
      pixels += 1.0;
      sum += maps.frame.mean[p];
      squares += maps.frame.mean[p] * maps.frame.mean[p];
      variance += maps.variance[p];
    }
  }
  line.pivotDn = sum / pixels;
  line.weightSum = pixels;
  line.spreadDn2 = squares - sum * line.pivotDn;
  line.intercept = variance / pixels;
  return line;
}

FixedPatternEstimate
PatternOf(const Maps & maps, const ParallelFor & parallelFor = SerialFor)
{
  return EstimateFixedPattern(maps.frame, maps.Data(), LineOf(maps), BlackDn, parallelFor);
}

/** Returns the fraction of a PRNU pattern by its definition: its variance times the mean squared signal, over the
 * variance of the levels. */
double
GainFraction(const FixedPatternEstimate & pattern, const Maps & maps, double sd)
{
  const double fluxDn = LineOf(maps).pivotDn - BlackDn;
  return sd * sd * (fluxDn * fluxDn + pattern.levelVarianceDn2) / pattern.levelVarianceDn2;
}

/** Relative standard error of the pattern [1]. It is measured from half of the pixels of the 12 flattest of 256 tiles:
 * 1,536 pixels give sqrt(2 / 1536) = 3.6 %, and common neighbours slightly more. One standard error is added to the
 * value. */
constexpr double PatternError = 0.04;

/** Returns normal numbers, one per pixel. */
std::vector<double>
NormalMap()
{
  std::mt19937               random(77);
  std::normal_distribution<> normal;
  std::vector<double>        map(Pixels);
  for (double & value : map)
  {
    value = normal(random);
  }
  return map;
}
} // namespace

TEST(SensorNoiseFixedPatternEstimate, WhiteGainPatternHasItsFraction)
{
  const std::vector<double> normal = NormalMap();
  for (const double sd : { 0.005, 0.01 })
  {
    const Maps maps([&](std::size_t x, std::size_t y) { return Pixel{ Ramp(y), 1.0 + sd * normal[y * Size + x] }; });
    const FixedPatternEstimate pattern = PatternOf(maps);
    // The levels are uniformly distributed over 100 DN, with some noise.
    EXPECT_NEAR(pattern.levelVarianceDn2 / (1e4 / 12.0), 1.0, 0.05);
    EXPECT_NEAR(pattern.gainFraction / GainFraction(pattern, maps, sd), 1.0 + PatternError, 5.0 * PatternError) << sd;
  }
}

TEST(SensorNoiseFixedPatternEstimate, WhiteOffsetPatternHasItsFraction)
{
  const std::vector<double> normal = NormalMap();
  const Maps                maps(
    [&](std::size_t x, std::size_t y) { return Pixel{ Ramp(y), 1.0, 1.0, 12.0 * normal[y * Size + x] }; });
  const FixedPatternEstimate pattern = PatternOf(maps);
  EXPECT_NEAR(pattern.OffsetVarianceDn2() / 144.0, 1.0 + PatternError, 5.0 * PatternError);
  EXPECT_NEAR(pattern.offsetFraction, pattern.OffsetVarianceDn2() / pattern.levelVarianceDn2, 1e-12);
  EXPECT_EQ(pattern.LargestFraction(), std::max(pattern.gainFraction, pattern.offsetFraction));
}

TEST(SensorNoiseFixedPatternEstimate, NoiseOfTheMeansIsNoPattern)
{
  const Maps                 maps([](std::size_t, std::size_t y) { return Pixel{ Ramp(y) }; }, FewFrames);
  const FixedPatternEstimate pattern = PatternOf(maps);
  // The rest is the error of the variance of the noise: one standard error, and the added one.
  const double noiseDn2 = LineOf(maps).intercept / static_cast<double>(FewFrames);
  EXPECT_GT(pattern.OffsetVarianceDn2(), 0.0);
  EXPECT_LT(pattern.OffsetVarianceDn2(), 6.0 * PatternError * noiseDn2);
  EXPECT_NEAR(pattern.levelVarianceDn2 / (1e4 / 12.0), 1.0, 0.03);
}

TEST(SensorNoiseFixedPatternEstimate, SceneThatIsRoughEverywhereCountsAsTheLargestPatternOfASensor)
{
  const std::vector<double> normal = NormalMap();
  const Maps maps([&](std::size_t x, std::size_t y) { return Pixel{ 4000.0 * (1.0 + 0.2 * normal[y * Size + x]) }; });
  const FixedPatternEstimate pattern = PatternOf(maps);
  EXPECT_NEAR(pattern.gainFraction, GainFraction(pattern, maps, 0.03), 1e-9 * pattern.gainFraction);
  // The limit is five times the noise, which has the same variance at all pixels.
  EXPECT_NEAR(pattern.OffsetVarianceDn2(), 25.0 * LineOf(maps).intercept, 1e-9 * pattern.OffsetVarianceDn2());
}

TEST(SensorNoiseFixedPatternEstimate, TextureAboutAFlatPlaceIsNoPattern)
{
  // A rough scene with a flat quarter: the pattern of the flat part is measured.
  const std::vector<double>  normal = NormalMap();
  const Maps                 maps([&](std::size_t x, std::size_t y) {
    const bool isFlat = x < Size / 2 && y < Size / 2;
    return Pixel{ 300.0 * (isFlat ? 1.0 : 1.0 + 0.1 * normal[Pixels - 1 - y * Size - x]),
                  1.0 + 0.01 * normal[y * Size + x] };
  });
  const FixedPatternEstimate pattern = PatternOf(maps);
  EXPECT_NEAR(pattern.gainFraction / GainFraction(pattern, maps, 0.01), 1.0 + PatternError, 5.0 * PatternError);
}

/** Returns FractionOfSensorSteps() of maps. */
double
StepsOf(const Maps & maps)
{
  const FixedPatternEstimate pattern = PatternOf(maps);
  return FractionOfSensorSteps(
    maps.Data(), maps.frame.geometry, LineOf(maps), BlackDn, pattern.levelVarianceDn2, SerialFor);
}

// An amplifier for each half: all that differs is their gain.
TEST(SensorNoiseFixedPatternEstimate, StepBetweenTwoColumnsIsOfTheSensor)
{
  for (const double step : { -0.03, 0.02, 0.2 })
  {
    const Maps maps([step](std::size_t x, std::size_t) { return Pixel{ 4000.0, x < Size / 2 ? 1.0 : 1.0 + step }; });
    EXPECT_NEAR(StepsOf(maps), step < 0.1 ? 1.0 : 0.0, 0.1) << step; // a step of 20 % is of the scene
  }
}

// An edge of the scene is wider than a pixel, or has others beside it.
TEST(SensorNoiseFixedPatternEstimate, EdgesOfTheSceneAreNoStepsOfTheSensor)
{
  const Maps soft([](std::size_t x, std::size_t) {
    return Pixel{ x + 1 < Size / 2 ? 4000.0 : x < Size / 2 + 1 ? 4060.0 : 4120.0 };
  });
  const Maps bars([](std::size_t x, std::size_t) { return Pixel{ x / 32 % 2 == 0 ? 4000.0 : 4120.0 }; });
  EXPECT_EQ(StepsOf(soft), 0.0);
  EXPECT_EQ(StepsOf(bars), 0.0);
}

TEST(SensorNoiseFixedPatternEstimate, WithoutLevelsEverythingCouldBePattern)
{
  const Maps maps([](std::size_t, std::size_t) { return Pixel{ 100.0 }; });
  EXPECT_EQ(PatternOf(maps).gainFraction, std::numeric_limits<double>::infinity());
  EXPECT_EQ(PatternOf(maps).OffsetVarianceDn2(), 0.0);
  Maps few([](std::size_t, std::size_t y) { return Pixel{ Ramp(y) }; });
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    few.frame.usable[p] = p % 9 == 0 ? few.frame.usable[p] : 0; // 28 pixels per tile: fewer than 32 in half of it
  }
  EXPECT_EQ(PatternOf(few).offsetFraction, std::numeric_limits<double>::infinity());
}

TEST(SensorNoiseFixedPatternEstimate, DiagonalNeighboursHaveNoRowOrColumnInCommon)
{
  std::vector<double> mean(49, 0.0);
  for (std::size_t i = 0; i < 7; ++i)
  {
    mean[3 * 7 + i] = mean[i * 7 + 3] = 1e6; // row and column of the central pixel
  }
  EXPECT_EQ(DiagonalMean(mean.data(), 7, 24), 0.0);
  for (std::size_t p = 0; p < 49; ++p)
  {
    mean[p] = 2.0 * static_cast<double>(p % 7) - 3.0 * static_cast<double>(p / 7); // a plane
  }
  EXPECT_EQ(DiagonalMean(mean.data(), 7, 24), mean[24]);
}

TEST(SensorNoiseFixedPatternEstimate, ThreadsChangeNoBit)
{
  const std::vector<double> normal = NormalMap();
  const Maps maps([&](std::size_t x, std::size_t y) { return Pixel{ Ramp(y), 1.0 + 0.01 * normal[y * Size + x] }; });
  const FixedPatternEstimate expected = PatternOf(maps);
  const FixedPatternEstimate pattern = PatternOf(maps, test::Threads(3));
  EXPECT_EQ(pattern.gainFraction, expected.gainFraction);
  EXPECT_EQ(pattern.offsetFraction, expected.offsetFraction);
}
