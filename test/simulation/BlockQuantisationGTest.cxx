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

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr double Pi = 3.14159265358979323846;

BlockStepsDn
AllSteps(double stepDn)
{
  BlockStepsDn steps{};
  steps.fill(stepDn);
  return steps;
}

double
LargestDifference(const DoubleFrame & a, const DoubleFrame & b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
  {
    largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
  }
  return largest;
}
} // namespace

TEST(SensorNoiseBlockQuantisation, TinyStepsChangeNothing)
{
  const DoubleFrame noise = NormalFrame(61, 53, 3); // blocks that the edge cuts, too
  EXPECT_LT(LargestDifference(QuantiseBlocks(noise, AllSteps(1e-7), SerialFor), noise), 1e-6);
  EXPECT_GT(LargestDifference(QuantiseBlocks(noise, AllSteps(1.0), SerialFor), noise), 0.1);
}

TEST(SensorNoiseBlockQuantisation, ASecondTimeChangesNothing)
{
  const BlockStepsDn steps = StepsOfQuality({ 75 }, 8);
  DoubleFrame        noise = NormalFrame(64, 48, 4);
  for (double & greyValue : noise.values)
  {
    greyValue = 120.0 + 25.0 * greyValue;
  }
  const DoubleFrame once = QuantiseBlocks(noise, steps, SerialFor);
  EXPECT_GT(LargestDifference(once, noise), 5.0);
  EXPECT_LT(LargestDifference(QuantiseBlocks(once, steps, SerialFor), once), 1e-9);
}

TEST(SensorNoiseBlockQuantisation, EachFrequencyHasItsStep)
{
  // A block of one cosine: vertical frequency 2, horizontal frequency 5, coefficient 10; orthonormal.
  DoubleFrame frame(8, 8);
  const auto  fill = [&](double coefficient) {
    for (std::size_t i = 0; i < 64; ++i)
    {
      const double vertical = 0.5 * std::cos(Pi * (2.0 * static_cast<double>(i / 8) + 1.0) * 2.0 / 16.0);
      const double horizontal = 0.5 * std::cos(Pi * (2.0 * static_cast<double>(i % 8) + 1.0) * 5.0 / 16.0);
      frame.values[i] = coefficient * vertical * horizontal;
    }
    return frame;
  };
  BlockStepsDn steps = AllSteps(1000.0);
  steps[2 * 8 + 5] = 4.0;
  const DoubleFrame kept = QuantiseBlocks(fill(10.5), steps, SerialFor);
  EXPECT_LT(LargestDifference(kept, fill(12.0)), 1e-12);
  std::swap(steps[2 * 8 + 5], steps[5 * 8 + 2]);
  const DoubleFrame gone = QuantiseBlocks(fill(10.5), steps, SerialFor);
  EXPECT_LT(LargestDifference(gone, DoubleFrame(8, 8)), 1e-12);
}

TEST(SensorNoiseBlockQuantisation, TheMeanOfABlockIsRoundedToAnEighthOfItsStep)
{
  const DoubleFrame  noise = NormalFrame(80, 64, 5);
  const BlockStepsDn steps = AllSteps(0.8);
  const DoubleFrame  out = QuantiseBlocks(noise, steps, SerialFor);
  for (std::size_t block = 0; block < 80; ++block)
  {
    double before = 0.0;
    double after = 0.0;
    for (std::size_t i = 0; i < 64; ++i)
    {
      before += noise.Row(block / 10 * 8 + i / 8)[block % 10 * 8 + i % 8] / 64.0;
      after += out.Row(block / 10 * 8 + i / 8)[block % 10 * 8 + i % 8] / 64.0;
    }
    EXPECT_NEAR(after, 0.1 * std::round(before / 0.1), 1e-12);
  }
}

TEST(SensorNoiseBlockQuantisation, FineStepsAddTheirVarianceAndCoarseOnesTakeTheNoise)
{
  const DoubleFrame noise = NormalFrame(600, 496, 6); // variance 1 in each coefficient
  const double      error = 5.0 * std::sqrt(2.0 / 280000.0);
  const auto        fine = CovarianceOf(QuantiseBlocks(noise, AllSteps(1.0), SerialFor));
  EXPECT_NEAR(fine.variance, 1.0 + 1.0 / 12.0, 1.1 * error); // Sheppard: to 1e-8 at a step of one sd
  EXPECT_NEAR(fine.horizontal, 0.0, 1.1 * error);
  // With steps of 4 sd a coefficient survives if it is beyond 2: 16 P(|z| > 2), less what lies beyond 6.
  const auto coarse = CovarianceOf(QuantiseBlocks(noise, AllSteps(4.0), SerialFor));
  EXPECT_NEAR(coarse.variance, 16.0 * std::erfc(2.0 / std::sqrt(2.0)), 20.0 * error); // fourth moment 256 P = 11.6
}

TEST(SensorNoiseBlockQuantisation, StepsAreThoseOfLibjpeg)
{
  // Table K.1 as it is at quality 50; then scaled in whole numbers.
  const BlockStepsDn half = StepsOfQuality({ 50 }, 8);
  EXPECT_EQ(half[0], 16.0);
  EXPECT_EQ(half[1], 11.0);
  EXPECT_EQ(half[8], 12.0);
  EXPECT_EQ(half[63], 99.0);
  EXPECT_EQ(*std::max_element(half.begin(), half.end()), 121.0);
  EXPECT_EQ(StepsOfQuality({ 75 }, 8)[0], 8.0);   // (16 * 50 + 50) / 100
  EXPECT_EQ(StepsOfQuality({ 75 }, 8)[63], 50.0); // (99 * 50 + 50) / 100
  EXPECT_EQ(StepsOfQuality({ 95 }, 8)[63], 10.0); // (99 * 10 + 50) / 100
  EXPECT_EQ(StepsOfQuality({ 10 }, 8)[63], 255.0);
  const BlockStepsDn best = StepsOfQuality({ 100 }, 8);
  EXPECT_EQ(std::set<double>(best.begin(), best.end()), std::set<double>{ 1.0 });
  // For 12 bits, the whole DN range becomes the range of 8 bits.
  EXPECT_DOUBLE_EQ(StepsOfQuality({ 50 }, 12)[0], 16.0 * 4095.0 / 255.0);
}

TEST(SensorNoiseBlockQuantisation, SameBitsForAnyNumberOfThreadsAndBadSettingsAreRefused)
{
  const DoubleFrame noise = NormalFrame(61, 53, 8);
  EXPECT_EQ(QuantiseBlocks(noise, AllSteps(0.7), Threads(3)).values,
            QuantiseBlocks(noise, AllSteps(0.7), SerialFor).values);
  EXPECT_THROW(CheckSettings(BlockSettings{ 101 }, 12), std::invalid_argument);
  EXPECT_THROW(CheckSettings(BlockSettings{ 90 }, 0), std::invalid_argument);
  EXPECT_NO_THROW(CheckSettings(BlockSettings{}, 0));
  EXPECT_FALSE(BlockSettings{}.IsOn());
}
