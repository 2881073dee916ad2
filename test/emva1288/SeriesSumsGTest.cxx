// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EvaluationSteps.h"
#include "helpers/EmvaTestHelper.h"
#include "helpers/StackTestHelper.h"
#include "simulation/Random.h"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::emva;

namespace
{
constexpr std::size_t Width = 26;
constexpr std::size_t Height = 23;

/** Returns frames of numbers around 1000 DN, with a pattern, temporal noise, and a level of each frame. */
std::vector<std::vector<double>>
MakeFrames(std::size_t count)
{
  std::vector<std::vector<double>> frames(count, std::vector<double>(Width * Height));
  for (std::size_t p = 0; p < Width * Height; ++p)
  {
    CounterSeededRandom random(5, 0, p);
    const double        pattern = 1000.0 + 4.0 * random.Normal();
    for (std::size_t t = 0; t < count; ++t)
    {
      frames[t][p] = pattern + 3.0 * static_cast<double>(t * t) + 7.0 * random.Normal();
    }
  }
  return frames;
}

double
MeanOf(const std::vector<double> & values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

/** Returns equation (18): half of the mean square difference of two frames, less half of the squared difference of
 * their means. */
double
PairVariance(const std::vector<double> & a, const std::vector<double> & b)
{
  double squares = 0.0;
  for (std::size_t p = 0; p < a.size(); ++p)
  {
    squares += (a[p] - b[p]) * (a[p] - b[p]);
  }
  const double difference = MeanOf(a) - MeanOf(b);
  return 0.5 * squares / static_cast<double>(a.size()) - 0.5 * difference * difference;
}

/** Returns the mean over the pixels of their variance over the frames (65). */
double
MeanPixelVariance(const std::vector<std::vector<double>> & frames)
{
  double sum = 0.0;
  for (std::size_t p = 0; p < frames.front().size(); ++p)
  {
    std::vector<double> values;
    for (const std::vector<double> & frame : frames)
    {
      values.push_back(frame[p]);
    }
    const double mean = MeanOf(values);
    for (const double value : values)
    {
      sum += (value - mean) * (value - mean) / (static_cast<double>(values.size()) - 1.0);
    }
  }
  return sum / static_cast<double>(frames.front().size());
}
} // namespace

TEST(SensorNoiseEmvaSeries, APairHasTheMeanAndTheVarianceOfTheStandard)
{
  const auto       frames = MakeFrames(2);
  const EmvaSeries series = SeriesOf(frames, Width, Height);
  EXPECT_NEAR(series.meanDn, 0.5 * (MeanOf(frames[0]) + MeanOf(frames[1])), 1e-10);
  EXPECT_NEAR(series.temporalVarianceDn2, PairVariance(frames[0], frames[1]), 1e-8);
  EXPECT_EQ(series.frames, 2U);
}

TEST(SensorNoiseEmvaSeries, MoreFramesHaveTheMeanVarianceOfAllPairs)
{
  const auto frames = MakeFrames(5);
  double     sum = 0.0;
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      sum += PairVariance(frames[i], frames[j]) / 10.0;
    }
  }
  EXPECT_NEAR(SeriesOf(frames, Width, Height).temporalVarianceDn2, sum, 1e-8);
}

TEST(SensorNoiseEmvaSeries, TheStackVarianceIsThatOfTheFramesBeforeAndAfterTheFilter)
{
  const auto                       frames = MakeFrames(4);
  const EmvaSeries                 series = SeriesOf(frames, Width, Height);
  std::vector<std::vector<double>> filtered;
  for (const std::vector<double> & frame : frames)
  {
    filtered.push_back(FilterHighpass(frame, Width, Height).pixels);
  }
  EXPECT_NEAR(series.unfiltered.stackDn2, MeanPixelVariance(frames), 1e-7);
  ASSERT_TRUE(series.highpass);
  EXPECT_NEAR(series.highpass->stackDn2, MeanPixelVariance(filtered), 1e-7);
  EXPECT_EQ(series.highpass->columns, Width - 18);
}

TEST(SensorNoiseEmvaSeries, CountsTheValuesAtTheHighestNumber)
{
  std::vector<std::vector<std::uint8_t>> frames(2, std::vector<std::uint8_t>(Width * Height, 7));
  frames[0][9] = frames[0][11] = 200; // the highest number of the first frame alone
  frames[1][2] = frames[1][3] = frames[1][500] = 255;
  const EmvaSeries series = SeriesOf(frames, Width, Height);
  EXPECT_EQ(series.highestDn, 255.0);
  EXPECT_DOUBLE_EQ(series.fractionAtHighest, 3.0 / (2.0 * Width * Height));
}

TEST(SensorNoiseEmvaSeries, HasTheSameBitsForAnyNumberOfThreads)
{
  std::vector<double> frame(200 * 150);
  EmvaSeriesSums      serial(200, 150);
  EmvaSeriesSums      threaded(200, 150);
  for (std::size_t t = 0; t < 3; ++t)
  {
    CounterSeededRandom random(8, t);
    for (double & value : frame)
    {
      value = 100.0 + random.Normal();
    }
    serial.AddFrame(frame.data());
    threaded.AddFrame(frame.data(), Threads(3));
  }
  const EmvaSeries a = serial.Measure();
  const EmvaSeries b = threaded.Measure(Threads(2));
  EXPECT_EQ(a.temporalVarianceDn2, b.temporalVarianceDn2);
  EXPECT_EQ(a.fractionAtHighest, b.fractionAtHighest);
  EXPECT_EQ(a.highpass->totalDn2, b.highpass->totalDn2);
}

TEST(SensorNoiseEmvaSeries, RefusesWhatIsNoSeries)
{
  EXPECT_THROW(EmvaSeriesSums(2, 9), std::invalid_argument);
  EmvaSeriesSums      sums(3, 3);
  std::vector<double> frame(9, 1.0);
  sums.AddFrame(frame.data());
  EXPECT_THROW(sums.Measure(), std::invalid_argument);
  frame[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(sums.AddFrame(frame.data()), std::invalid_argument);
}
