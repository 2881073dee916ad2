// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ReferenceFrame.h"
#include "sensornoise/Parallel.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Width = 9;
constexpr std::size_t Height = 8;
constexpr std::size_t Frames = 11;
constexpr double      NaN = std::numeric_limits<double>::quiet_NaN();

struct Maps
{
  std::vector<double>       mean;
  std::vector<double>       variance;
  std::vector<std::uint8_t> valid = std::vector<std::uint8_t>(Width * Height, 1);

  Maps()
  {
    std::mt19937                     random(2);
    std::uniform_real_distribution<> uniform(50.0, 900.0);
    for (std::size_t p = 0; p < Width * Height; ++p)
    {
      mean.push_back(uniform(random));
      variance.push_back(uniform(random));
    }
  }
  ReferenceFrame
  Make(const ParallelFor & parallelFor = SerialFor) const
  {
    return MakeReferenceFrame(mean, variance, valid, { Width, Height, 1 }, Frames, parallelFor);
  }
  void
  Lose(std::size_t p)
  {
    mean[p] = variance[p] = NaN;
    valid[p] = 0;
  }
};

std::size_t
At(std::size_t x, std::size_t y)
{
  return y * Width + x;
}
} // namespace

TEST(SensorNoiseReferenceFrame, NeighbourMeanLeavesOutThePixelItself)
{
  Maps       maps;
  const auto before = maps.Make();
  for (std::size_t p = 0; p < Width * Height; ++p)
  {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t q = 0; q < Width * Height; ++q)
    {
      const bool isNearX = p % Width + 1 >= q % Width && q % Width + 1 >= p % Width;
      const bool isNearY = p / Width + 1 >= q / Width && q / Width + 1 >= p / Width;
      if (q != p && isNearX && isNearY)
      {
        sum += maps.mean[q];
        count += 1.0;
      }
    }
    EXPECT_NEAR(before.neighbourMean[p], sum / count, 1e-7 * sum) << p;
  }
  maps.mean[At(4, 4)] += 100.0;
  const auto after = maps.Make();
  EXPECT_EQ(after.neighbourMean[At(4, 4)], before.neighbourMean[At(4, 4)]);
  EXPECT_NEAR(after.neighbourMean[At(5, 3)], before.neighbourMean[At(5, 3)] + 12.5, 1e-7 * 900.0);
}

TEST(SensorNoiseReferenceFrame, KeepsTheMomentsOfTheMaps)
{
  const Maps maps;
  const auto frame = maps.Make();
  EXPECT_EQ(frame.mean, maps.mean);
  EXPECT_EQ(frame.variance.GetDoubles(), maps.variance);
  EXPECT_EQ(frame.frames, Frames);
}

TEST(SensorNoiseReferenceFrame, PixelsNearTheBorderAreNotUsable)
{
  const auto frame = Maps().Make();
  for (std::size_t p = 0; p < Width * Height; ++p)
  {
    const std::size_t x = p % Width;
    const std::size_t y = p / Width;
    const bool        isInner = x >= 2 && x < Width - 2 && y >= 2 && y < Height - 2;
    EXPECT_EQ(frame.usable[p], isInner ? 1 : 0) << x << ' ' << y;
  }
}

TEST(SensorNoiseReferenceFrame, PixelThatIsNotValidTakesItsNeighboursAlong)
{
  Maps maps;
  maps.valid[At(4, 4)] = 0;
  const auto frame = maps.Make();
  for (std::size_t y = 2; y < Height - 2; ++y)
  {
    for (std::size_t x = 2; x < Width - 2; ++x)
    {
      const bool isNear = x >= 3 && x <= 5 && y >= 3 && y <= 5;
      EXPECT_EQ(frame.usable[At(x, y)], isNear ? 0 : 1) << x << ' ' << y;
    }
  }
  maps.valid[At(4, 4)] = 1;
  maps.variance[At(4, 4)] = 0.0; // a constant pixel is left out, without its neighbours
  const auto constant = maps.Make();
  EXPECT_EQ(constant.usable[At(4, 4)], 0);
  EXPECT_EQ(constant.usable[At(5, 4)], 1);
}

TEST(SensorNoiseReferenceFrame, PixelWithoutAMeanHasItsNeighbours)
{
  Maps maps;
  maps.Lose(At(4, 4));
  const auto frame = maps.Make();
  EXPECT_EQ(frame.mean[At(4, 4)], frame.neighbourMean[At(4, 4)]);
  for (std::size_t p = 0; p < Width * Height; ++p)
  {
    EXPECT_TRUE(std::isfinite(frame.mean[p]) && std::isfinite(frame.neighbourMean[p])) << p;
  }
  double sum = 0.0; // over the 7 other neighbours of (5, 4)
  for (std::size_t i = 0; i < 9; ++i)
  {
    const std::size_t p = At(4 + i % 3, 3 + i / 3);
    sum += p == At(4, 4) || p == At(5, 4) ? 0.0 : maps.mean[p];
  }
  EXPECT_NEAR(frame.neighbourMean[At(5, 4)], sum / 7.0, 1e-7 * sum);
  for (std::size_t p = 0; p < Width * Height; ++p)
  {
    maps.Lose(p);
  }
  EXPECT_EQ(maps.Make().mean, std::vector<double>(Width * Height, 0.0)); // no pixel has a known level
}

TEST(SensorNoiseReferenceFrame, ThreadsChangeNoBit)
{
  const auto expected = Maps().Make();
  const auto frame = Maps().Make(test::Threads(3));
  EXPECT_EQ(frame.neighbourMean, expected.neighbourMean);
  EXPECT_EQ(frame.usable, expected.usable);
}
