// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"
#include "correlation/ProcessingSigns.h"
#include "helpers/CorrelationTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::correlation;

namespace
{
const FrameGeometry   Frame{ 128, 128, 1 };
constexpr std::size_t Frames = 40;

NoiseResiduals
Residuals(const FrameOf & frameOf)
{
  return ComputeResiduals(Frame, Frames, std::vector<double>(Frame.Pixels(), 100.0), frameOf);
}

/** Returns white noise minus its mean over each \a length pixels of a row, from column \a first on, as after a
 * compression that drops the mean of each block. */
FrameOf
WithoutMeans(std::size_t length, std::size_t first)
{
  const FrameOf white = WhiteNoise(Frame, 5);
  return [=](std::size_t t) {
    DoubleFrame frame = white(t);
    for (std::size_t y = 0; y < Frame.height; ++y)
    {
      for (std::size_t x = first; x + length <= Frame.width; x += length)
      {
        double * row = frame.values.data() + y * Frame.width + x;
        double   mean = 0.0;
        for (std::size_t k = 0; k < length; ++k)
        {
          mean += row[k] / static_cast<double>(length);
        }
        for (std::size_t k = 0; k < length; ++k)
        {
          row[k] -= mean;
        }
      }
    }
    return frame;
  };
}

double
Coefficient(const std::vector<BlockPhases> & tiles, std::size_t k)
{
  BlockPhases sum;
  for (const BlockPhases & tile : tiles)
  {
    sum += tile;
  }
  return sum.covariance[k] / sum.pairs[k];
}

/** Returns white samples, enlarged along x by linear interpolation. The first sample is 0.5 / ratio - 0.5 from pixel 0.
 */
FrameOf
Enlarged(double ratio)
{
  const FrameOf white = WhiteNoise(Frame, 7);
  return [=](std::size_t t) {
    const DoubleFrame in = white(t);
    DoubleFrame       out = in;
    for (std::size_t p = 0; p < Frame.Pixels(); ++p)
    {
      const double at = (static_cast<double>(p % Frame.width) + 0.5) / ratio + 0.5;
      const auto   first = static_cast<std::size_t>(at);
      const double part = at - static_cast<double>(first);
      const auto   row = in.values.begin() + static_cast<std::ptrdiff_t>(p / Frame.width * Frame.width + first);
      out.values[p] = (1.0 - part) * row[0] + part * row[1];
    }
    return out;
  };
}

/** Replaces every other pixel, as on a chessboard, by the mean of its four neighbours: the green plane of an
 * interpolated mosaic. */
DoubleFrame
InterpolateMosaic(const DoubleFrame & in)
{
  DoubleFrame out = in;
  for (std::size_t y = 1; y + 1 < Frame.height; ++y)
  {
    for (std::size_t x = 1 + y % 2; x + 1 < Frame.width; x += 2)
    {
      const std::size_t p = y * Frame.width + x;
      out.values[p] =
        0.25 * (in.values[p - 1] + in.values[p + 1] + in.values[p - Frame.width] + in.values[p + Frame.width]);
    }
  }
  return out;
}

/** Applies a running mean of two pixels and doubles the odd columns: a filter, with columns of different noise. */
DoubleFrame
FilterUnlikeColumns(const DoubleFrame & in)
{
  DoubleFrame out = in;
  for (std::size_t p = 1; p < Frame.Pixels(); ++p)
  {
    out.values[p] = (p % 2 == 0 ? 1.0 : 2.0) * (in.values[p] + in.values[p - 1]);
  }
  return out;
}

/** Five standard deviations of a coefficient [1]: from an eighth of 128^2 pixels, with 39 degrees of freedom. */
const double Tolerance = 5.0 / std::sqrt(128.0 * 128.0 / 8.0 * 39.0);
} // namespace

