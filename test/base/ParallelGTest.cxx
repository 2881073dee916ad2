// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Parallel.h"

#include "helpers/StackTestHelper.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace sensornoise;

namespace
{
/** Terms of very different sizes, whose sum depends on the order of the additions. */
double
Term(std::size_t p)
{
  return std::exp(20.0 * std::sin(static_cast<double>(p)));
}

std::array<double, 2>
Sums(std::size_t count, const ParallelFor & parallelFor)
{
  return SumOverBlocks<2>(count, parallelFor, [](std::size_t p, std::array<double, 2> & sums) {
    sums[0] += Term(p);
    sums[1] += 1.0;
  });
}
} // namespace

TEST(SensorNoiseParallel, BlocksCoverEachPixelOnce)
{
  for (const std::size_t count :
       { std::size_t{ 0 }, std::size_t{ 1 }, PixelsPerBlock, PixelsPerBlock + 1, 5 * PixelsPerBlock - 1 })
  {
    std::vector<std::atomic<int>> visits(count);
    ForBlocks(count, test::Threads(3), [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p)
      {
        ++visits[p];
      }
    });
    for (std::size_t p = 0; p < count; ++p)
    {
      ASSERT_EQ(visits[p], 1) << p << " of " << count;
    }
    EXPECT_EQ(Sums(count, SerialFor)[1], static_cast<double>(count));
  }
}

TEST(SensorNoiseParallel, AnyNumberOfThreadsGivesTheSameBits)
{
  const std::size_t count = 7 * PixelsPerBlock + 123;
  const auto        expected = Sums(count, SerialFor);
  for (const std::size_t threads : { 2, 3, 7, 20 })
  {
    EXPECT_EQ(Sums(count, test::Threads(threads)), expected) << threads;
  }
}

TEST(SensorNoiseParallel, SumsToRounding)
{
  const std::size_t count = 3 * PixelsPerBlock + 5;
  long double       exact = 0.0L;
  for (std::size_t p = 0; p < count; ++p)
  {
    exact += Term(p);
  }
  // One rounding of eps / 2 an addition at most.
  EXPECT_NEAR(Sums(count, SerialFor)[0], static_cast<double>(exact), 1.2e-16 * static_cast<double>(count * exact));
}

TEST(SensorNoiseParallel, NumberOfSumsMayBeKnownAtRunTimeOnly)
{
  const std::size_t count = 2 * PixelsPerBlock + 77;
  const auto        expected = Sums(count, SerialFor);
  for (const std::size_t threads : { 1, 5 })
  {
    const auto sums = SumOverBlocks(count, test::Threads(threads), 2, [](std::size_t p, double * s) {
      s[0] += Term(p);
      s[1] += 1.0;
    });
    ASSERT_EQ(sums.size(), 2u);
    EXPECT_EQ(sums[0], expected[0]);
    EXPECT_EQ(sums[1], expected[1]);
  }
}
