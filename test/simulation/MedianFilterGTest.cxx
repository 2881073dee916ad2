// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FrameProcessing.h"
#include "helpers/FrameNoiseTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

TEST(SensorNoiseMedianFilter, AConstantStays)
{
  DoubleFrame frame(7, 5);
  std::fill(frame.values.begin(), frame.values.end(), 3.25);
  for (const unsigned int radius : { 1u, 2u, 10u })
  {
    EXPECT_EQ(FilterByMedian(frame, { radius }, SerialFor).values, frame.values);
  }
}

TEST(SensorNoiseMedianFilter, IsTheMiddleOfTheSortedSquareWithTheEdgeReplicated)
{
  DoubleFrame frame(3, 3);
  frame.values = { 9.0, 1.0, 8.0, //
                   2.0, 7.0, 3.0, //
                   6.0, 4.0, 5.0 };
  const DoubleFrame out = FilterByMedian(frame, { 1 }, SerialFor);
  // In the corner 9 four times, 1 and 2 twice, 7; above 9, 9, 1, 1, 8, 8, 2, 7, 3; in the middle 1 to 9.
  EXPECT_EQ(out.Row(0)[0], 7.0);
  EXPECT_EQ(out.Row(0)[1], 7.0);
  EXPECT_EQ(out.Row(1)[1], 5.0);
}

TEST(SensorNoiseMedianFilter, AnEdgeStaysAndALonePixelGoes)
{
  DoubleFrame frame(20, 12);
  for (std::size_t i = 0; i < frame.values.size(); ++i)
  {
    frame.values[i] = i % 20 < 9 ? 10.0 : 50.0;
  }
  const std::vector<double> edge = frame.values;
  EXPECT_EQ(FilterByMedian(frame, { 1 }, SerialFor).values, edge);
  frame.Row(5)[4] = 1000.0;
  EXPECT_EQ(FilterByMedian(frame, { 1 }, SerialFor).values, edge);
}

TEST(SensorNoiseMedianFilter, LeavesTheVarianceOfAMedianOfNineNormals)
{
  // 2 integral_0^inf x^2 f(x) dx with f the density of the fifth of nine, 630 F(x)^4 (1 - F(x))^4 phi(x).
  double expected = 0.0;
  for (double x = 0.0005; x < 9.0; x += 0.001)
  {
    const double below = 0.5 * std::erfc(-x / std::sqrt(2.0));
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * 3.14159265358979323846);
    expected += 0.001 * 2.0 * x * x * 630.0 * std::pow(below * (1.0 - below), 4) * density;
  }
  EXPECT_NEAR(expected, 0.166, 0.001);
  const auto found = CovarianceOf(FilterByMedian(NormalFrame(600, 500, 11), { 1 }, SerialFor));
  // Some five pixels have the same noise: the error is as for a fifth as many.
  EXPECT_NEAR(found.variance, expected, 5.0 * expected * std::sqrt(2.0 * 5.0 / 280000.0));
  EXPECT_GT(found.horizontal, 0.5 * found.variance);
}

TEST(SensorNoiseMedianFilter, SameBitsForAnyNumberOfThreadsAndBadRadiiAreRefused)
{
  const DoubleFrame noise = NormalFrame(61, 53, 8);
  EXPECT_EQ(FilterByMedian(noise, { 1 }, Threads(3)).values, FilterByMedian(noise, { 1 }, SerialFor).values);
  EXPECT_THROW(CheckSettings(MedianSettings{ 11 }), std::invalid_argument);
  EXPECT_NO_THROW(CheckSettings(MedianSettings{}));
  EXPECT_FALSE(MedianSettings{}.IsOn());
}
