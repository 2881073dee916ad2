// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/FrameNoiseTestHelper.h"
#include "helpers/StackTestHelper.h"
#include "simulation/FrameProcessing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <set>
#include <stdexcept>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

// Processing of the digital numbers of one frame in the camera: smoothing, resampling, correction of defects,
// companding.

namespace
{
constexpr double FiveErrors =
  5.0 * 1.4142136 / 547.0; ///< five standard errors of a variance of 1 over 600 x 500 pixels
} // namespace

TEST(SensorNoiseCameraProcessing, SmoothingLeavesTheSquareOfItsKernel)
{
  const DoubleFrame noise = NormalFrame(600, 500, 4);
  for (const double sd : { 0.4, 0.6, 1.0 })
  {
    SCOPED_TRACE(sd);
    double sum = 0.0;
    double squares = 0.0;
    double products = 0.0;
    for (int k = -8; k <= 8; ++k)
    {
      const auto weight = [sd](int at) {
        return std::abs(at) <= static_cast<int>(4.0 * sd + 0.5) ? std::exp(-0.5 * at * at / (sd * sd)) : 0.0;
      };
      sum += weight(k);
      squares += weight(k) * weight(k);
      products += weight(k) * weight(k + 1);
    }
    squares /= sum * sum;
    products /= sum * sum;
    const auto found = CovarianceOf(SmoothFrame(noise, { sd }, SerialFor));
    // Neighbours are correlated, so the errors are larger than for white noise of that variance, but smaller than
    // for variance 1.
    EXPECT_NEAR(found.variance, squares * squares, FiveErrors);
    EXPECT_NEAR(found.horizontal, squares * products, FiveErrors);
    EXPECT_NEAR(found.vertical, squares * products, FiveErrors);
    EXPECT_NEAR(found.diagonal, products * products, FiveErrors);
  }
}

TEST(SensorNoiseCameraProcessing, ResamplingBlendsTwoNeighboursAlongEachAxis)
{
  const DoubleFrame noise = NormalFrame(600, 500, 5);
  const auto        found = CovarianceOf(ResampleFrame(noise, { 0.5, -0.25 }, SerialFor));
  const double      across = 0.5;                 // 0.5^2 + 0.5^2
  const double      along = 0.75 * 0.75 + 0.0625; // 0.75^2 + 0.25^2
  EXPECT_NEAR(found.variance, across * along, FiveErrors);
  EXPECT_NEAR(found.horizontal, 0.25 * along, FiveErrors);
  EXPECT_NEAR(found.vertical, across * 0.1875, FiveErrors);
  // Whole pixels move the frame, edges are replicated.
  const DoubleFrame moved = ResampleFrame(noise, { 2.0, -1.0 }, SerialFor);
  EXPECT_EQ(moved.Row(10)[20], noise.Row(9)[22]);
  EXPECT_EQ(moved.Row(0)[599], noise.Row(0)[599]);
}

TEST(SensorNoiseCameraProcessing, CubicResamplingHasItsFourTapsAndKeepsParabolas)
{
  const DoubleFrame noise = NormalFrame(600, 500, 5);
  const auto        found = CovarianceOf(ResampleFrame(noise, { 0.5, 0.0, Interpolation::Cubic }, SerialFor));
  EXPECT_NEAR(found.variance, (81.0 + 81.0 + 1.0 + 1.0) / 256.0, FiveErrors);
  EXPECT_NEAR(found.horizontal, (81.0 - 9.0 - 9.0) / 256.0, FiveErrors);
  EXPECT_NEAR(found.vertical, 0.0, FiveErrors);
  DoubleFrame parabola(30, 20);
  const auto  valueAt = [](double x, double y) { return 2.0 + x * x - 3.0 * x * y + 0.5 * y * y; };
  for (std::size_t i = 0; i < 600; ++i)
  {
    parabola.values[i] = valueAt(static_cast<double>(i % 30), static_cast<double>(i / 30));
  }
  const DoubleFrame moved = ResampleFrame(parabola, { 0.3, -1.2, Interpolation::Cubic }, SerialFor);
  EXPECT_NEAR(moved.Row(9)[12], valueAt(12.3, 7.8), 1e-10);
  const DoubleFrame whole = ResampleFrame(noise, { 2.0, -1.0, Interpolation::Cubic }, SerialFor);
  EXPECT_EQ(whole.Row(10)[20], noise.Row(9)[22]);
  EXPECT_EQ(whole.Row(0)[599], noise.Row(0)[599]);
}

TEST(SensorNoiseCameraProcessing, DefectsBecomeTheMedianOfTheirNeighbours)
{
  DoubleFrame frame = NormalFrame(40, 30, 6);
  frame.Row(10)[12] = 50.0;
  frame.Row(0)[0] = -50.0;
  const DoubleFrame   out = CorrectDefects(frame, { 8.0 }, SerialFor);
  std::vector<double> around;
  for (std::size_t y = 9; y < 12; ++y)
  {
    for (std::size_t x = 11; x < 14; ++x)
    {
      if (x != 12 || y != 10)
      {
        around.push_back(frame.Row(y)[x]);
      }
    }
  }
  std::sort(around.begin(), around.end());
  EXPECT_EQ(out.Row(10)[12], 0.5 * (around[3] + around[4]));
  std::vector<double> corner{ frame.Row(0)[1], frame.Row(1)[0], frame.Row(1)[1] };
  std::sort(corner.begin(), corner.end());
  EXPECT_EQ(out.Row(0)[0], corner[1]);
  // The others stay: beyond 8 standard deviations of 8 numbers lies one normal number in 5000 or fewer, of corners
  // more.
  int changed = 0;
  for (std::size_t pixel = 0; pixel < frame.values.size(); ++pixel)
  {
    changed += out.values[pixel] != frame.values[pixel] ? 1 : 0;
  }
  EXPECT_LE(changed, 6);
}

