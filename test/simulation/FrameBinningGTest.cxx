// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/FrameNoiseTestHelper.h"
#include "helpers/StackTestHelper.h"
#include "simulation/FrameProcessing.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <numeric>
#include <stdexcept>
#include <string>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
double
MeanOf(const DoubleFrame & frame)
{
  return std::accumulate(frame.values.begin(), frame.values.end(), 0.0) / static_cast<double>(frame.values.size());
}
} // namespace

TEST(SensorNoiseFrameBinning, SquaresOfEqualPixelsByNearest)
{
  DoubleFrame frame(5, 3);
  std::iota(frame.values.begin(), frame.values.end(), 0.0);
  const DoubleFrame out = BinFrame(frame, { 2, Interpolation::Nearest }, SerialFor);
  // 0 1 5 6; at the edges 4 9, then 10 11, and the corner 14.
  EXPECT_EQ(out.Row(0)[0], 3.0);
  EXPECT_EQ(out.Row(1)[1], 3.0);
  EXPECT_EQ(out.Row(0)[2], 5.0);
  EXPECT_EQ(out.Row(0)[4], 6.5);
  EXPECT_EQ(out.Row(2)[1], 10.5);
  EXPECT_EQ(out.Row(2)[4], 14.0);
}

TEST(SensorNoiseFrameBinning, LinearLiesBetweenTheCentresOfTheSquares)
{
  DoubleFrame frame(8, 4);
  for (std::size_t y = 0; y < 4; ++y)
  {
    for (std::size_t x = 0; x < 8; ++x)
    {
      frame.Row(y)[x] = 3.0 * static_cast<double>(x) + 7.0 * static_cast<double>(y);
    }
  }
  const DoubleFrame out = BinFrame(frame, { 2, Interpolation::Linear }, SerialFor);
  // A plane stays between the outermost centres, which are half a pixel inside.
  for (std::size_t y = 1; y < 3; ++y)
  {
    for (std::size_t x = 1; x < 7; ++x)
    {
      EXPECT_DOUBLE_EQ(out.Row(y)[x], frame.Row(y)[x]);
    }
  }
  EXPECT_DOUBLE_EQ(out.Row(0)[0], 1.5 + 3.5); // sum of the outermost square
}

TEST(SensorNoiseFrameBinning, TheMeanIsKept)
{
  const DoubleFrame noise = NormalFrame(60, 36, 2);
  for (const unsigned int factor : { 2u, 3u, 4u })
  {
    for (const Interpolation interpolation : { Interpolation::Nearest, Interpolation::Linear })
    {
      EXPECT_NEAR(MeanOf(BinFrame(noise, { factor, interpolation }, SerialFor)), MeanOf(noise), 1e-14);
    }
  }
}

TEST(SensorNoiseFrameBinning, LeavesTheVarianceOfItsMeans)
{
  const DoubleFrame noise = NormalFrame(600, 500, 7);
  // n^2 pixels have one value: the number of independent values is the number of squares.
  const auto error = [](double variance, double shared) { return 5.0 * variance * std::sqrt(2.0 * shared / 280000.0); };
  const auto two = CovarianceOf(BinFrame(noise, { 2, Interpolation::Nearest }, SerialFor));
  EXPECT_NEAR(two.variance, 0.25, error(0.25, 4.0));
  EXPECT_NEAR(two.horizontal, 0.125, error(0.25, 4.0)); // one neighbour of two is of the same square
  EXPECT_NEAR(two.diagonal, 0.0625, error(0.25, 4.0));
  const auto three = CovarianceOf(BinFrame(noise, { 3, Interpolation::Nearest }, SerialFor));
  EXPECT_NEAR(three.variance, 1.0 / 9.0, error(1.0 / 9.0, 9.0));
  // Between two squares a pixel has 3/4 of one and 1/4 of the other along each axis.
  const auto   linear = CovarianceOf(BinFrame(noise, { 2, Interpolation::Linear }, SerialFor));
  const double along = 0.75 * 0.75 + 0.25 * 0.25;
  EXPECT_NEAR(linear.variance, 0.25 * along * along, error(0.1, 8.0));
}

TEST(SensorNoiseFrameBinning, SameBitsForAnyNumberOfThreadsAndBadSettingsAreRefused)
{
  const DoubleFrame noise = NormalFrame(61, 53, 8);
  for (const Interpolation interpolation : { Interpolation::Nearest, Interpolation::Linear })
  {
    EXPECT_EQ(BinFrame(noise, { 2, interpolation }, Threads(3)).values,
              BinFrame(noise, { 2, interpolation }, SerialFor).values);
  }
  EXPECT_EQ(BinFrame(noise, {}, SerialFor).values, noise.values);
  EXPECT_THROW(CheckSettings(BinningSettings{ 0 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(BinningSettings{ 65 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(BinningSettings{ 2, Interpolation::Cubic }), std::invalid_argument);
  EXPECT_FALSE(BinningSettings{}.IsOn());
}

TEST(SensorNoiseFrameBinning, InterpolationsHaveNames)
{
  for (const char * name : { "nearest", "linear", "cubic" })
  {
    EXPECT_EQ(std::string(NameOf(InterpolationOf(name))), name);
  }
  EXPECT_THROW(InterpolationOf("lanczos"), std::invalid_argument);
}
