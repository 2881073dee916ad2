// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/BoxSum.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
/** Whole numbers, so that sums in any order are exact. */
template <typename TValue>
std::vector<TValue>
RandomMap(std::size_t pixels, int largest)
{
  std::mt19937                       random(3);
  std::uniform_int_distribution<int> uniform(0, largest);
  std::vector<TValue>                map(pixels);
  for (TValue & value : map)
  {
    value = static_cast<TValue>(uniform(random));
  }
  return map;
}

template <typename TValue>
std::vector<double>
BruteForce(const std::vector<TValue> & map, std::size_t width, std::size_t height, std::size_t radius)
{
  std::vector<double> sums(map.size(), 0.0);
  for (std::size_t p = 0; p < map.size(); ++p)
  {
    for (std::size_t q = 0; q < width * height; ++q)
    {
      const bool isNearX = q % width <= p % width + radius && p % width <= q % width + radius;
      const bool isNearY = q / width <= p / width + radius && p / width <= q / width + radius;
      sums[p] += isNearX && isNearY ? static_cast<double>(map[q]) : 0.0;
    }
  }
  return sums;
}

template <typename TValue>
std::vector<double>
BoxSum(const std::vector<TValue> & map,
       std::size_t                 width,
       std::size_t                 height,
       std::size_t                 radius,
       const ParallelFor &         parallelFor = SerialFor)
{
  std::vector<double> sums(map.size());
  const auto          makeSource = [&] { return RowsOf(map, width); };
  ForBoxRows(makeSource, width, height, radius, parallelFor, [&](std::size_t y, const double * row) {
    std::copy_n(row, width, sums.begin() + static_cast<std::ptrdiff_t>(y * width));
  });
  return sums;
}

void
Backwards(std::size_t count, const std::function<void(std::size_t)> & function)
{
  for (std::size_t i = count; i-- > 0;)
  {
    function(i);
  }
}
} // namespace

TEST(SensorNoiseBoxSum, EqualsBruteForce)
{
  for (const auto & [width, height] : { std::pair{ 17, 23 }, { 13, 150 }, { 1, 9 }, { 9, 1 }, { 4, 4 } })
  {
    const auto w = static_cast<std::size_t>(width);
    const auto h = static_cast<std::size_t>(height);
    for (const std::size_t radius : { 0, 1, 3, 5, 40 }) // up to wider than the frame
    {
      const auto bytes = RandomMap<std::uint8_t>(w * h, 255);
      EXPECT_EQ(BoxSum(bytes, w, h, radius), BruteForce(bytes, w, h, radius))
        << width << ' ' << height << ' ' << radius;
      const auto floats = RandomMap<float>(w * h, 9999);
      EXPECT_EQ(BoxSum(floats, w, h, radius, Backwards), BruteForce(floats, w, h, radius)) << radius;
    }
  }
}

TEST(SensorNoiseBoxSum, OrderOfThePiecesChangesNoBit)
{
  std::mt19937               random(4);
  std::normal_distribution<> normal;
  std::vector<double>        map(140 * 30);
  for (double & value : map)
  {
    value = normal(random);
  }
  EXPECT_EQ(BoxSum(map, 30, 140, 3), BoxSum(map, 30, 140, 3, Backwards));
}

TEST(SensorNoiseBoxSum, RowsMadeWhenTheyAreAskedForAreThoseOfAMap)
{
  const std::size_t   width = 17;
  const auto          map = RandomMap<float>(width * 150, 9999);
  std::vector<double> sums;
  const auto          makeSource = [&] {
    return [&map, row = std::vector<float>(17)](std::size_t y) mutable {
      std::copy_n(map.begin() + static_cast<std::ptrdiff_t>(y * row.size()), row.size(), row.begin());
      return row.data();
    };
  };
  ForBoxRows(makeSource, width, 150, 3, SerialFor, [&](std::size_t, const double * row) {
    sums.insert(sums.end(), row, row + width);
  });
  EXPECT_EQ(sums, BoxSum(map, width, 150, 3));
}

TEST(SensorNoiseBoxSum, ConstantCountsThePixels)
{
  const auto count = BoxSum(std::vector<std::uint8_t>(20 * 10, 1), 20, 10, 2);
  EXPECT_EQ(count[5 * 20 + 10], 25.0);
  EXPECT_EQ(count[0], 9.0);
  EXPECT_EQ(count[10], 15.0);
}
