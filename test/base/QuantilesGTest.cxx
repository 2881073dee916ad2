// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Quantiles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
/** Some of them equal. */
std::vector<double>
Values(std::size_t count)
{
  std::mt19937                    random(71);
  std::uniform_int_distribution<> level(0, 1000);
  std::vector<double>             values(count);
  std::generate(values.begin(), values.end(), [&] { return 0.5 * level(random); });
  return values;
}
} // namespace

TEST(SensorNoiseQuantiles, EdgesAreThoseOfTheSortedValues)
{
  for (const std::size_t count : { 1U, 2U, 3U, 5U, 64U, 100U, 5000U })
  {
    for (const std::size_t bins : { 1U, 2U, 7U, 64U })
    {
      const std::vector<double> values = Values(count);
      std::vector<double>       sorted = values;
      std::sort(sorted.begin(), sorted.end());
      const std::vector<double> edges = EdgesOfEqualCount(values, bins);
      ASSERT_EQ(edges.size(), bins - 1);
      for (std::size_t b = 1; b < bins; ++b)
      {
        EXPECT_EQ(edges[b - 1], sorted[b * count / bins] - 1e-9 * (sorted.back() - sorted.front()))
          << count << " values, edge " << b << " of " << bins;
      }
    }
  }
  EXPECT_TRUE(EdgesOfEqualCount({}, 7).empty());
}

TEST(SensorNoiseQuantiles, SampleIsEveryNthPixelOfAnyMask)
{
  std::mt19937                                 random(72);
  std::uniform_int_distribution<std::uint16_t> byte(0, 255);
  for (const std::size_t pixels : { 0U, 1U, 7U, 8U, 9U, 1003U })
  {
    for (const std::uint16_t least : { std::uint16_t{ 0 },
                                       std::uint16_t{ 1 },
                                       std::uint16_t{ 128 },
                                       std::uint16_t{ 250 } }) // the fraction that counts falls
    {
      std::vector<std::uint8_t> mask(pixels);
      std::generate(mask.begin(), mask.end(), [&] {
        const std::uint16_t value = byte(random);
        return static_cast<std::uint8_t>(value >= least ? value : 0);
      });
      std::vector<std::size_t> counting;
      for (std::size_t p = 0; p < pixels; ++p)
      {
        if (mask[p] != 0)
        {
          counting.push_back(p);
        }
      }
      for (const std::size_t most : { 1U, 20U, 300U, 5000U })
      {
        const std::size_t        stride = std::max<std::size_t>(1, counting.size() / most);
        std::vector<std::size_t> expected;
        for (std::size_t i = 0; i < counting.size(); i += stride)
        {
          expected.push_back(counting[i]);
        }
        EXPECT_EQ(SamplePixels(mask.data(), pixels, most), expected) << pixels << ' ' << least << ' ' << most;
      }
    }
  }
}

TEST(SensorNoiseQuantiles, RobustCentreIsTheMedianAndTheMedianDifference)
{
  const RobustCentre centre = CentreOf({ 7.0, 1.0, 3.0, 100.0, 4.0 });
  EXPECT_EQ(centre.median, 4.0);
  EXPECT_DOUBLE_EQ(centre.sd, 3.0 / MedianOfNormal); // of 3, 3, 1, 96, 0
}

TEST(SensorNoiseQuantiles, DensestHalfIsTheShortestInterval)
{
  EXPECT_EQ(FindDensestHalf({ 0.0, 5.0, 6.0, 6.5, 9.0 }), 1U); // 5 to 6.5
  EXPECT_EQ(FindDensestHalf({ 1.0, 2.0, 8.0, 9.5 }), 0U);
  EXPECT_EQ(FindDensestHalf({ 0.0, 1.0, 2.0 }), 0U); // the first of equal ones
  EXPECT_EQ(FindDensestHalf({ 3.0 }), 0U);
}
