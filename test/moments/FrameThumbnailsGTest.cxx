// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/FrameThumbnails.h"
#include "helpers/ThumbnailTestHelper.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t   Width = 48;
constexpr std::size_t   Height = 64;
constexpr std::size_t   Frames = 12;
constexpr FrameGeometry Geometry{ Width, Height };

/** Returns a stack whose pixels are \a value(t, x, y). */
std::vector<double>
Stack(const std::function<double(double t, double x, double y)> & value)
{
  std::vector<double> stack;
  for (std::size_t i = 0; i < Frames * Height * Width; ++i)
  {
    stack.push_back(value(static_cast<double>(i / (Width * Height)),
                          static_cast<double>(i % Width),
                          static_cast<double>(i / Width % Height)));
  }
  return stack;
}

SceneChange
ChangeOf(const std::vector<double> & stack, const std::vector<std::uint8_t> & mask = {})
{
  FrameThumbnails thumbnails(Geometry, Frames, mask);
  thumbnails.AddFrames(stack.data(), 0, Frames, SerialFor);
  return thumbnails.FindChange(test::AllFrames(thumbnails));
}

double
Wave(double x, double y)
{
  return 100.0 + 30.0 * std::sin(0.2 * x) + 40.0 * std::cos(0.13 * y);
}
} // namespace

TEST(SensorNoiseFrameThumbnails, FlickerAndDriftOfAStaticSceneAreNoChange)
{
  const auto change =
    ChangeOf(Stack([](double t, double x, double y) { return (1.0 + 0.3 * std::sin(t)) * Wave(x, y) + 5.0 * t; }));
  EXPECT_LT(change.fraction, 1e-20);
  EXPECT_FALSE(change.IsLarge());
}

TEST(SensorNoiseFrameThumbnails, NoiseIsNoChange)
{
  // A flat field in the dark: noise alone, as large as the level.
  CounterSeededRandom random(3, 1, 0);
  const auto          change = ChangeOf(Stack([&](auto, auto, auto) { return 10.0 + 10.0 * random.Normal(); }));
  EXPECT_FALSE(change.IsLarge()) << change.fraction << ' ' << change.ofTheLevel;
}

TEST(SensorNoiseFrameThumbnails, VariancesOfCellsAreOfIndependentPixels)
{
  // Left, noise of 4 DN; right, the pixels of a cell change together, by 4 DN.
  CounterSeededRandom random(4, 1, 0);
  FrameThumbnails     thumbnails(Geometry, Frames, {});
  const auto          stack = Stack([&](double t, double x, double y) {
    const double together = 4.0 * std::sin(1.7 * t + std::floor(x / 3.0) + 5.0 * std::floor(y / 4.0));
    return Wave(x, y) + (x < 24.0 ? 4.0 * random.Normal() : std::sqrt(2.0) * together);
  });
  thumbnails.AddFrames(stack.data(), 0, Frames, SerialFor);
  double left = 0.0;
  double right = 0.0;
  for (const CellVariance & own : thumbnails.FindCellVariances(test::AllFrames(thumbnails)))
  {
    (own.pixel % Width < 24 ? left : right) += own.perPixelDn2 / 128.0; // half of 256 cells
  }
  // 128 variances of 12 frames scatter by sqrt(2 / 11 / 128); a cell samples two rows of 3 pixels.
  EXPECT_NEAR(left, 16.0, 5.0 * 16.0 * std::sqrt(2.0 / 11.0 / 128.0));
  EXPECT_NEAR(right, 6.0 * 16.0, 0.25 * 6.0 * 16.0);
}

TEST(SensorNoiseFrameThumbnails, ScenesOfTheirOwnAreAllChange)
{
  const auto change =
    ChangeOf(Stack([](double t, double x, double y) { return Wave(x + 37.0 * t * t, y - 53.0 * t * t); }));
  EXPECT_GT(change.fraction, 0.5);
  EXPECT_GT(change.ofTheLevel, 0.15);
  EXPECT_TRUE(change.IsLarge());
}

