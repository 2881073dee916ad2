// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackFrames.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
using Numbers = std::vector<std::size_t>;
constexpr std::size_t Pixels = 7;
} // namespace

TEST(SensorNoiseDistinctFrames, PlacesCountTheOriginals)
{
  const DistinctFrames frames(Numbers{ 0, 0, 2, 0, 4, 2 });
  EXPECT_EQ(frames.Given(), 6U);
  EXPECT_EQ(frames.Count(), 3U);
  EXPECT_EQ(frames.Places(), (Numbers{ 0, 0, 1, 0, 2, 1 }));
  EXPECT_EQ(frames.OfDistinct(Numbers{ 10, 11, 12, 13, 14, 15 }), (Numbers{ 10, 12, 14 }));
  EXPECT_EQ(frames.ExpandToGiven(Numbers{ 10, 12, 14 }, std::size_t{ 0 }), (Numbers{ 10, 10, 12, 10, 14, 12 }));
  EXPECT_EQ(DistinctFrames().Count(), 0U);
}

TEST(SensorNoiseDistinctFrames, AnyRunHandsOutItsDistinctFramesInOrder)
{
  const Numbers        originals{ 0, 1, 1, 3, 0, 5, 6, 6, 6, 1 };
  const DistinctFrames frames(originals);
  Numbers              stack(originals.size() * Pixels);
  std::iota(stack.begin(), stack.end(), std::size_t{ 0 });
  for (std::size_t first = 0; first < originals.size(); ++first)
  {
    for (std::size_t end = first; end <= originals.size(); ++end)
    {
      Numbers seen;
      Numbers expected;
      for (std::size_t t = first; t < end; ++t)
      {
        if (originals[t] == t)
        {
          expected.push_back(t);
        }
      }
      const auto take = [&](const std::size_t * chosen, std::size_t place, std::size_t number) {
        for (std::size_t k = 0; k < number; ++k)
        {
          const std::size_t t = chosen[k * Pixels] / Pixels;
          EXPECT_EQ(frames.PlaceOf(t), place + k);
          EXPECT_TRUE(std::equal(chosen + k * Pixels, chosen + (k + 1) * Pixels, stack.data() + t * Pixels));
          seen.push_back(t);
        }
      };
      frames.ForDistinct(stack.data() + first * Pixels, Pixels, first, end - first, Threads(2), take);
      EXPECT_EQ(seen, expected) << first << ' ' << end;
    }
  }
}

TEST(SensorNoiseChosenFrames, AreNotCopiedIfAllAre)
{
  const Numbers stack(3 * Pixels);
  std::size_t   calls = 0;
  ForChosenFrames(stack.data(), Pixels, { 1, 1, 1 }, SerialFor, [&](const std::size_t * frames, std::size_t number) {
    EXPECT_EQ(frames, stack.data());
    EXPECT_EQ(number, 3U);
    ++calls;
  });
  ForChosenFrames(
    stack.data(), Pixels, { 0, 0, 0 }, SerialFor, [&](const std::size_t *, std::size_t) { ADD_FAILURE(); });
  EXPECT_EQ(calls, 1U);
}

TEST(SensorNoiseChosenFrames, CopiesOfManyFramesAreHandedOutInParts)
{
  constexpr std::size_t          pixels = (std::size_t{ 32 } << 20) / 2; // two frames of bytes have 32 MiB
  std::vector<unsigned char>     stack(6 * pixels);
  std::vector<std::size_t>       numbers;
  const std::vector<std::size_t> expected{ 2, 2, 1 };
  for (std::size_t t = 0; t < 6; ++t)
  {
    stack[t * pixels] = static_cast<unsigned char>(t);
  }
  std::vector<unsigned char> seen;
  ForChosenFrames(
    stack.data(), pixels, { 1, 1, 0, 1, 1, 1 }, SerialFor, [&](const unsigned char * frames, std::size_t number) {
      numbers.push_back(number);
      for (std::size_t k = 0; k < number; ++k)
      {
        seen.push_back(frames[k * pixels]);
      }
    });
  EXPECT_EQ(numbers, expected);
  EXPECT_EQ(seen, (std::vector<unsigned char>{ 0, 1, 3, 4, 5 }));
}