TEST(SensorNoiseBlockPhases, WhiteNoiseHasNoPlace)
{
  const auto tiles = SumBlockPhases(Residuals(WhiteNoise(Frame, 3)), SerialFor);
  for (std::size_t k = 0; k < 2 * BlockPhases::Period; ++k)
  {
    EXPECT_NEAR(Coefficient(tiles, k), 0.0, Tolerance) << k;
  }
  EXPECT_EQ(RmsOfPhases(tiles), 0.0);
}

TEST(SensorNoiseBlockPhases, MeansOfBlocksCorrelateNeighboursOfOneBlockOnly)
{
  // The variance is 7/8, the covariance within a block -1/8.
  for (const std::size_t first : { std::size_t{ 0 }, std::size_t{ 3 } })
  {
    const auto tiles = SumBlockPhases(Residuals(WithoutMeans(8, first)), SerialFor);
    for (std::size_t k = 0; k < BlockPhases::Period; ++k)
    {
      const double expected = k == (first + 7) % 8 ? 0.0 : -1.0 / 7.0;
      EXPECT_NEAR(Coefficient(tiles, k), expected, Tolerance + 0.01)
        << first << " " << k; // some pixels are in no block
      EXPECT_NEAR(Coefficient(tiles, BlockPhases::Period + k), 0.0, Tolerance) << first << " " << k;
    }
    // The deviations from the mean of the axis, -1/8, are 1/56 for seven phases and 1/8 for one, of sixteen phases. The
    // part of chance is subtracted, and up to a sixteenth of the pixels is in no block.
    EXPECT_NEAR(RmsOfPhases(tiles), std::sqrt((7.0 / (56.0 * 56.0) + 1.0 / 64.0) / 16.0), 0.004) << first;
  }
}

TEST(SensorNoiseBlockPhases, BlocksThatDropTheirMeanAreNotLinearWhateverTheirLength)
{
  for (const std::size_t length : { std::size_t{ 4 }, std::size_t{ 8 }, std::size_t{ 16 } })
  {
    const NoiseCorrelation found = MeasureNoiseCorrelation(Residuals(WithoutMeans(length, 0)), 0.0, SerialFor);
    EXPECT_EQ(found.kind, NoiseKind::NotLinear) << length;
  }
}

TEST(SensorNoiseBlockPhases, SharpenedFramesAreFiltered)
{
  const FrameOf white = WhiteNoise(Frame, 9);
  const FrameOf sharpened = [=](std::size_t t) {
    const DoubleFrame in = white(t);
    DoubleFrame       out = in;
    for (std::size_t p = 1; p + 1 < in.values.size(); ++p)
    {
      out.values[p] = 1.2 * in.values[p] - 0.1 * (in.values[p - 1] + in.values[p + 1]);
    }
    return out;
  };
  // In a flat field neither the signal nor the place distinguishes rounding from a filter: the class is filtered.
  const auto tiles = SumBlockPhases(Residuals(sharpened), SerialFor);
  EXPECT_EQ(RmsOfPhases(tiles), 0.0);
  for (std::size_t k = 0; k < BlockPhases::Period; ++k)
  {
    EXPECT_NEAR(Coefficient(tiles, k), -0.24 / 1.46, Tolerance) << k;
  }
}

TEST(SensorNoiseEnlargementTrace, TwiceTheSizeAlternates)
{
  const auto trace = FindEnlargementTrace(Residuals(Enlarged(2.0)), SerialFor);
  ASSERT_TRUE(trace);
  // Pixels with the weights 3/4 and 1/4 have the variance 5/8; the covariance alternates between 3/8 and 9/16.
  EXPECT_EQ(trace->lag, 1);
  EXPECT_TRUE(trace->isAlongX);
  EXPECT_FALSE(trace->isAlternating);
  EXPECT_EQ(trace->cyclesPerPixel, 0.5);
  EXPECT_NEAR(trace->amplitude, 0.5 * (9.0 / 16.0 - 3.0 / 8.0) / 0.625, 0.01);
}

