// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FileBytes.h"

#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

namespace
{
using sensornoise::ByteRanges;

TEST(ByteRanges, FindsBytesThatHoldPixelsTwice)
{
  ByteRanges ranges;
  EXPECT_TRUE(ranges.AddPixels(100, 10));
  EXPECT_TRUE(ranges.AddPixels(50, 10));
  EXPECT_TRUE(ranges.AddPixels(60, 40));
  EXPECT_EQ(ranges.FirstConflict(), std::nullopt);
  EXPECT_TRUE(ranges.AddPixels(109, 1));
  EXPECT_EQ(ranges.FirstConflict(), 109u);
  EXPECT_TRUE(ranges.AddPixels(20, 31));
  EXPECT_EQ(ranges.FirstConflict(), 50u);
}

TEST(ByteRanges, TablesMayOverlapButNotWithPixels)
{
  ByteRanges ranges;
  EXPECT_TRUE(ranges.AddTable(0, 8));
  EXPECT_TRUE(ranges.AddTable(100, 50));
  EXPECT_TRUE(ranges.AddTable(110, 10));
  EXPECT_TRUE(ranges.AddTable(100, 50));
  EXPECT_TRUE(ranges.AddPixels(8, 92));
  EXPECT_TRUE(ranges.AddPixels(150, 10));
  EXPECT_EQ(ranges.FirstConflict(), std::nullopt);
  ByteRanges before = ranges;
  EXPECT_TRUE(before.AddPixels(149, 1));
  EXPECT_EQ(before.FirstConflict(), 149u);
  EXPECT_TRUE(ranges.AddTable(159, 10));
  EXPECT_EQ(ranges.FirstConflict(), 159u);
}

TEST(ByteRanges, AByteOfPixelsFitsBetweenTables)
{
  ByteRanges ranges;
  EXPECT_TRUE(ranges.AddTable(0, 8));
  EXPECT_TRUE(ranges.AddTable(10, 100));
  EXPECT_TRUE(ranges.AddPixels(8, 1));
  EXPECT_EQ(ranges.FirstConflict(), std::nullopt);
}

TEST(ByteRanges, ListsTheGaps)
{
  using Gaps = std::vector<ByteRanges::Range>;
  ByteRanges ranges;
  EXPECT_EQ(ranges.Gaps(100), (Gaps{ { 0, 100 } }));
  ranges.AddTable(0, 8);
  ranges.AddPixels(20, 30);
  EXPECT_EQ(ranges.Gaps(60), (Gaps{ { 8, 20 }, { 50, 60 } }));
  ranges.AddTable(30, 70);
  EXPECT_EQ(ranges.Gaps(100), (Gaps{ { 8, 20 } }));
}

TEST(ByteRanges, AsManyAsYouLikeOneAfterTheOther)
{
  constexpr std::uint64_t count = 1000000;
  ByteRanges              ordered;
  for (std::uint64_t i = 0; i < count; ++i)
  {
    ASSERT_TRUE(ordered.AddPixels(8 + 4 * i, 3)); // filled up to words
  }
  EXPECT_EQ(ordered.FirstConflict(), std::nullopt);
  ByteRanges backwards;
  for (std::uint64_t i = count; i-- > 0;)
  {
    ASSERT_TRUE(backwards.AddPixels(8 + 4 * i, 4));
  }
  EXPECT_EQ(backwards.FirstConflict(), std::nullopt);
}

TEST(ByteRanges, HasALimitForThoseApart)
{
  ByteRanges    ranges;
  std::uint64_t count = 0;
  while (ranges.AddPixels(100 * count, 1))
  {
    ++count;
  }
  EXPECT_EQ(count, std::uint64_t{ 1 } << 18);
}

} // namespace
