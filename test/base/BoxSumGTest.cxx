// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/base/BoxSum.h"
#include "sensornoise/base/Parallel.h"

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

TEST(SensorNoiseBoxSum, WhatAReusedMapHeldDoesNotMatter)
{
  const auto          map = RandomMap<std::uint8_t>(17 * 23, 255);
  std::vector<double> result(1000, 77.0);
  BoxSum(map, 17, 23, 3, SerialFor, result);
  EXPECT_EQ(result, BoxSum(map, 17, 23, 3));
}

TEST(SensorNoiseBoxSum, ConstantCountsThePixels)
{
  const auto count = BoxSum(std::vector<std::uint8_t>(20 * 10, 1), 20, 10, 2);
  EXPECT_EQ(count[5 * 20 + 10], 25.0);
  EXPECT_EQ(count[0], 9.0);
  EXPECT_EQ(count[10], 15.0);
}