TEST(SensorNoiseEnlargementTrace, AnyRatioLeavesItsFrequency)
{
  for (const double ratio : { 1.25, 1.37, 1.6, 2.5, 3.0, 4.0 })
  {
    const auto trace = FindEnlargementTrace(Residuals(Enlarged(ratio)), SerialFor);
    ASSERT_TRUE(trace) << ratio;
    const double cycles = 1.0 / ratio < 0.5 ? 1.0 / ratio : 1.0 - 1.0 / ratio;
    EXPECT_NEAR(trace->cyclesPerPixel, cycles, 1.0 / 128.0) << ratio;
    EXPECT_GT(trace->amplitude, 0.1) << ratio;
  }
}

TEST(SensorNoiseEnlargementTrace, InterpolatedMosaicAlternatesInEveryOtherLine)
{
  const FrameOf white = WhiteNoise(Frame, 8);
  const auto    trace =
    FindEnlargementTrace(Residuals([&](std::size_t t) { return InterpolateMosaic(white(t)); }), SerialFor);
  ASSERT_TRUE(trace);
  EXPECT_EQ(trace->lag, 2);
  EXPECT_TRUE(trace->isAlternating);
  EXPECT_EQ(trace->cyclesPerPixel, 0.5);
  // Measured pixels have no covariance. Interpolated pixels have the variance 1/4, and a quarter of it as covariance.
  EXPECT_NEAR(trace->amplitude, 0.125, 0.01);
}

TEST(SensorNoiseEnlargementTrace, WhiteAndFilteredNoiseHaveNone)
{
  const FrameOf white = WhiteNoise(Frame, 9);
  EXPECT_FALSE(FindEnlargementTrace(Residuals(white), SerialFor));
  EXPECT_FALSE(
    FindEnlargementTrace(Residuals([&](std::size_t t) { return FilterUnlikeColumns(white(t)); }), SerialFor));
}

TEST(SensorNoiseEnlargementTrace, FilteredBarsHaveNone)
{
  // Bars of shot noise, 5 pixels apart, in every second block of 8 rows; frames are means of two columns. The
  // coefficients beside the bars have the period of the bars.
  const auto isDark = [](std::size_t p) {
    return p % Frame.width % 5 < 2 && p / Frame.width / 8 % 2 == 0 && p % Frame.width + 1 < Frame.width;
  };
  const auto average = [](std::vector<double> values) {
    for (std::size_t p = 0; p + 1 < values.size(); ++p)
    {
      values[p] = 0.5 * (values[p] + values[p + 1]);
    }
    return values;
  };
  std::vector<double> electrons(Frame.Pixels());
  for (std::size_t p = 0; p < electrons.size(); ++p)
  {
    electrons[p] = isDark(p) ? 20.0 : 400.0;
  }
  const FrameOf white = WhiteNoise(Frame, 10);
  const FrameOf filtered = [&](std::size_t t) {
    DoubleFrame frame = white(t);
    for (std::size_t p = 0; p < electrons.size(); ++p)
    {
      frame.values[p] *= std::sqrt(electrons[p]);
    }
    frame.values = average(frame.values);
    return frame;
  };
  const NoiseResiduals residuals = ComputeResiduals(Frame, Frames, average(electrons), filtered);
  EXPECT_FALSE(FindEnlargementTrace(residuals, SerialFor));
  EXPECT_NE(MeasureNoiseCorrelation(residuals, 0.0, SerialFor).kind, NoiseKind::Enlarged);
}

TEST(SensorNoiseEnlargementTrace, MakesTheKind)
{
  const auto found = MeasureNoiseCorrelation(Residuals(Enlarged(2.0)), 0.0, SerialFor);
  EXPECT_EQ(found.kind, NoiseKind::Enlarged);
  EXPECT_TRUE(found.enlargement);
  EXPECT_STREQ(NameOf(found.kind), "enlarged");
}
