// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Simd.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

TEST(WideVectors, AreNotFusedAndAddInTheSameOrder)
{
  constexpr std::size_t size = 1003; // not whole vectors
  CounterSeededRandom   random(7, 0);
  std::vector<double>   a;
  std::vector<double>   b;
  for (std::size_t i = 0; i < size; ++i)
  {
    a.push_back(random.Normal());
    b.push_back(random.Normal());
  }
  std::vector<double> found(size, 1.0);
  double              total = 0.0;
  int                 calls = 0;
  CallWithAvx2([&] {
    ++calls;
    for (std::size_t i = 0; i < size; ++i)
    {
      found[i] += a[i] * b[i];
      total += found[i] * a[i];
    }
  });
  double      expected = 0.0;
  std::size_t unlikeFused = 0;
  for (std::size_t i = 0; i < size; ++i)
  {
    const volatile double product = a[i] * b[i]; // rounded, whatever the compiler may do
    const double          sum = 1.0 + product;
    EXPECT_EQ(found[i], sum);
    const volatile double term = sum * a[i];
    expected += term;
    unlikeFused += sum != std::fma(a[i], b[i], 1.0) ? 1 : 0;
  }
  EXPECT_EQ(total, expected);
  EXPECT_EQ(calls, 1);
  EXPECT_GT(unlikeFused, size / 20); // otherwise both results would be equal by chance
}
