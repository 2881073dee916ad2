// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/FrameSample.h"
#include "base/Eigen.h"
#include "correlation/NoiseResiduals.h"
#include "simulation/Random.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t   Frames = 9;
constexpr FrameGeometry Geometry{ 70, 45, 1 };

Stack<std::uint16_t>
RandomStack(std::size_t frames = Frames)
{
  CounterSeededRandom  random(4);
  Stack<std::uint16_t> stack{ Geometry.width, Geometry.height, frames, {} };
  stack.pixels.resize(Geometry.Pixels() * frames);
  std::generate(
    stack.pixels.begin(), stack.pixels.end(), [&] { return static_cast<std::uint16_t>(random.Bits() % 4096); });
  return stack;
}

/** Returns means that are no sums of integers over the frames. */
std::vector<double>
SomeMean()
{
  CounterSeededRandom random(8);
  std::vector<double> mean(Geometry.Pixels());
  std::generate(mean.begin(), mean.end(), [&] { return 4096.0 * random.Uniform(); });
  return mean;
}

template <typename TPixel>
FrameSample
SampleOfStack(const Stack<TPixel> & stack, std::size_t chunk = 1000, const ParallelFor & parallelFor = SerialFor)
{
  auto sample = FrameSample::Of<TPixel>(Geometry, stack.frames);
  for (std::size_t t = 0; t < stack.frames; t += chunk)
  {
    sample.AddFrames(stack.Frame(t), t, std::min(chunk, stack.frames - t), SomeMean(), parallelFor);
  }
  return sample;
}

/** Returns all values, tile after tile. */
std::vector<float>
ValuesOf(const NoiseSample & noise)
{
  return { noise.OfTile(0), noise.OfTile(noise.GetTiles().origins.size()) };
}
std::vector<float>
ValuesOf(FrameSample sample)
{
  return ValuesOf(sample.TakeNoise(SomeMean(), Threads(2)));
}

FrameSample
SampleOfFrames(const Stack<std::uint16_t> & stack, const std::vector<std::size_t> & frames)
{
  auto sample = FrameSample::Of<std::uint16_t>(Geometry, stack.frames);
  for (const std::size_t t : frames)
  {
    sample.AddFrames(stack.Frame(t), t, 1, SomeMean());
  }
  return sample;
}

std::string
Saved(const FrameSample & sample)
{
  std::ostringstream out;
  sample.Save(out);
  return out.str();
}
} // namespace

TEST(SensorNoiseFrameSample, HoldsTheSeriesOfItsPixelsAboveTheirMean)
{
  const auto  stack = RandomStack();
  const auto  mean = SomeMean();
  const auto  sample = SampleOfStack(stack).TakeNoise(mean);
  const auto  tiles = sample.GetTiles();
  std::size_t values = 0;
  ASSERT_EQ(tiles.origins.size(), 8U); // four by two of 16
  for (std::size_t i = 0; i < tiles.origins.size(); ++i)
  {
    for (std::size_t p = 0; p < tiles.Pixels(); ++p)
    {
      const std::size_t x = tiles.origins[i].x + p % 16;
      const std::size_t y = tiles.origins[i].y + p / 16;
      ASSERT_EQ(sample.PixelOf(i, p), y * Geometry.width + x);
      for (std::size_t t = 0; t < Frames; ++t)
      {
        const std::size_t pixel = sample.PixelOf(i, p);
        ASSERT_EQ(sample.OfTile(i)[t * tiles.Pixels() + p], static_cast<float>(stack.Frame(t)[pixel] - mean[pixel]));
        ++values;
      }
    }
  }
  EXPECT_EQ(values, ValuesOf(sample).size());
}

