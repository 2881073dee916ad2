// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"
#include "simulation/Random.h"
#include "sensornoise/SimulationSettings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <stdexcept>
#include <vector>

using namespace sensornoise;

TEST(SensorNoiseScenes, TargetHoldsSixteenEqualPatchesOnItsSurround)
{
  const auto                  image = MakeTargetScene(512, 400);
  std::map<long, std::size_t> counts; // pixels at each level, in units of 1/1500
  for (const double value : image)
  {
    ++counts[std::lround(value * 1500.0)];
  }
  // Cells of 128 x 100 pixels with margins of 8 and 7 pixels.
  constexpr std::size_t patch = (128 - 16) * (100 - 14);
  ASSERT_EQ(counts.size(), 17u);
  for (long level = 0; level < 16; ++level)
  {
    EXPECT_EQ(counts[level * 100], patch) << level;
  }
  EXPECT_EQ(counts[180], 512 * 400 - 16 * patch);
}

TEST(SensorNoiseScenes, TargetOrderDependsOnTheSeedOnly)
{
  EXPECT_EQ(MakeTargetScene(64, 64, 1), MakeTargetScene(64, 64, 1));
  EXPECT_NE(MakeTargetScene(64, 64, 1), MakeTargetScene(64, 64, 2));
}

TEST(SensorNoiseScenes, EveryRowOfTheBarsHoldsEveryLevelEquallyOften)
{
  const auto image = MakeBarsScene(160, 3);
  for (std::size_t y = 0; y < 3; ++y)
  {
    std::map<long, int> counts;
    for (std::size_t x = 0; x < 160; ++x)
    {
      ++counts[std::lround(image[y * 160 + x] * 15.0)];
    }
    ASSERT_EQ(counts.size(), 16u);
    for (const auto & entry : counts)
    {
      EXPECT_EQ(entry.second, 10) << entry.first;
    }
  }
  EXPECT_EQ(std::set<double>(image.begin(), image.end()).size(), 16u);
  EXPECT_FALSE(std::is_sorted(image.begin(), image.begin() + 160));
}

TEST(SensorNoiseScenes, TextureIsHardForTheVibrationTest)
{
  constexpr std::size_t size = 512;
  const auto            scene = MakeTextureScene(size, size);
  EXPECT_EQ(*std::min_element(scene.begin(), scene.end()), 0.0);
  EXPECT_EQ(*std::max_element(scene.begin(), scene.end()), 1.0);

  // Camera B, condition 3, 100 frames: mean and variance by the model, the mean with the noise that it would have.
  const SimulationSettings settings;
  const auto               electrons = ScaleToRange(GaussianBlur(scene, size, size, 0.5), 0.0, 3000.0);
  const double             frames = 100.0;
  std::vector<double>      mean(electrons.size());
  std::vector<double>      variance(electrons.size());
  CounterSeededRandom      random(1);
  for (std::size_t i = 0; i < electrons.size(); ++i)
  {
    // The flicker moves all pixels of the mean together, so it adds to the variance alone.
    const double noise = electrons[i] + 64.0;
    variance[i] = noise + 0.0025 * electrons[i] * electrons[i];
    mean[i] = electrons[i] + std::sqrt(noise / frames) * random.Normal();
  }
  std::size_t rejected = 0;
  for (std::size_t y = 1; y + 1 < size; ++y)
  {
    for (std::size_t x = 1; x + 1 < size; ++x)
    {
      const std::size_t i = y * size + x;
      const double      dx = 0.5 * (mean[i + 1] - mean[i - 1]);
      const double      dy = 0.5 * (mean[i + size] - mean[i - size]);
      rejected += 2.0 * frames * (dx * dx + dy * dy) / variance[i] > 9.21 ? 1 : 0;
    }
  }
  const double fraction = static_cast<double>(rejected) / ((size - 2.0) * (size - 2.0));
  EXPECT_GT(fraction, 0.50);
  EXPECT_LT(fraction, 0.75);
}

TEST(SensorNoiseScenes, TextureDependsOnTheSeedAndWorksWhenSmall)
{
  EXPECT_EQ(MakeTextureScene(40, 16, 1), MakeTextureScene(40, 16, 1));
  EXPECT_NE(MakeTextureScene(40, 16, 1), MakeTextureScene(40, 16, 2));
}

TEST(SensorNoiseScenes, BlurOfAPointIsTheSampledKernel)
{
  constexpr std::size_t width = 11;
  constexpr std::size_t height = 9;
  std::vector<double>   point(width * height, 0.0);
  point[4 * width + 5] = 1.0;
  const auto blurred = GaussianBlur(point, width, height, 0.5);
  // 4 standard deviations are 2 pixels; the weights are exp(-2 d^2).
  const double sum = 1.0 + 2.0 * std::exp(-2.0) + 2.0 * std::exp(-8.0);
  for (int y = 0; y < 9; ++y)
  {
    for (int x = 0; x < 11; ++x)
    {
      const int    dx = x - 5;
      const int    dy = y - 4;
      const bool   isInside = std::abs(dx) <= 2 && std::abs(dy) <= 2;
      const double expected = isInside ? std::exp(-2.0 * (dx * dx + dy * dy)) / (sum * sum) : 0.0;
      EXPECT_NEAR(blurred[y * width + x], expected, 1e-15) << x << ", " << y; // rounding of a few products
    }
  }
}

TEST(SensorNoiseScenes, BlurReplicatesTheEdges)
{
  const double sum = 1.0 + 2.0 * std::exp(-2.0) + 2.0 * std::exp(-8.0);
  const auto   blurred = GaussianBlur({ 1.0, 0.0, 0.0, 0.0 }, 4, 1, 0.5);
  // The first pixel stands for the two in front of it.
  EXPECT_NEAR(blurred[0], (1.0 + std::exp(-2.0) + std::exp(-8.0)) / sum, 1e-15); // rounding
  EXPECT_NEAR(blurred[1], (std::exp(-2.0) + std::exp(-8.0)) / sum, 1e-15);
  EXPECT_NEAR(blurred[3], 0.0, 1e-15);
  EXPECT_EQ(GaussianBlur({ 1.0, 2.0, 4.0 }, 1, 3, 0.0), (std::vector<double>{ 1.0, 2.0, 4.0 }));
}

TEST(SensorNoiseScenes, ScaleToRangeIsLinearAndLiftsAConstant)
{
  EXPECT_EQ(ScaleToRange({ -1.0, 0.0, 3.0 }, 0.0, 8.0), (std::vector<double>{ 0.0, 2.0, 8.0 }));
  EXPECT_EQ(ScaleToRange({ 5.0, 5.0 }, 0.0, 8.0), (std::vector<double>{ 8.0, 8.0 }));
  EXPECT_TRUE(ScaleToRange({}, 0.0, 1.0).empty());
}

TEST(SensorNoiseScenes, FlatIsFullyLitEverywhere)
{
  EXPECT_EQ(MakeFlatScene(3, 2), std::vector<double>(6, 1.0));
  EXPECT_THROW(MakeFlatScene(0, 2), std::invalid_argument);
}

TEST(SensorNoiseScenes, TooSmallASceneIsRefusedWithItsSize)
{
  try
  {
    MakeTargetScene(31, 500);
    FAIL() << "no error";
  }
  catch (const std::invalid_argument & error)
  {
    EXPECT_STREQ(error.what(), "the target scene was asked for with 31 x 500 pixels; it needs at least 32 x 32");
  }
  EXPECT_THROW(MakeBarsScene(15, 1), std::invalid_argument);
  EXPECT_THROW(MakeTextureScene(16, 15), std::invalid_argument);
}
