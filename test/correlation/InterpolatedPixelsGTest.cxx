// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/ProcessingSigns.h"
#include "helpers/CorrelationTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

// Pixels that a camera computes from their neighbours: found in white and in filtered noise, and nothing else is.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::correlation;

namespace
{
constexpr FrameGeometry Geometry{ 128, 128, 1 };
constexpr std::size_t   Frames = 30;
constexpr std::size_t   Pitch = 8; // one computed pixel in 64

/** Returns whether pixel \a p is one that Computed() replaces: inside of a tile. */
bool
IsComputed(std::size_t p)
{
  return p % Geometry.width % Pitch == 4 && p / Geometry.width % Pitch == 4;
}

using Compute = std::function<double(const std::vector<double> & values, std::size_t p)>;

/** Returns \a frameOf with pixels that \a compute gives. */
FrameOf
Computed(const FrameOf & frameOf, const Compute & compute)
{
  return [=](std::size_t t) {
    DoubleFrame               frame = frameOf(t);
    const std::vector<double> before = frame.values;
    for (std::size_t p = 0; p < before.size(); ++p)
    {
      frame.values[p] = IsComputed(p) ? compute(before, p) : before[p];
    }
    return frame;
  };
}

double
MeanOfPair(const std::vector<double> & values, std::size_t p)
{
  return 0.5 * (values[p - 1] + values[p + 1]);
}

double
MeanOfFour(const std::vector<double> & values, std::size_t p)
{
  return 0.25 * (values[p - 1] + values[p + 1] + values[p - Geometry.width] + values[p + Geometry.width]);
}

double
MedianOfEight(const std::vector<double> & values, std::size_t p)
{
  const std::size_t   width = Geometry.width;
  std::vector<double> near{
    values[p - width - 1], values[p - width],     values[p - width + 1], values[p - 1],
    values[p + 1],         values[p + width - 1], values[p + width],     values[p + width + 1]
  };
  std::sort(near.begin(), near.end());
  return 0.5 * (near[3] + near[4]);
}

double
CopyOfNeighbour(const std::vector<double> & values, std::size_t p)
{
  return values[p + Geometry.width];
}

/** Returns noise of 1 DN after averaging each pixel with its neighbour on the right. */
DoubleFrame
FilteredFrame(std::size_t t)
{
  DoubleFrame frame = NormalFrame(Geometry.width, Geometry.height, t + 1);
  for (std::size_t p = 0; p + 1 < frame.values.size(); ++p)
  {
    frame.values[p] = 0.5 * (frame.values[p] + frame.values[p + 1]);
  }
  return frame;
}

InterpolatedPixels
FindIn(const FrameOf & frameOf)
{
  return FindInterpolatedPixels(
    ComputeResiduals(Geometry, Frames, std::vector<double>(Geometry.Pixels(), 100.0), frameOf), SerialFor);
}

/** Expects that all computed pixels are found, and few others. The pixels of a pair differ from their mean by a quarter
 * of the noise of independent pixels: chi-square of 29 degrees of freedom is below 0.15 / 0.25 of its mean with a
 * probability of 4.5 %, which makes 23 +- 5 of 512 pixels. */
void
ExpectComputed(const InterpolatedPixels & found)
{
  const auto computed = std::count_if(found.pixels.begin(), found.pixels.end(), IsComputed);
  EXPECT_EQ(computed, static_cast<std::ptrdiff_t>(Geometry.Pixels() / Pitch / Pitch));
  EXPECT_LE(static_cast<std::ptrdiff_t>(found.pixels.size()) - computed, 23 + 4 * 5);
  EXPECT_FALSE(found.notCompared.empty());
}
} // namespace

TEST(SensorNoiseInterpolatedPixels, MeansAndCopiesOfNeighboursAreFound)
{
  const FrameOf white = WhiteNoise(Geometry, 1);
  for (const Compute & compute : { Compute(MeanOfPair), Compute(MeanOfFour), Compute(MedianOfEight) })
  {
    ExpectComputed(FindIn(Computed(white, compute)));
  }
  ExpectComputed(FindIn(Computed(FilteredFrame, MeanOfFour)));
}

TEST(SensorNoiseInterpolatedPixels, OneOfACopyAndItsOriginalIsFound)
{
  const InterpolatedPixels found = FindIn(Computed(WhiteNoise(Geometry, 1), CopyOfNeighbour));
  const std::size_t        copies = Geometry.Pixels() / Pitch / Pitch;
  EXPECT_GE(found.pixels.size(), copies);
  EXPECT_LE(found.pixels.size(), copies + 5);
}

// With both columns of each pair these would be 12.5 %, as of enlarged frames.
TEST(SensorNoiseInterpolatedPixels, CopiedColumnsAreFoundUpToATenthOfThem)
{
  const FrameOf            white = WhiteNoise(Geometry, 1);
  const InterpolatedPixels found = FindIn([&white](std::size_t t) {
    DoubleFrame frame = white(t);
    for (std::size_t p = 0; p < frame.values.size(); ++p)
    {
      frame.values[p] = p % 16 == 5 ? frame.values[p - 1] : frame.values[p];
    }
    return frame;
  });
  const auto               copies =
    std::count_if(found.pixels.begin(), found.pixels.end(), [](std::size_t p) { return p % 16 == 5; });
  EXPECT_GT(copies, static_cast<std::ptrdiff_t>(Geometry.Pixels() / 16 * 7 / 10)); // without the borders of the tiles
  EXPECT_LT(found.pixels.size(), Geometry.Pixels() / 16 + 5);
}

TEST(SensorNoiseInterpolatedPixels, ThePixelsLackTheVarianceOfTheMean)
{
  // A mean of four has a quarter of the variance. Its mean over 256 pixels with 29 degrees of freedom is known to
  // 0.25 sqrt(2 / (256 x 29)) = 0.4 % of the variance of a pixel, the typical variance to 0.2 %.
  const InterpolatedPixels found = FindIn(Computed(WhiteNoise(Geometry, 1), MeanOfFour));
  const double             fraction = 1.0 / (Pitch * Pitch);
  EXPECT_NEAR(found.lostVariance, 0.75 * fraction, 5.0 * 0.005 * fraction + fraction * fraction);
}

TEST(SensorNoiseInterpolatedPixels, NoneAreFoundInNoise)
{
  for (const FrameOf & frameOf : { FrameOf(WhiteNoise(Geometry, 1)), FrameOf(FilteredFrame) })
  {
    const InterpolatedPixels found = FindIn(frameOf);
    EXPECT_TRUE(found.pixels.empty());
    EXPECT_TRUE(found.notCompared.empty());
    EXPECT_EQ(found.lostVariance, 0.0);
  }
}

TEST(SensorNoiseInterpolatedPixels, NoneAreFoundInEnlargedFrames)
{
  const FrameOf enlarged = [](std::size_t t) {
    DoubleFrame frame = NormalFrame(Geometry.width, Geometry.height, t + 1);
    for (std::size_t p = 0; p + 1 < frame.values.size(); p += 2)
    {
      frame.values[p + 1] = p + 2 < frame.values.size() ? 0.5 * (frame.values[p] + frame.values[p + 2]) : 0.0;
    }
    return frame;
  };
  EXPECT_TRUE(FindIn(enlarged).pixels.empty());
}