TEST(SensorNoiseFrameSample, SameBitsForAnyChunksThreadsAndTypes)
{
  const auto stack = RandomStack();
  const auto expected = ValuesOf(SampleOfStack(stack));
  for (const std::size_t chunk : { 1, 2, 4, 8 })
  {
    EXPECT_TRUE(HaveSameBits(ValuesOf(SampleOfStack(stack, chunk)), expected)) << chunk;
  }
  EXPECT_TRUE(HaveSameBits(ValuesOf(SampleOfStack(stack, 3, Threads(3))), expected));
  const auto same = [](std::uint16_t u) { return u; };
  EXPECT_TRUE(HaveSameBits(ValuesOf(SampleOfStack(stack.Map<float>(same))), expected));
  EXPECT_TRUE(HaveSameBits(ValuesOf(SampleOfStack(stack.Map<double>(same))), expected));
  EXPECT_TRUE(HaveSameBits(ValuesOf(SampleOfStack(stack.Map<short>(same))), expected));
}

TEST(SensorNoiseFrameSample, SameBitsForFramesAndPartsInAnyOrder)
{
  const auto stack = RandomStack();
  const auto expected = ValuesOf(SampleOfStack(stack));
  EXPECT_TRUE(HaveSameBits(ValuesOf(SampleOfFrames(stack, { 3, 8, 0, 7, 1, 6, 2, 5, 4 })), expected));
  for (const bool isForwards : { false, true })
  {
    auto parts = std::vector<FrameSample>{ SampleOfFrames(stack, { 0, 4, 8 }),
                                           SampleOfFrames(stack, { 1, 2 }),
                                           SampleOfFrames(stack, {}),
                                           SampleOfFrames(stack, { 3, 5, 6, 7 }) };
    if (!isForwards)
    {
      std::reverse(parts.begin(), parts.end());
    }
    for (std::size_t k = 1; k < parts.size(); ++k)
    {
      parts[0].Merge(parts[k]);
    }
    EXPECT_TRUE(HaveSameBits(ValuesOf(parts[0]), expected)) << isForwards;
  }
}

TEST(SensorNoiseFrameSample, SavedSampleIsRestoredBitByBit)
{
  const auto         sample = SampleOfStack(RandomStack());
  auto               restored = FrameSample::Of<std::uint16_t>(Geometry, Frames);
  std::istringstream in(Saved(sample));
  restored.Restore(in);
  EXPECT_TRUE(HaveSameBits(ValuesOf(restored), ValuesOf(sample)));
}

TEST(SensorNoiseFrameSample, OtherAndCutSamplesAreRefusedAndChangeNothing)
{
  auto              sample = SampleOfStack(RandomStack());
  const auto        expected = ValuesOf(sample);
  const std::string saved = Saved(sample);
  for (const std::string & bad : { saved.substr(0, saved.size() - 4),
                                   saved.substr(0, 5),
                                   std::string("no sums at all, but long enough to be some"),
                                   Saved(FrameSample::Of<short>(Geometry, Frames + 1)),
                                   Saved(FrameSample::Of<short>({ 70, 46, 1 }, Frames)) })
  {
    std::istringstream in(bad);
    EXPECT_THROW(sample.Restore(in), std::runtime_error);
    EXPECT_TRUE(HaveSameBits(ValuesOf(sample), expected));
  }
  EXPECT_THROW(sample.Merge(FrameSample::Of<short>(Geometry, Frames + 1)), std::invalid_argument);
  EXPECT_THROW(sample.Merge(FrameSample::Of<short>({ 70, 46, 1 }, Frames)), std::invalid_argument);
  EXPECT_THROW(sample.Merge(FrameSample::Of<float>(Geometry, Frames)), std::invalid_argument);
  EXPECT_TRUE(HaveSameBits(ValuesOf(sample), expected));
}

TEST(SensorNoiseFrameSample, WhatIsTakenBackIsNotThere)
{
  auto sample = SampleOfStack(RandomStack());
  sample.Clear();
  sample.Merge(SampleOfStack(RandomStack()));
  EXPECT_TRUE(HaveSameBits(ValuesOf(sample), ValuesOf(SampleOfStack(RandomStack()))));
}

