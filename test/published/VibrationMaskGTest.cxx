// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/PublishedScene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Width = 40;
constexpr std::size_t Height = 30;
constexpr std::size_t Frames = 50;

/** Returns a map of a frame with the values of a function of (x, y). */
template <typename TFunction>
std::vector<double>
MapOf(TFunction function)
{
  std::vector<double> map(Width * Height);
  for (std::size_t p = 0; p < map.size(); ++p)
  {
    map[p] = function(static_cast<double>(p % Width), static_cast<double>(p / Width));
  }
  return map;
}

std::vector<std::uint8_t>
MaskOf(const std::vector<double> & mean, const std::vector<double> & variance, double level = 0.01)
{
  const std::vector<std::uint8_t> valid(mean.size(), 1);
  return VibrationMask(mean.data(), variance.data(), valid.data(), Width, Height, Frames, level);
}

bool
IsBorder(std::size_t p)
{
  return p % Width == 0 || p % Width + 1 == Width || p / Width == 0 || p / Width + 1 == Height;
}
} // namespace

TEST(SensorNoiseVibrationMask, QuantileIsThatOfChiSquareWithTwoDegreesOfFreedom)
{
  EXPECT_NEAR(ChiSquare2Quantile(0.01), 9.21, 0.005); // as printed in the paper
  EXPECT_DOUBLE_EQ(ChiSquare2Quantile(std::exp(-1.0)), 2.0);
  for (const double level : { 0.0, 1.0, -0.1, 1.5, std::nan("") })
  {
    EXPECT_THROW(ChiSquare2Quantile(level), std::invalid_argument) << level;
  }
}

TEST(SensorNoiseVibrationMask, CentredGradientOfAPlaneIsItsSlope)
{
  const auto     mean = MapOf([](double x, double y) { return 3.0 * x - 7.0 * y; });
  const Gradient gradient = CentredGradient(mean.data(), Width, 5 * Width + 9);
  EXPECT_EQ(gradient.x, 3.0);
  EXPECT_EQ(gradient.y, -7.0);
}

TEST(SensorNoiseVibrationMask, RampIsKeptUpToTheThresholdSlope)
{
  // 2 T slope^2 < -2 ln(level) variance
  const auto   variance = std::vector<double>(Width * Height, 4.0);
  const double threshold = std::sqrt(-std::log(0.01) * 4.0 / Frames);
  for (const double angle : { 0.0, 0.7, 2.0 })
  {
    for (const double factor : { 0.999, 1.001 })
    {
      const double slope = factor * threshold;
      const auto   mask =
        MaskOf(MapOf([&](double x, double y) { return 500.0 + slope * (std::cos(angle) * x + std::sin(angle) * y); }),
               variance);
      for (std::size_t p = 0; p < mask.size(); ++p)
      {
        ASSERT_EQ(mask[p], factor < 1.0 && !IsBorder(p) ? 1 : 0) << angle << ' ' << factor << ' ' << p;
      }
    }
  }
}

TEST(SensorNoiseVibrationMask, BothSidesOfAnEdgeAreLeftOut)
{
  const auto mask =
    MaskOf(MapOf([](double x, double) { return x < 20.0 ? 100.0 : 200.0; }), std::vector<double>(Width * Height, 9.0));
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    const std::size_t x = p % Width;
    ASSERT_EQ(mask[p], x == 19 || x == 20 || IsBorder(p) ? 0 : 1) << p;
  }
}

TEST(SensorNoiseVibrationMask, NoiseAloneIsKeptWithProbabilityOneMinusLevel)
{
  constexpr std::size_t      size = 400;
  std::mt19937_64            random(3);
  std::normal_distribution<> normal(1000.0, std::sqrt(25.0 / Frames)); // mean of frames with the variance 25
  std::vector<double>        mean(size * size);
  std::generate(mean.begin(), mean.end(), [&] { return normal(random); });
  const std::vector<double>       variance(mean.size(), 25.0);
  const std::vector<std::uint8_t> valid(mean.size(), 1);
  for (const double level : { 0.01, 0.05, 0.3 })
  {
    const auto   mask = VibrationMask(mean.data(), variance.data(), valid.data(), size, size, Frames, level);
    const double inner = (size - 2.0) * (size - 2.0);
    const double kept = static_cast<double>(std::count(mask.begin(), mask.end(), 1)) / inner;
    // Binomial; the mean of each pixel is in 4 statistics, and this correlation at most quadruples the variance.
    EXPECT_NEAR(kept, 1.0 - level, 4.0 * 2.0 * std::sqrt(level * (1.0 - level) / inner)) << level;
  }
}

