// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/RegressorBand.h"
#include "simulation/Random.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

using namespace sensornoise;

// All compilers and processors compute the same bits: plain loops, loops for AVX2, and one product after the other.
TEST(SensorNoiseGroupProducts, AreTheSameAnywhere)
{
  constexpr std::size_t      pixels = PixelsOfSingleSum + 97;
  CounterSeededRandom        random(46);
  std::vector<SingleColumns> columns(pixels);
  std::vector<float>         series(FramesTogether * pixels);
  std::vector<std::uint32_t> order(pixels);
  for (auto & ofPixel : columns)
  {
    std::generate(ofPixel.begin(), ofPixel.end(), [&] { return static_cast<float>(random.Normal()); });
  }
  std::generate(series.begin(), series.end(), [&] { return static_cast<float>(100.0 * random.Normal()); });
  std::iota(order.rbegin(), order.rend(), 0U);
  std::size_t unlikeFused = 0;
  for (const std::size_t end : { std::size_t{ 5 }, std::size_t{ 6 }, std::size_t{ 18 }, pixels })
  {
    const GroupFactors of{ columns.data(), order.data(), series.data(), pixels, 5, end };
    GroupSums          expected{};
    GroupSums          fused{};
    for (std::size_t k = 0; k < FramesTogether; ++k)
    {
      for (std::size_t c = 0; c < expected[k].size(); ++c)
      {
        for (std::size_t begin = of.begin; begin < of.end; begin += PixelsOfSingleSum)
        {
          float sum = 0.0F;
          float fusedSum = 0.0F;
          for (std::size_t i = begin; i < std::min(of.end, begin + PixelsOfSingleSum); ++i)
          {
            const float          value = series[k * pixels + order[i]];
            const volatile float product = columns[i][c] * value; // rounded, whatever the compiler may do
            sum += product;
            fusedSum = std::fma(columns[i][c], value, fusedSum);
          }
          expected[k][c] += sum;
          fused[k][c] += fusedSum;
        }
        unlikeFused += expected[k][c] != fused[k][c] ? 1 : 0;
      }
    }
    GroupSums found;
    GroupSums anywhere;
    MultiplyGroup(of, found);
    MultiplyGroupAnywhere(of, anywhere);
#if defined(__x86_64__) && !defined(__FMA__)
    EXPECT_EQ(anywhere, expected) << end;
#endif
    EXPECT_EQ(found, anywhere) << end;
  }
  EXPECT_GT(unlikeFused, 10U); // so that the test can distinguish them
}