TEST(SensorNoiseFrameSample, WhatIsNotFiniteIsNoNoise)
{
  auto              stack = RandomStack().Map<float>([](std::uint16_t u) { return u; });
  auto              expected = ValuesOf(SampleOfStack(stack));
  const NoiseSample noise = SampleOfStack(stack).TakeNoise(SomeMean());
  stack.pixels[noise.PixelOf(1, 7)] = std::numeric_limits<float>::quiet_NaN(); // in frame 0
  stack.pixels[noise.PixelOf(2, 3)] = std::numeric_limits<float>::infinity();
  expected[noise.GetTiles().PlaceOf(1, 0) + 7] = 0.0F;
  expected[noise.GetTiles().PlaceOf(2, 0) + 3] = 0.0F;
  EXPECT_TRUE(HaveSameBits(ValuesOf(SampleOfStack(stack)), expected));
}

TEST(SensorNoiseFrameSample, PixelsWithoutAMeanHaveNoNoise)
{
  std::vector<double> mean = SomeMean();
  auto                expected = ValuesOf(SampleOfStack(RandomStack()));
  const NoiseSample   known = SampleOfStack(RandomStack()).TakeNoise(mean);
  mean[known.PixelOf(1, 7)] = std::numeric_limits<double>::quiet_NaN();
  const NoiseSample noise = SampleOfStack(RandomStack()).TakeNoise(mean);
  for (std::size_t t = 0; t < Frames; ++t)
  {
    expected[noise.GetTiles().PlaceOf(1, t) + 7] = 0.0F;
  }
  EXPECT_TRUE(HaveSameBits(ValuesOf(noise), expected));
}

TEST(SensorNoiseFrameSample, ResidualsAreThoseOfTheNoiseTaken)
{
  const std::vector<double>       mean = SomeMean();
  const std::vector<std::uint8_t> take(mean.size(), 1);
  const Eigen::MatrixXd           series = Eigen::VectorXd::LinSpaced(Frames, -1.0, 1.0);
  const auto                      expectSame = [&](const auto & stack) {
    const NoiseResiduals expected(SampleOfStack(stack).TakeNoise(mean), series, { mean, take, 100.0 }, SerialFor);
    const NoiseResiduals residuals(SampleOfStack(stack), series, { mean, take, 100.0 }, Threads(3));
    const std::size_t    tiles = expected.GetTiles().origins.size();
    EXPECT_TRUE(HaveSameBits(std::vector<float>(residuals.OfTile(0), residuals.OfTile(tiles)),
                             std::vector<float>(expected.OfTile(0), expected.OfTile(tiles))));
    EXPECT_TRUE(HaveSameBits(std::vector<float>(residuals.WeightOf(0), residuals.WeightOf(tiles)),
                             std::vector<float>(expected.WeightOf(0), expected.WeightOf(tiles))));
  };
  expectSame(RandomStack());
  expectSame(RandomStack().Map<float>([](std::uint16_t u) { return u; }));
}

TEST(SensorNoiseFrameSample, LongStacksLeaveTheirFirstFrames)
{
  const auto           stack = RandomStack(SampleTiles::MostFrames + 5);
  const auto           expected = ValuesOf(SampleOfStack(stack, 7));
  Stack<std::uint16_t> first = stack;
  first.frames = SampleTiles::MostFrames;
  EXPECT_TRUE(HaveSameBits(ValuesOf(SampleOfStack(first)), expected));
}

TEST(SensorNoiseFrameSample, FirstFramesCanBeLeftOut)
{
  NoiseSample sample = SampleOfStack(RandomStack()).TakeNoise(SomeMean());
  const auto  whole = sample;
  sample.DropFirst(4);
  const std::size_t pixels = sample.GetTiles().Pixels();
  ASSERT_EQ(sample.GetTiles().frames, Frames - 4);
  ASSERT_EQ(ValuesOf(sample).size(), 8 * 5 * pixels);
  for (std::size_t i = 0; i < sample.GetTiles().origins.size(); ++i)
  {
    EXPECT_TRUE(std::equal(sample.OfTile(i), sample.OfTile(i) + 5 * pixels, whole.OfTile(i) + 4 * pixels)) << i;
  }
}