TEST(SensorNoiseCameraProcessing, ALowThresholdTakesTheTailsAway)
{
  const DoubleFrame noise = NormalFrame(600, 500, 7);
  const auto        moments = [](const DoubleFrame & frame) {
    double square = 0.0;
    double fourth = 0.0;
    for (const double value : frame.values)
    {
      square += value * value / static_cast<double>(frame.values.size());
      fourth += std::pow(value, 4) / static_cast<double>(frame.values.size());
    }
    return std::make_pair(square, fourth / (square * square) - 3.0);
  };
  // Variance and excess kurtosis of a simulation in NumPy, with neighbourhoods of its own, 600 x 500 numbers: 0.484 and
  // -0.032 at 1.5 standard deviations, 0.883 and -0.104 at 3. Twice the errors of one, for both have them.
  const double ofVariance = 2.0 * FiveErrors;
  const double ofKurtosis = 2.0 * 5.0 * std::sqrt(24.0 / 300000.0);
  const auto   low = moments(CorrectDefects(noise, { 1.5 }, SerialFor));
  EXPECT_NEAR(low.first, 0.484, ofVariance);
  EXPECT_NEAR(low.second, -0.032, ofKurtosis);
  const auto high = moments(CorrectDefects(noise, { 3.0 }, SerialFor));
  EXPECT_NEAR(high.first, 0.883, ofVariance);
  EXPECT_NEAR(high.second, -0.104, ofKurtosis);
  const auto untouched = moments(CorrectDefects(noise, { 100.0 }, SerialFor));
  EXPECT_NEAR(untouched.first, 1.0, FiveErrors);
  EXPECT_NEAR(untouched.second, 0.0, 5.0 * std::sqrt(24.0 / 300000.0));
}

TEST(SensorNoiseCameraProcessing, CompandedNumbersLieOnSquares)
{
  std::vector<double> greyValues(4096);
  for (std::size_t i = 0; i < greyValues.size(); ++i)
  {
    greyValues[i] = static_cast<double>(i);
  }
  std::vector<double> companded = greyValues;
  Compand(companded.data(), companded.size(), { 8 }, 12);
  EXPECT_EQ(companded.front(), 0.0);
  EXPECT_EQ(companded.back(), 4095.0);
  const std::set<double> levels(companded.begin(), companded.end());
  EXPECT_LE(levels.size(), 256u);
  EXPECT_GE(levels.size(), 240u); // the steps at the dark end are narrower than a DN
  for (std::size_t i = 0; i < greyValues.size(); ++i)
  {
    const double root = std::sqrt(companded[i] / 4095.0) * 255.0;
    EXPECT_NEAR(root, std::round(root), 1e-9);
    // Half a step of the root, 1/510, is a change of the digital number by half of 2 sqrt(v top) / 255.
    const double halfStep = std::sqrt(std::max(greyValues[i], companded[i]) * 4095.0) / 255.0;
    EXPECT_LE(std::abs(companded[i] - greyValues[i]), halfStep + 0.02);
  }
  double outside[] = { -5.0, 5000.0 };
  Compand(outside, 2, { 8 }, 12);
  EXPECT_EQ(outside[0], 0.0);
  EXPECT_EQ(outside[1], 4095.0);
}

TEST(SensorNoiseCameraProcessing, SameBitsForAnyNumberOfThreads)
{
  const DoubleFrame noise = NormalFrame(61, 53, 8);
  EXPECT_EQ(SmoothFrame(noise, { 0.6 }, Threads(3)).values, SmoothFrame(noise, { 0.6 }, SerialFor).values);
  EXPECT_EQ(ResampleFrame(noise, { 0.3, 1.2 }, Threads(3)).values,
            ResampleFrame(noise, { 0.3, 1.2 }, SerialFor).values);
  const ResamplingSettings cubic{ 0.3, 1.2, Interpolation::Cubic };
  EXPECT_EQ(ResampleFrame(noise, cubic, Threads(3)).values, ResampleFrame(noise, cubic, SerialFor).values);
  EXPECT_EQ(CorrectDefects(noise, { 1.5 }, Threads(3)).values, CorrectDefects(noise, { 1.5 }, SerialFor).values);
}

TEST(SensorNoiseCameraProcessing, BadSettingsAreRefused)
{
  EXPECT_THROW(CheckSettings(SmoothingSettings{ -0.1 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(ResamplingSettings{ 0.0, NAN }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(ResamplingSettings{ 0.5, 0.5, Interpolation::Nearest }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(DefectCorrectionSettings{ -1.0 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(CompandingSettings{ 1 }, 12), std::invalid_argument);
  EXPECT_THROW(CheckSettings(CompandingSettings{ 8 }, 0), std::invalid_argument);
  EXPECT_NO_THROW(CheckSettings(CompandingSettings{ 0 }, 0));
}
