// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/PixelProjections.h"
#include "base/PixelLayout.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr FrameGeometry Geometry{ 30, 20, 1 };
constexpr std::size_t   Frames = 10;

/** Returns one of two equally frequent levels. Their third moment is 0, so that shot noise decreases no variance. */
double
LevelOf(std::size_t t)
{
  return t % 2 == 0 ? 100.0 : 900.0;
}

std::vector<double>
Levels()
{
  std::vector<double> levels;
  for (std::size_t t = 0; t < Frames; ++t)
  {
    levels.push_back(LevelOf(t));
  }
  return levels;
}

/** Returns the maps of a stack, by the formulas of mean and variance. */
StackMaps
MapsOf(const std::vector<float> & stack)
{
  StackMaps maps;
  for (std::size_t p = 0; p < Geometry.Pixels(); ++p)
  {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t t = 0; t < Frames; ++t)
    {
      const double value = stack[t * Geometry.Pixels() + p];
      sum += value;
      squares += value * value;
    }
    maps.mean.push_back(sum / Frames);
    maps.variance.push_back((squares - sum * sum / Frames) / (Frames - 1));
  }
  maps.valid.assign(Geometry.Pixels(), 1);
  return maps;
}

LevelProjection::Maps
Project(const std::vector<float> & stack, const StackMaps & maps)
{
  LevelProjection levels(maps, Geometry, PixelLayout::OfFrames(Geometry), Levels(), false, SerialFor);
  PixelProjections::AddFrames({ levels.PlaneAt(0) }, stack.data(), Frames, SerialFor);
  return levels.TakeMaps(SerialFor);
}
} // namespace

TEST(SensorNoiseLevelProjection, LeavesTheMeanSquareAboutTheRegressionOnTheLevels)
{
  std::vector<float>  stack;
  CounterSeededRandom random(3, 1, 0);
  for (std::size_t i = 0; i < Frames * Geometry.Pixels(); ++i)
  {
    const auto pixel = static_cast<double>(i % Geometry.Pixels());
    stack.push_back(static_cast<float>(50.0 + 0.003 * pixel * LevelOf(i / Geometry.Pixels()) + 5.0 * random.Normal()));
  }
  const StackMaps maps = MapsOf(stack);
  const auto      found = Project(stack, maps);
  for (std::size_t p = 0; p < Geometry.Pixels(); ++p)
  {
    double product = 0.0;
    for (std::size_t t = 0; t < Frames; ++t)
    {
      product += (LevelOf(t) - 500.0) * stack[t * Geometry.Pixels() + p];
    }
    const double squares = 400.0 * 400.0 * Frames;
    const double expected = ((Frames - 1) * maps.variance[p] - product * product / squares) / (Frames - 2);
    // The temporal component is rounded to 2^-20, which limits the agreement with the regression.
    ASSERT_NEAR(found.ofScene.variance[p], expected, 1e-5 * maps.variance[p]) << p;
    ASSERT_EQ(found.rawVariance[p], maps.variance[p]);
    ASSERT_EQ(found.ofScene.mean[p], maps.mean[p]);
  }
}

TEST(SensorNoiseLevelProjection, UnknownAndConstantPixelsStaySo)
{
  std::vector<float> stack;
  for (std::size_t i = 0; i < Frames * Geometry.Pixels(); ++i)
  {
    const std::size_t p = i % Geometry.Pixels();
    stack.push_back(p == 5   ? std::numeric_limits<float>::quiet_NaN()
                    : p == 7 ? 300.0F
                             : static_cast<float>(LevelOf(i / Geometry.Pixels()) + static_cast<double>(i * i % 13)));
  }
  const auto found = Project(stack, MapsOf(stack));
  EXPECT_TRUE(std::isnan(found.ofScene.variance[5]));
  EXPECT_EQ(found.ofScene.variance[7], 0.0);
  EXPECT_GT(found.ofScene.variance[8], 0.0);
}

TEST(SensorNoiseLevelProjection, NeedsLevelsThatDiffer)
{
  EXPECT_TRUE(AreLevelsSeries(Levels()));
  EXPECT_FALSE(AreLevelsSeries(std::vector<double>(Frames, 3.0)));
  EXPECT_FALSE(AreLevelsSeries({ 1.0, 2.0, 3.0, 4.0 }));
  EXPECT_FALSE(AreLevelsSeries({ 1.0, 2.0, 3.0, 4.0, std::numeric_limits<double>::quiet_NaN() }));
}
