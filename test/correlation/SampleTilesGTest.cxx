// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/FrameSample.h"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t FewFrames = 10;

/** Expects that every pixel is in at most one tile, and every tile in the frame. */
void
ExpectInsideAndApart(const SampleTiles & tiles, const FrameGeometry & geometry)
{
  std::vector<int> covered(geometry.Pixels(), 0);
  for (const auto & origin : tiles.origins)
  {
    ASSERT_LE(origin.x + tiles.side, geometry.width);
    ASSERT_LE(origin.y + tiles.side, geometry.height);
    for (std::size_t y = origin.y; y < origin.y + tiles.side; ++y)
    {
      for (std::size_t x = origin.x; x < origin.x + tiles.side; ++x)
      {
        ++covered[y * geometry.width + x];
      }
    }
  }
  EXPECT_LE(*std::max_element(covered.begin(), covered.end()), 1);
}
} // namespace

TEST(SensorNoiseSampleTiles, LieInsideTheFrameAndDoNotOverlap)
{
  for (const std::size_t width : { 15, 16, 31, 32, 33, 256, 1000 })
  {
    for (const std::size_t height : { 15, 16, 47, 100, 701 })
    {
      const FrameGeometry geometry{ width, height, 1 };
      for (const std::size_t frames : { 2, 60, 5000 })
      {
        ExpectInsideAndApart(MakeSampleTiles(geometry, frames), geometry);
      }
    }
  }
}

TEST(SensorNoiseSampleTiles, SmallFramesHaveSmallTilesAndSmallerOnesNone)
{
  EXPECT_TRUE(MakeSampleTiles({ 15, 400, 1 }, FewFrames).origins.empty());
  EXPECT_TRUE(MakeSampleTiles({ 400, 15, 1 }, FewFrames).origins.empty());
  const auto count = [](std::size_t size) { return MakeSampleTiles({ size, size, 1 }, FewFrames).origins.size(); };
  EXPECT_EQ(count(16), 1U);
  EXPECT_EQ(count(31), 1U);
  EXPECT_EQ(count(32), 4U);
  EXPECT_EQ(MakeSampleTiles({ 127, 128, 1 }, FewFrames).side, 16U); // three by four of 32
  EXPECT_EQ(MakeSampleTiles({ 128, 128, 1 }, FewFrames).side, 32U);
  EXPECT_EQ(count(128), 16U);
}

TEST(SensorNoiseSampleTiles, OneLiesInTheMiddleAndManyAreSpreadEvenly)
{
  const auto one = MakeSampleTiles({ 31, 24, 1 }, FewFrames);
  ASSERT_EQ(one.origins.size(), 1U);
  EXPECT_EQ(one.origins[0].x, 7U);
  EXPECT_EQ(one.origins[0].y, 4U);

  const auto tiles = MakeSampleTiles({ 4096, 4096, 1 }, 60);
  EXPECT_EQ(tiles.side, 32U);
  EXPECT_EQ(tiles.origins.size(), 121U); // 11 x 11: 128 would be 2^17 pixels
  // All neighbouring tiles have the same distance; the distance of the middle of a tile from the border is half of it.
  constexpr double step = 4096.0 / 11.0;
  for (std::size_t i = 0; i < 11; ++i)
  {
    const double middle = static_cast<double>(tiles.origins[i].x) + 16.0;
    EXPECT_NEAR(middle, (static_cast<double>(i) + 0.5) * step, 1.0);
    EXPECT_EQ(tiles.origins[11 * i].y, tiles.origins[i].x);
  }
}

TEST(SensorNoiseSampleTiles, KeepToTheirBudgets)
{
  for (const auto & geometry : { FrameGeometry{ 4096, 4096, 1 },
                                 FrameGeometry{ 256, 256, 1 },
                                 FrameGeometry{ 65536, 16, 1 },
                                 FrameGeometry{ 16, 65536, 1 },
                                 FrameGeometry{ 2000, 40, 1 } })
  {
    for (const std::size_t frames : { 1, 8, 64, 100, 256, 100000 })
    {
      const auto        tiles = MakeSampleTiles(geometry, frames);
      const std::size_t pixels = tiles.origins.size() * tiles.Pixels();
      EXPECT_EQ(tiles.frames, std::min(frames, SampleTiles::MostFrames));
      EXPECT_LE(pixels, SampleTiles::MostPixels);
      const std::size_t values = SampleTiles::MostValuesOf(geometry.Pixels());
      EXPECT_LE(pixels * tiles.frames, values);
      // Whole columns and rows of tiles leave at most a third unused, if the frame has enough pixels.
      const std::size_t most = std::min(SampleTiles::MostPixels, values / tiles.frames);
      EXPECT_GE(3 * pixels, 2 * std::min(most, geometry.Pixels() / 2)) << geometry.width << " " << frames;
    }
  }
}

TEST(SensorNoiseSampleTiles, MayHaveAsManyValuesAsTheFrameHasPixelsFor)
{
  EXPECT_EQ(SampleTiles::MostValuesOf(0), SampleTiles::MostValuesOfSmall);
  constexpr std::size_t most = SampleTiles::MostValues / SampleTiles::MostValuesPerPixel;
  constexpr std::size_t least = SampleTiles::MostValuesOfSmall / SampleTiles::MostValuesPerPixel;
  EXPECT_EQ(SampleTiles::MostValuesOf(least), SampleTiles::MostValuesOfSmall);
  EXPECT_EQ(SampleTiles::MostValuesOf(3 * least / 2), 3 * SampleTiles::MostValuesOfSmall / 2);
  EXPECT_EQ(SampleTiles::MostValuesOf(most), SampleTiles::MostValues);
  EXPECT_EQ(SampleTiles::MostValuesOf(100 * most), SampleTiles::MostValues);
}

TEST(SensorNoiseSampleTiles, OneColumnMoreIsTakenWhereItLeavesLessUnused)
{
  const auto tiles = MakeSampleTiles({ 688, 520, 1 }, 100);
  EXPECT_EQ(tiles.origins.size(), 40U); // 8 x 5 of at most 40; the square root would be 7 x 5
}
