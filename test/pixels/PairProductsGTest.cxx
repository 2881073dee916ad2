// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ProjectedFrames.h"
#include "simulation/Random.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::int64_t LargestWeight = std::int64_t{ 1 } << 20;
using Sums = std::array<double, FramePairs::MostPixels>;

struct Case
{
  FramePairs                                         frames{};
  std::vector<std::pair<std::int64_t, std::int64_t>> weights;

  std::vector<PairWeights>
  Weights() const
  {
    std::vector<PairWeights> pairs;
    for (const auto & [first, second] : weights)
    {
      pairs.emplace_back(static_cast<double>(first), static_cast<double>(second));
    }
    return pairs;
  }
};

/** Returns the products with 64 bits, one after the other. */
Sums
SumsInOrder(const Case & of, double more, std::size_t pixels, const Sums & start)
{
  Sums sums = start;
  for (std::size_t i = 0; i < pixels; ++i)
  {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < of.weights.size(); ++k)
    {
      sum += of.frames.values[k][2 * i] * of.weights[k].first + of.frames.values[k][2 * i + 1] * of.weights[k].second;
    }
    sums[i] += more + static_cast<double>(sum);
  }
  return sums;
}

Case
RandomCase(std::size_t pairs)
{
  CounterSeededRandom random(pairs);
  Case                made;
  const auto          weight = [&] {
    return static_cast<std::int64_t>(random.Bits() % (2 * LargestWeight + 1)) - LargestWeight;
  };
  for (std::size_t k = 0; k < pairs; ++k)
  {
    made.weights.emplace_back(weight(), weight());
    std::generate(std::begin(made.frames.values[k]), std::end(made.frames.values[k]), [&] {
      return static_cast<std::int16_t>(random.Bits() % 65536);
    });
  }
  return made;
}

/** Values with the largest possible products. */
Case
LargestCase(std::int16_t value, std::int64_t weight)
{
  Case made;
  made.weights.assign(FramePairs::MostPairs, { weight, weight });
  for (auto & pair : made.frames.values)
  {
    std::fill(std::begin(pair), std::end(pair), value);
  }
  return made;
}

void
ExpectExact(const Case & of, std::size_t pixels)
{
  Sums start{};
  std::fill(start.begin(), start.end(), 3.0);
  const Sums expected = SumsInOrder(of, -32768.0, pixels, start);
  Sums       found = start;
  AddPairProducts(of.frames, of.Weights(), -32768.0, pixels, found.data());
  EXPECT_EQ(found, expected) << of.weights.size() << " pairs, " << pixels << " pixels";
  found = start;
  AddPairProductsOneByOne(of.frames, of.Weights(), -32768.0, pixels, found.data());
  EXPECT_EQ(found, expected) << of.weights.size() << " pairs, " << pixels << " pixels, one by one";

  std::array<std::uint32_t, FramePairs::MostPixels> modular{};
  AddPairProducts(of.frames, of.Weights(), std::uint32_t{ 0 } - 32765U, pixels, modular.data()); // 3 - 32768
  auto inOrder = decltype(modular){};
  AddPairProductsOneByOne(of.frames, of.Weights(), std::uint32_t{ 0 } - 32765U, pixels, inOrder.data());
  for (std::size_t i = 0; i < pixels; ++i)
  {
    const auto low = static_cast<std::uint32_t>(static_cast<std::int64_t>(expected[i])); // modulo 2^32
    ASSERT_EQ(modular[i], low) << i;
    ASSERT_EQ(inOrder[i], low) << i;
  }
}
} // namespace

TEST(SensorNoisePairProducts, AreWholeNumbersForAnyPairsAndPixels)
{
  for (const std::size_t pairs : { 0, 1, 2, 7, 16 })
  {
    for (const std::size_t pixels : { 1, 15, 32, 33, 255, 256 })
    {
      ExpectExact(RandomCase(pairs), pixels);
    }
  }
}

TEST(SensorNoisePairProducts, LargestProductsAreHeld)
{
  for (const std::int16_t value :
       { std::numeric_limits<std::int16_t>::lowest(), std::numeric_limits<std::int16_t>::max() })
  {
    for (const std::int64_t weight : { -LargestWeight, LargestWeight, std::int64_t{ 1023 }, std::int64_t{ -1024 } })
    {
      ExpectExact(LargestCase(value, weight), FramePairs::MostPixels);
    }
  }
}