TEST(SensorNoiseVibrationMask, ScalingAndOffsetChangeNothing)
{
  std::mt19937_64            random(5);
  std::normal_distribution<> normal(64.0, 0.4);
  const auto                 mean = MapOf([&](double, double) { return normal(random); });
  const auto                 mask = MaskOf(mean, std::vector<double>(mean.size(), 2.0));
  auto                       scaled = mean;
  std::transform(mean.begin(), mean.end(), scaled.begin(), [](double u) { return 16.0 * u; }); // exact in binary
  EXPECT_EQ(MaskOf(scaled, std::vector<double>(mean.size(), 512.0)), mask);
  auto shifted = mean;
  std::transform(mean.begin(), mean.end(), shifted.begin(), [](double u) { return u + 1000.0; });
  EXPECT_EQ(MaskOf(shifted, std::vector<double>(mean.size(), 2.0)), mask);
  EXPECT_GT(std::count(mask.begin(), mask.end(), 0), 200); // the border has 136 pixels: the test left out others, too
}

TEST(SensorNoiseVibrationMask, NeighboursOfNaNAreLeftOut)
{
  constexpr double  nan = std::numeric_limits<double>::quiet_NaN();
  auto              mean = std::vector<double>(Width * Height, 100.0);
  auto              variance = std::vector<double>(Width * Height, 1.0);
  const std::size_t bad = 10 * Width + 15;
  mean[bad] = nan;
  variance[bad] = nan;
  const auto mask = MaskOf(mean, variance);
  for (const std::size_t p : { bad, bad - 1, bad + 1, bad - Width, bad + Width })
  {
    EXPECT_EQ(mask[p], 0) << p;
  }
  EXPECT_EQ(std::count(mask.begin(), mask.end(), 1), static_cast<int>((Width - 2) * (Height - 2) - 5));
}

TEST(SensorNoiseVibrationMask, PixelsThatAreNotValidOrNeverVaryAreLeftOut)
{
  const auto                mean = std::vector<double>(Width * Height, 100.0);
  auto                      variance = std::vector<double>(Width * Height, 1.0);
  std::vector<std::uint8_t> valid(mean.size(), 1);
  valid[5 * Width + 5] = 0;
  variance[6 * Width + 9] = 0.0;
  const auto mask = VibrationMask(mean.data(), variance.data(), valid.data(), Width, Height, Frames, 0.01);
  EXPECT_EQ(mask[5 * Width + 5], 0);
  EXPECT_EQ(mask[6 * Width + 9], 0);
  EXPECT_EQ(mask[5 * Width + 6], 1); // the mean of its neighbour is still used
}

TEST(SensorNoiseVibrationMask, FramesWithoutInnerPixelsKeepNone)
{
  const std::vector<double>       map(12, 1.0);
  const std::vector<std::uint8_t> valid(12, 1);
  for (const std::size_t width : { 1, 2, 6, 12 })
  {
    const auto mask = VibrationMask(map.data(), map.data(), valid.data(), width, 12 / width, Frames, 0.01);
    EXPECT_EQ(std::count(mask.begin(), mask.end(), 1), 0) << width;
  }
}

TEST(SensorNoiseVibrationMask, LevelOutOfRangeIsRefused)
{
  const std::vector<double> map(Width * Height, 1.0);
  EXPECT_THROW(MaskOf(map, map, 0.0), std::invalid_argument);
  EXPECT_THROW(MaskOf(map, map, 1.0), std::invalid_argument);
}
