// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseResiduals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <utility>
#include <vector>

using namespace sensornoise;

TEST(SensorNoiseSortPixelsBySignal, AreInTheOrderOfAComparison)
{
  std::mt19937_64                            random(17);
  std::normal_distribution<float>            normal(0.0F, 1.0F);
  std::vector<float>                         signal(5000);
  std::vector<std::uint8_t>                  take(signal.size());
  std::vector<std::pair<float, std::size_t>> expected;
  for (std::size_t p = 0; p < signal.size(); ++p)
  {
    const float size = std::exp2(10.0F * normal(random)); // signals of all magnitudes and both signs
    signal[p] = p % 5 == 0 ? std::round(normal(random)) : std::copysign(size, normal(random));
    take[p] = p % 7 != 3 ? 1 : 0;
    if (take[p] != 0)
    {
      expected.emplace_back(signal[p], p);
    }
  }
  ASSERT_GT(std::count(signal.begin(), signal.end(), 0.0F), 100); // zeros of both signs, too
  std::sort(expected.begin(), expected.end());
  const std::vector<std::uint32_t> order = SortPixelsBySignal(signal, take);
  ASSERT_EQ(order.size(), expected.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank)
  {
    ASSERT_EQ(order[rank], expected[rank].second) << rank;
  }
}

TEST(SensorNoiseSortPixelsBySignal, NoneAreTaken)
{
  EXPECT_TRUE(SortPixelsBySignal({}, {}).empty());
  EXPECT_TRUE(SortPixelsBySignal({ 1.0F, 2.0F }, { 0, 0 }).empty());
}
