// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/Exposures.h"
#include "sensornoise/Parallel.h"
#include "moments/FrameThumbnails.h"
#include "moments/StackMaps.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t EvenSize = 96; // 16 x 16 tiles of 6 x 6 pixels
constexpr double      EvenOffsetDn = 100.0;

/** Returns the mask for frames of exposures 1, 2 and 3 with the signals 500 x signal(x, y) x exposure [DN]. */
std::vector<std::uint8_t>
EvenPixelsOf(const std::function<double(std::size_t x, std::size_t y)> & signal,
             const std::vector<std::uint8_t> & valid = std::vector<std::uint8_t>(EvenSize * EvenSize, 1))
{
  std::vector<float> stack;
  StackMaps          maps;
  maps.valid = valid;
  for (std::size_t t = 0; t < 3; ++t)
  {
    for (std::size_t p = 0; p < EvenSize * EvenSize; ++p)
    {
      const double dn = 500.0 * signal(p % EvenSize, p / EvenSize);
      stack.push_back(static_cast<float>(EvenOffsetDn + dn * static_cast<double>(t + 1)));
      if (t == 1)
      {
        maps.mean.push_back(static_cast<double>(stack.back()));
      }
    }
  }
  FrameThumbnails thumbnails({ EvenSize, EvenSize }, 3, {});
  thumbnails.AddFrames(stack.data(), 0, 3, SerialFor);
  return FindEvenPixels(thumbnails, { 0, 1, 2 }, { 1.0, 2.0, 3.0 }, maps);
}
} // namespace

TEST(SensorNoiseEvenPixels, OfAFlatFieldAreAllValidOnes)
{
  std::vector<std::uint8_t> valid(EvenSize * EvenSize, 1);
  valid[7] = 0;
  EXPECT_EQ(EvenPixelsOf([](std::size_t, std::size_t) { return 1.0; }, valid), valid);
}

// Stripes of 0.5 and 1.5 in the left half, and of 0.88 and 1.12 in the right half. The ratio of the latter is 1.27
// above the offset, within 1.25^2, and 1.63 above the level of the lowest exposure.
TEST(SensorNoiseEvenPixels, TexturedCellsAreLeftOut)
{
  const auto scene = [](std::size_t x, std::size_t) {
    const double amplitude = x >= 48 ? 0.12 : 0.5;
    return x % 2 == 0 ? 1.0 - amplitude : 1.0 + amplitude;
  };
  const auto even = EvenPixelsOf(scene);
  for (std::size_t p = 0; p < even.size(); ++p)
  {
    EXPECT_EQ(even[p], p % EvenSize >= 48 ? 1 : 0) << p;
  }
}

TEST(SensorNoiseEvenPixels, WhereAllCellsAreTexturedAllValidPixelsStay)
{
  const std::vector<std::uint8_t> all(EvenSize * EvenSize, 1);
  EXPECT_EQ(EvenPixelsOf([](std::size_t x, std::size_t) { return x % 2 == 0 ? 0.5 : 1.5; }), all);
}
