// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/UsablePixels.h"
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

TEST(SensorNoiseUnexplainedPixels, AreThoseFarAboveTheModel)
{
  SyntheticFrames frames(Width, Height, std::vector<FrameChange>(20));
  frames.model.largestRatio = 3.0;
  auto &     frame = frames.reference;
  const auto setRatio = [&](std::size_t p, double ratio) {
    frame.variance[p] = ratio * frames.model.RawVariance(frame.neighbourMean[p], 0.0, 0.0);
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
