// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/RefinedTestHelper.h"
#include "simulation/Random.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

/** \file
 * Scenes that are mostly dark: the flat pixels, to which the first line is fitted, have no signal. */

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
using GreyValue = unsigned short;

constexpr std::size_t Width = 160;
constexpr std::size_t Height = 128;

/** Returns a disc, darker towards its limb, at a place of the frame [pixel], over a background of a fraction of the
 * maximum. */
std::vector<double>
Disc(double radius, double left, double floor)
{
  std::vector<double> scene(Width * Height);
  for (std::size_t p = 0; p < scene.size(); ++p)
  {
    const double x = static_cast<double>(p % Width) - left;
    const double y = static_cast<double>(p / Width) - 0.5 * Height;
    const double inside = 1.0 - (x * x + y * y) / (radius * radius);
    scene[p] = floor + (1.0 - floor) * std::sqrt(std::max(0.0, inside));
  }
  return scene;
}

SimulationSettings
DarkSettings(double flicker)
{
  SimulationSettings settings;
  settings.camera = { 4000.0, 0.5, 100.0, 3.0 };
  settings.conditions = { flicker, 0.0, 0.0 };
  settings.prnuSd = 0.007;
  settings.dsnuSdDn = 1.0;
  settings.frames = 40;
  settings.seed = 3;
  return settings;
}
} // namespace

TEST(SensorNoiseDarkScene, ItsBrightPixelsDetermineTheGain)
{
  for (const double radius : { 18.0, 30.0 }) // 5 and 14 % of the frame
  {
    for (const double floor : { 0.0, 0.05 })
    {
      for (const double flicker : { 0.01, 0.0 })
      {
        const auto stack = Simulate<GreyValue>(DarkSettings(flicker), Width, Height, Disc(radius, 80.0, floor));
        const auto method = Measure(stack);
        const auto gain = method.GetReport().gain;
        ASSERT_EQ(gain.status, EstimateStatus::Identified) << radius << ' ' << floor << ' ' << flicker;
        // 4 standard errors: exceeded once in 16,000 by chance.
        EXPECT_NEAR(*gain.value, 0.5, 4.0 * *gain.standardError) << radius << ' ' << floor << ' ' << flicker;
        EXPECT_LT(*gain.standardError, 0.05 * 0.5) << radius << ' ' << floor << ' ' << flicker;
      }
    }
  }
}

TEST(SensorNoiseDarkScene, FixedPatternOfTheDarkPixelsIsNoSignal)
{
  // A pattern of half the read noise and of all of it: among the dark pixels, levels differ without signal.
  for (const double dsnu : { 1.5, 3.0 })
  {
    for (const double radius : { 14.0, 30.0 }) // 3 and 14 % of the frame
    {
      SimulationSettings settings = DarkSettings(0.0);
      settings.dsnuSdDn = dsnu;
      const auto method = Measure(Simulate<GreyValue>(settings, Width, Height, Disc(radius, 80.0, 0.0)));
      const auto gain = method.GetReport().gain;
      ASSERT_EQ(gain.status, EstimateStatus::Identified) << radius << ' ' << dsnu;
      EXPECT_NEAR(*gain.value, 0.5, 4.0 * *gain.standardError) << radius << ' ' << dsnu;
    }
  }
}

TEST(SensorNoiseDarkScene, AMovingThingInFrontOfADarkGroundIsNoSignal)
{
  // The disc moves by half its radius over the burst: no line fits the variance against the level.
  const SimulationSettings settings = DarkSettings(0.01);
  Stack<GreyValue>         stack{ Width, Height, settings.frames, {} };
  for (std::size_t t = 0; t < settings.frames; ++t)
  {
    SimulationSettings one = settings;
    one.seed = 100 + t;
    one.frames = 1;
    one.prnuSd = one.dsnuSdDn = 0.0; // these patterns depend on the seed
    const auto place = 72.0 + 16.0 * static_cast<double>(t) / static_cast<double>(settings.frames);
    const auto frame = Simulate<GreyValue>(one, Width, Height, Disc(30.0, place, 0.02));
    stack.pixels.insert(stack.pixels.end(), frame.pixels.begin(), frame.pixels.end());
  }
  const auto method = Measure(stack);
  const auto gain = method.GetReport().gain;
  if (gain.status == EstimateStatus::Identified)
  {
    EXPECT_NEAR(*gain.value, 0.5, 4.0 * *gain.standardError);
  }
}

TEST(SensorNoiseDarkScene, TelegraphNoiseOfTheDarkPixelsIsNoSignal)
{
  // Stars above a read noise of 22 electrons. Every fiftieth pixel jumps between two levels: it is both brighter and
  // noisier, and its neighbours are not.
  std::size_t identified = 0;
  for (const std::uint32_t seed : { 1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U })
  {
    CounterSeededRandom random(11, seed, 0);
    std::vector<double> scene(Width * Height, 0.001);
    for (int star = 0; star < 40; ++star)
    {
      const double x = 5.0 + 150.0 * random.Uniform();
      const double y = 5.0 + 118.0 * random.Uniform();
      const double height = 0.1 + 0.9 * random.Uniform();
      for (std::size_t p = 0; p < scene.size(); ++p)
      {
        const double distance = std::hypot(static_cast<double>(p % Width) - x, static_cast<double>(p / Width) - y);
        scene[p] += height * std::exp(-distance * distance / (2.0 * 1.2 * 1.2));
      }
    }
    SimulationSettings settings = DarkSettings(0.0);
    settings.camera = { 1600.0, 0.5, 100.0, 11.0 };
    settings.dsnuSdDn = 0.0;
    settings.seed = seed;
    Stack<GreyValue> stack = Simulate<GreyValue>(settings, Width, Height, scene);
    for (std::size_t p = 0; p < scene.size(); ++p)
    {
      const double sizeDn = random.Uniform() < 0.02 ? -66.0 * std::log(1.0 - random.Uniform()) : 0.0;
      const double duty = 0.02 + 0.48 * random.Uniform();
      for (std::size_t t = 0; t < settings.frames; ++t)
      {
        const long jump = random.Uniform() < duty ? std::lround(sizeDn) : 0;
        stack.pixels[t * Width * Height + p] = static_cast<GreyValue>(stack.pixels[t * Width * Height + p] + jump);
      }
    }
    const auto method = Measure(stack);
    const auto gain = method.GetReport().gain;
    if (gain.status == EstimateStatus::Identified)
    {
      ++identified;
      EXPECT_NEAR(*gain.value, 0.5, 4.0 * *gain.standardError) << seed;
      EXPECT_LT(*gain.standardError, 0.25 * 0.5) << seed;
    }
  }
  EXPECT_GE(identified, 3u);
}