TEST(SensorNoiseFrameThumbnails, FractionIsTakenOfTheVariance)
{
  // The frames alternate between a + b and a - b, where a and b are not correlated over the tiles. The fraction of b is
  // 9 / (16 + 9), over 0.6745^2, as all tiles differ by the same amount.
  const auto stack = Stack([](double t, double x, double y) {
    const double a = std::fmod(x, 6.0) < 3.0 ? 1.0 : -1.0; // tiles have 3 x 4 pixels
    const double b = std::fmod(y, 8.0) < 4.0 ? 1.0 : -1.0;
    return 20.0 + 4.0 * a + (std::fmod(t, 2.0) < 1.0 ? 3.0 : -3.0) * b;
  });
  const auto change = ChangeOf(stack);
  EXPECT_NEAR(change.fraction, 9.0 / 25.0 / 0.6745 / 0.6745, 4.0 / 256.0); // degrees of freedom of 256 tiles
  EXPECT_NEAR(change.ofTheLevel, 3.0 / 20.0 / 0.6745, 0.001);
}

TEST(SensorNoiseFrameThumbnails, WhatIsMaskedOrNotFiniteIsLeftOut)
{
  const double              nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::uint8_t> mask(Width * Height, 1);
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    mask[p] = p % Width < 24 ? 1 : 0;
  }
  const auto half = [](double t, double x, double y) { return x < 24.0 ? Wave(x, y) : Wave(x + 90.0 * t, y * t); };
  EXPECT_GT(ChangeOf(Stack(half)).fraction, 0.01);
  EXPECT_LT(ChangeOf(Stack(half), mask).fraction, 1e-20);
  EXPECT_LT(
    ChangeOf(Stack([&](double t, double x, double y) { return x < 24.0  ? Wave(x, y)
                                                              : t > 3.0 ? nan
                                                                        : 9.0; })).fraction,
    1e-20);
  EXPECT_EQ(ChangeOf(Stack([&](auto, auto, auto) { return nan; })).fraction, 0.0);
}

TEST(SensorNoiseFrameThumbnails, IntegersHaveTheBitsOfFloats)
{
  std::vector<unsigned short> greyValues;
  for (const double value : Stack([](double t, double x, double y) { return 290.0 * std::abs(Wave(x + t, y)); }))
  {
    greyValues.push_back(static_cast<unsigned short>(value)); // up to 49,000, so that steps need all their bits
  }
  greyValues.front() = std::numeric_limits<unsigned short>::max();
  greyValues[1] = 0;
  const std::vector<double> numbers(greyValues.begin(), greyValues.end());
  std::ostringstream        saved[2];
  FrameThumbnails           ofIntegers(Geometry, Frames, {});
  FrameThumbnails           ofNumbers(Geometry, Frames, {});
  ofIntegers.AddFrames(greyValues.data(), 0, Frames, SerialFor);
  ofNumbers.AddFrames(numbers.data(), 0, Frames, SerialFor);
  ofIntegers.Save(saved[0]);
  ofNumbers.Save(saved[1]);
  EXPECT_EQ(saved[0].str(), saved[1].str());
}

TEST(SensorNoiseFrameThumbnails, FewFramesOrCellsShowNoChange)
{
  const auto      stack = Stack([](double t, double x, double y) { return Wave(x * t, y * t); });
  FrameThumbnails few(Geometry, 4, {});
  few.AddFrames(stack.data(), 0, 4, SerialFor);
  EXPECT_EQ(few.FindChange(test::AllFrames(few)).fraction, 0.0);
  FrameThumbnails small({ 2, 3 }, Frames, {});
  small.AddFrames(stack.data(), 0, Frames, SerialFor);
  EXPECT_EQ(small.FindChange(test::AllFrames(small)).fraction, 0.0);
}

TEST(SensorNoiseFrameThumbnails, PartsGiveTheBitsOfTheWhole)
{
  const auto      stack = Stack([](double t, double x, double y) { return Wave(x * t, y * t); });
  FrameThumbnails first(Geometry, Frames, {});
  FrameThumbnails second(Geometry, Frames, {});
  first.AddFrames(stack.data(), 0, 5, SerialFor);
  second.AddFrames(stack.data() + 5 * Width * Height, 5, Frames - 5, SerialFor);
  std::stringstream stream;
  second.Save(stream);
  first.Merge(first.ReadOther(stream));
  EXPECT_EQ(first.FindChange(test::AllFrames(first)).fraction, ChangeOf(stack).fraction);
  EXPECT_THROW(first.ReadOther(stream), std::runtime_error);
}
