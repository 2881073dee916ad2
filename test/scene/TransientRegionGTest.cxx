// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/UsablePixels.h"
#include "base/Stencils.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "helpers/FrameTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Size = 192;
constexpr double      Dof = 39.0;

/** Function that returns the addition to the variance [DN^2] of a pixel with the level \a meanDn at (x, y), in units of
 * the size of the frame. */
using Excess = std::function<double(double x, double y, double meanDn)>;

/** Returns a frame with noise, flicker and motion, and with the scatter of 40 frames. */
ReferenceFrame
FrameWith(const Excess & excess, std::size_t size = Size)
{
  InitialNoiseModel truth;
  truth.darkestDn = 300.0;
  truth.interceptDn2 = 300.0;
  truth.slopeDn = 1.5;
  truth.flickerVariance = 2e-3;
  truth.vibrationXPixels2 = 0.01;
  truth.vibrationYPixels2 = 0.003;
  ReferenceFrame            frame = SyntheticFrames(size, size, std::vector<FrameChange>(40)).reference;
  std::mt19937              random(5);
  std::gamma_distribution<> gamma(0.5 * Dof, 2.0);
  const auto &              stencils = MotionStencils();
  for (std::size_t p = 0; p < frame.mean.size(); ++p)
  {
    if (frame.usable[p] != 0)
    {
      const double x = static_cast<double>(p % size) / static_cast<double>(size);
      const double y = static_cast<double>(p / size) / static_cast<double>(size);
      const double gx = ApplyStencil(stencils[StencilX], frame.mean.data(), size, p);
      const double gy = ApplyStencil(stencils[StencilY], frame.mean.data(), size, p);
      const double variance = truth.RawVariance(frame.neighbourMean[p], gx, gy) + excess(x, y, frame.mean[p]);
      frame.variance.Set(p, gamma(random) * variance / Dof);
    }
  }
  return frame;
}

std::vector<std::uint8_t>
FindIn(const ReferenceFrame & frame)
{
  return FindTransientRegion(frame, FitInitialNoiseModel(frame), {});
}

/** Returns the variance of an object of 1,000 DN that hides every pixel it reaches for a quarter of the burst. */
double
Hidden(double meanDn)
{
  return 0.25 / 0.75 * (meanDn - 1000.0) * (meanDn - 1000.0) + 3e4;
}

/** Returns the fraction of the pixels between two heights that are in the region. */
double
FractionOfRows(const std::vector<std::uint8_t> & region, double top, double bottom)
{
  const auto size = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(region.size()))));
  double     count = 0.0;
  double     all = 0.0;
  for (std::size_t p = 0; p < region.size(); ++p)
  {
    const double y = static_cast<double>(p / size) / static_cast<double>(size);
    count += y >= top && y < bottom ? region[p] : 0;
    all += y >= top && y < bottom ? 1.0 : 0.0;
  }
  return count / all;
}
} // namespace

TEST(SensorNoiseTransientRegion, StaticSceneHasNone)
{
  EXPECT_TRUE(FindIn(FrameWith([](double, double, double) { return 0.0; })).empty());
}

TEST(SensorNoiseTransientRegion, IsFoundWhereItCoversMostOfTheFrame)
{
  for (const double top : { 1.0 / 3.0, 0.25, 0.5 })
  {
    const auto region =
      FindIn(FrameWith([top](double, double y, double mean) { return y >= top ? Hidden(mean) : 0.0; }));
    ASSERT_FALSE(region.empty()) << top;
    EXPECT_EQ(FractionOfRows(region, top, 1.0), 1.0) << top;
    EXPECT_LT(FractionOfRows(region, 0.0, top - 2.0 / 24.0), 0.05) << top; // the tiles beside the region
  }
}

TEST(SensorNoiseTransientRegion, ThingAsBrightAsWhatItHidesLeavesNoIslands)
{
  const auto region = FindIn(FrameWith([](double x, double y, double mean) {
    const bool isIsland = std::hypot(x - 0.5, y - 0.7) < 0.06;
    return y >= 1.0 / 3.0 && !isIsland ? Hidden(mean) : 0.0;
  }));
  ASSERT_FALSE(region.empty());
  EXPECT_EQ(FractionOfRows(region, 1.0 / 3.0, 1.0), 1.0);
}

TEST(SensorNoiseTransientRegion, VerdictDoesNotDependOnTheNumberOfPixels)
{
  for (const std::size_t size : { std::size_t{ 96 }, std::size_t{ 384 } })
  {
    const auto region =
      FindIn(FrameWith([](double, double y, double mean) { return y >= 1.0 / 3.0 ? Hidden(mean) : 0.0; }, size));
    ASSERT_FALSE(region.empty()) << size;
    EXPECT_EQ(FractionOfRows(region, 1.0 / 3.0, 1.0), 1.0) << size;
    EXPECT_LT(FractionOfRows(region, 0.0, 1.0 / 3.0 - 0.17), 0.05) << size; // two tiles of 12 in the small frame
    EXPECT_TRUE(FindIn(FrameWith([](double, double, double) { return 0.0; }, size)).empty()) << size;
  }
}

TEST(SensorNoiseTransientRegion, LocalIlluminationIsNoMovingObject)
{
  // A third of the frame has steady illumination, the rest flickers by 9 %.
  EXPECT_TRUE(FindIn(FrameWith([](double, double y, double mean) {
                const double signal = mean - 300.0;
                return y >= 1.0 / 3.0 ? 0.0081 * signal * signal : 0.0;
              }))
                .empty());
}

// Half of a sensor has twice the noise of the other half, in the dark and in the light.
TEST(SensorNoiseTransientRegion, NoiseThatNeighboursDoNotShareIsNoMovingObject)
{
  const ReferenceFrame frame = FrameWith([](double, double y, double) { return y >= 0.5 ? 2e4 : 0.0; });
  const auto           model = FitInitialNoiseModel(frame);
  const auto           found = [&](double together) {
    std::vector<CellVariance> cells;
    for (std::size_t i = 0; i < 256; ++i)
    {
      const std::size_t p = (i / 16 * 12 + 6) * Size + i % 16 * 12 + 6;
      const double      excess = i / 16 >= 8 ? 2e4 : 0.0;
      cells.push_back({ p, model.RawVariance(frame.neighbourMean[p], 0.0, 0.0) + together * excess });
    }
    return FindTransientRegion(frame, model, cells);
  };
  EXPECT_FALSE(FindTransientRegion(frame, model, {}).empty()); // by its variance alone it would be one
  EXPECT_TRUE(found(1.0).empty());
  EXPECT_FALSE(found(8.0).empty());
}

TEST(SensorNoiseTransientRegion, SmallThingsAreLeftToTheLaterPasses)
{
  EXPECT_TRUE(FindIn(FrameWith([](double x, double y, double mean) {
                return std::hypot(x - 0.5, y - 0.5) < 0.15 ? Hidden(mean) : 0.0;
              }))
                .empty());
}

TEST(SensorNoiseTransientRegion, MostlyMovingFrameIsNotMasked)
{
  // A corner of 6 % is static; half of it is not next to moving pixels.
  EXPECT_TRUE(FindIn(FrameWith([](double x, double y, double mean) {
                const double stripe = std::fmod(10.0 * (x + y), 2.0) < 1.0 ? 1.0 : 6.0;
                return std::max(x, y) > 0.24 ? stripe * Hidden(mean) : 0.0;
              }))
                .empty());
}
