// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FrameProcessing.h"
#include "helpers/FrameNoiseTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
DoubleFrame
NoiseOf(std::size_t frame)
{
  return NormalFrame(100, 80, 1000 + frame);
}

double
MeanProduct(const DoubleFrame & a, const DoubleFrame & b)
{
  double sum = 0.0;
  for (std::size_t pixel = 0; pixel < a.values.size(); ++pixel)
  {
    sum += a.values[pixel] * b.values[pixel];
  }
  return sum / static_cast<double>(a.values.size());
}
} // namespace

TEST(SensorNoiseTemporalFilter, EachFrameBlendsTheInputWithTheLastOutput)
{
  TemporalFilter    filter({ 0.25 });
  const DoubleFrame first = filter.OutputFrame(0, NoiseOf, SerialFor);
  const DoubleFrame second = filter.OutputFrame(1, NoiseOf, SerialFor);
  EXPECT_EQ(first.values, NoiseOf(0).values);
  for (std::size_t pixel = 0; pixel < first.values.size(); ++pixel)
  {
    EXPECT_EQ(second.values[pixel], 0.75 * NoiseOf(1).values[pixel] + 0.25 * first.values[pixel]) << pixel;
    pixel += 500;
  }
}

TEST(SensorNoiseTemporalFilter, WhiteNoiseKeepsItsVarianceFractionAndFramesCorrelate)
{
  constexpr double a = 0.5;
  TemporalFilter   filter({ a });
  // From frame 12 on a^(2 t) is below 1e-7.
  std::vector<DoubleFrame> frames;
  double                   variance = 0.0;
  double                   lagOne = 0.0;
  double                   lagTwo = 0.0;
  for (std::size_t t = 12; t < 52; ++t)
  {
    frames.push_back(filter.OutputFrame(t, NoiseOf, SerialFor));
    variance += MeanProduct(frames.back(), frames.back()) / 40.0;
    lagOne += frames.size() > 1 ? MeanProduct(frames.back(), frames[frames.size() - 2]) / 39.0 : 0.0;
    lagTwo += frames.size() > 2 ? MeanProduct(frames.back(), frames[frames.size() - 3]) / 38.0 : 0.0;
  }
  const double expected = (1.0 - a) / (1.0 + a);
  // 320000 numbers, whose neighbouring frames correlate: (1 + a^2) / (1 - a^2) = 1.67 times the variance.
  const double error = 5.0 * expected * std::sqrt(2.0 * 1.67 / 320000.0);
  EXPECT_NEAR(variance, expected, error);
  EXPECT_NEAR(lagOne, a * expected, error);
  EXPECT_NEAR(lagTwo, a * a * expected, error);
}

TEST(SensorNoiseTemporalFilter, AnyOrderGivesTheSameBits)
{
  TemporalFilter           inOrder({ 0.7 });
  std::vector<DoubleFrame> expected;
  for (std::size_t t = 0; t < 8; ++t)
  {
    expected.push_back(inOrder.OutputFrame(t, NoiseOf, SerialFor));
  }
  TemporalFilter filter({ 0.7 });
  for (const std::size_t t : { 5, 5, 2, 7, 0, 1, 6 })
  {
    EXPECT_EQ(filter.OutputFrame(t, NoiseOf, Threads(3)).values, expected[t].values) << t;
  }
}

TEST(SensorNoiseTemporalFilter, FramesInOrderCostOneInputEach)
{
  int        inputs = 0;
  const auto count = [&inputs](std::size_t frame) {
    ++inputs;
    return NoiseOf(frame);
  };
  TemporalFilter filter({ 0.5 });
  for (std::size_t t = 0; t < 10; ++t)
  {
    filter.OutputFrame(t, count, SerialFor);
    EXPECT_EQ(inputs, static_cast<int>(t) + 1);
  }
}

TEST(SensorNoiseTemporalFilter, BadSettingsAreRefused)
{
  EXPECT_THROW(CheckSettings(TemporalFilterSettings{ 1.0 }), std::invalid_argument);
  EXPECT_THROW(CheckSettings(TemporalFilterSettings{ -0.1 }), std::invalid_argument);
  EXPECT_NO_THROW(CheckSettings(TemporalFilterSettings{ 0.99 }));
}
