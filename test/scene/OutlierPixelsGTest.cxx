// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/UsablePixels.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "sensornoise/Parallel.h"
#include "helpers/FrameTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 60;
constexpr std::size_t Height = 50;

std::size_t
Count(const std::vector<std::uint8_t> & map)
{
  return static_cast<std::size_t>(std::count(map.begin(), map.end(), std::uint8_t{ 1 }));
}
} // namespace

TEST(SensorNoiseOutlierPixels, AreThoseFarAboveTheModel)
{
  SyntheticFrames frames(Width, Height, std::vector<FrameChange>(20));
  frames.model.largestRatio = 3.0;
  auto &     frame = frames.reference;
  const auto setRatio = [&](std::size_t p, double ratio) {
    frame.variance.Set(p, ratio * frames.model.RawVariance(frame.neighbourMean[p], 0.0, 0.0));
  };
  for (std::size_t p = 0; p < frame.variance.size(); ++p)
  {
    setRatio(p, 1.0);
  }
  EXPECT_EQ(Count(FindOutlierPixels(frame, frames.model, SerialFor)), 0u);
  const std::size_t lonely = 20 * Width + 20;
  setRatio(lonely, 3.1);
  setRatio(lonely + 10, 2.9);
  const auto alone = FindOutlierPixels(frame, frames.model, SerialFor);
  EXPECT_EQ(Count(alone), 1u);
  EXPECT_EQ(alone[lonely], 1);
  // A moving spot includes its pixels of a variance that is small by chance, and is distinguished from single pixels.
  for (std::size_t y = 30; y < 37; ++y)
  {
    for (std::size_t x = 30; x < 37; ++x)
    {
      setRatio(y * Width + x, (x + y) % 3 == 0 ? 1.0 : 10.0);
    }
  }
  const auto moving = FindOutlierPixels(frame, frames.model, SerialFor);
  for (std::size_t y = 30; y < 37; ++y)
  {
    for (std::size_t x = 30; x < 37; ++x)
    {
      EXPECT_EQ(moving[y * Width + x], 2) << x << ' ' << y;
    }
  }
  EXPECT_EQ(moving[33 * Width + 50], 0);
  EXPECT_EQ(moving[lonely], 1);
}

TEST(SensorNoiseOutlierPixels, AreNotThoseOfEdgesSharperThanAPixel)
{
  // Vertical edges, each within one pixel, which changes by the whole step; its neighbours do not change.
  constexpr double shiftVariance = 0.01; // [pixel^2]
  constexpr double noiseDn2 = 50.0;
  constexpr double stepDn = 1000.0;
  SyntheticFrames  frames(Width, Height, std::vector<FrameChange>(20));
  auto &           frame = frames.reference;
  for (std::size_t p = 0; p < frame.mean.size(); ++p)
  {
    const std::size_t inPeriod = p % Width % 14;
    const double      signal = inPeriod < 6 ? 0.0 : inPeriod == 6 || inPeriod == 13 ? 0.4 : 1.0;
    const bool        isEdge = inPeriod == 6 || inPeriod == 13;
    frame.mean[p] = 500.0 + stepDn * signal;
    frame.variance.Set(p, noiseDn2 + (isEdge ? shiftVariance * stepDn * stepDn : 0.0));
  }
  frame.neighbourMean = ComputeNeighbourMean(frame, SerialFor);
  const InitialNoiseModel model = FitInitialNoiseModel(frame);
  EXPECT_TRUE(model.isSharp);
  EXPECT_GT(model.vibrationXPixels2, shiftVariance);
  EXPECT_LT(model.vibrationXPixels2, 4.0 * shiftVariance); // the difference is half of the step, and twice as wide
  EXPECT_EQ(Count(FindOutlierPixels(frame, model, SerialFor)), 0u);
  frame.variance.Set(20 * Width + 24, 100.0 * noiseDn2); // in a bright bar
  EXPECT_EQ(Count(FindOutlierPixels(frame, model, SerialFor)), 1u);
}
