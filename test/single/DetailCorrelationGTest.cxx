// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/LevelSums.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Size = 134; // pixels: 54 positions along an axis

/** Returns the correlation of frames that are pixel(x, y), with a constant expected variance. */
template <typename TFunction>
DetailCorrelation
CorrelationOf(double variance, const TFunction & pixel)
{
  std::vector<float> pixels(Size * Size);
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    pixels[i] = static_cast<float>(pixel(i % Size, i / Size));
  }
  SingleFrame<float> frame;
  frame.pixels = pixels.data();
  frame.layout.width = frame.layout.row = Size;
  frame.layout.step = 1;
  frame.height = Size;
  const std::size_t positions = SingleFrame<float>::PositionsAlong(Size);
  BandTile          tile;
  tile.Compute(frame, { 0, 0, positions, positions });
  LevelGrid grid;
  grid.variance.assign(4, static_cast<float>(variance));
  DetailCorrelation correlation;
  correlation.Add(tile, grid);
  return correlation;
}
} // namespace

TEST(SensorNoiseDetailCorrelation, WhiteNoiseHasNone)
{
  std::mt19937               random(1);
  std::normal_distribution<> normal;
  DetailCorrelation          sum;
  for (int frame = 0; frame < 20; ++frame)
  {
    sum.Add(CorrelationOf(1.0, [&](std::size_t, std::size_t) { return normal(random); }));
  }
  const DetailCorrelation::Lag largest = sum.Largest();
  EXPECT_NEAR(largest.standardError, 1.0 / std::sqrt(20.0 * 54.0 * 53.0), 0.1 * largest.standardError);
  EXPECT_LT(std::abs(largest.value), 4.0 * largest.standardError); // the largest of six
}

TEST(SensorNoiseDetailCorrelation, APeriodOfTwoDetailsIsFoundWithItsPart)
{
  // 4 pixels along x are 2 coefficients: details alternate in x, and are equal 4 pixels apart.
  const double               twoPi = 2.0 * std::acos(-1.0);
  std::mt19937               random(2);
  std::normal_distribution<> normal;
  const auto                 weave = [&](std::size_t x, std::size_t y) {
    return std::cos(twoPi * static_cast<double>(x) / 4.0) * std::cos(twoPi * static_cast<double>(y) / 4.0);
  };
  const auto correlation = [&](double amplitude) {
    return CorrelationOf(2.0, [&](std::size_t x, std::size_t y) { return normal(random) + amplitude * weave(x, y); })
      .Largest();
  };
  EXPECT_GT(std::abs(correlation(1.0).value), 0.1);
  EXPECT_GT(std::abs(correlation(1.5).value), std::abs(correlation(1.0).value));
}

TEST(SensorNoiseDetailCorrelation, EdgesAndMissingPixelsHaveNoPart)
{
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(CorrelationOf(1.0, [](std::size_t, std::size_t) { return missing; }).Largest().value, 0.0);
  const auto checkerboard = [](std::size_t x, std::size_t y) { return (x / 8 + y / 8) % 2 == 0 ? 0.0 : 100.0; };
  EXPECT_EQ(CorrelationOf(1.0, checkerboard).Largest().value, 0.0);
}
