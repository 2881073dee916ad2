// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/PositionDependence.h"
#include "correlation/NoiseCorrelation.h"
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
} // namespace

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

TEST(SensorNoiseEnlargementTrace, MakesTheKind)
{
  const auto found = MeasureNoiseCorrelation(Residuals(Enlarged(2.0)), 0.0, SerialFor);
  EXPECT_EQ(found.kind, NoiseKind::Enlarged);
  EXPECT_TRUE(found.enlargement);
  EXPECT_STREQ(NameOf(found.kind), "enlarged");
}
