// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Jackknife.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

using namespace sensornoise;

namespace
{
struct Block
{
  double count{ 0.0 };
  double sum{ 0.0 };
  double square{ 0.0 };

  Block &
  operator+=(const Block & other)
  {
    count += other.count;
    sum += other.sum;
    square += other.square;
    return *this;
  }
};

/** Returns blocks of \a size values. */
std::vector<Block>
NormalBlocks(std::size_t blocks, std::size_t size, std::uint64_t seed)
{
  CounterSeededRandom random(seed);
  std::vector<Block>  found(blocks);
  for (Block & block : found)
  {
    for (std::size_t k = 0; k < size; ++k)
    {
      const double value = 3.0 + 2.0 * random.Normal();
      block += { 1.0, value, value * value };
    }
  }
  return found;
}

Eigen::VectorXd
MeanOf(const Block & sums)
{
  return Eigen::VectorXd::Constant(1, sums.sum / sums.count);
}
} // namespace

TEST(SensorNoiseJackknife, OfAMeanItIsTheVarianceOverTheNumber)
{
  constexpr std::size_t count = 23;
  const auto            blocks = NormalBlocks(count, 1, 2);
  Block                 all;
  for (const Block & block : blocks)
  {
    all += block;
  }
  const double mean = all.sum / count;
  const double variance = (all.square - count * mean * mean) / (count - 1.0);
  const auto   found = Jackknife(blocks, MeanOf);
  EXPECT_NEAR(found.value(0), mean, 1e-14);
  EXPECT_NEAR(found.covariance(0, 0), variance / count, 1e-12);
  EXPECT_NEAR(found.StandardError(0), std::sqrt(variance / count), 1e-12);
}

TEST(SensorNoiseJackknife, FiguresHaveTheirCovariance)
{
  // The second figure is 1 minus twice the first.
  const auto   found = Jackknife(NormalBlocks(12, 3, 4), [](const Block & sums) {
    const double mean = sums.sum / sums.count;
    return Eigen::VectorXd(Eigen::Vector2d(mean, 1.0 - 2.0 * mean));
  });
  const double own = found.covariance(0, 0);
  EXPECT_NEAR(found.value(1), 1.0 - 2.0 * found.value(0), 1e-14);
  EXPECT_NEAR(found.covariance(0, 1), -2.0 * own, 1e-12 * own);
  EXPECT_NEAR(found.covariance(1, 0), -2.0 * own, 1e-12 * own);
  EXPECT_NEAR(found.covariance(1, 1), 4.0 * own, 1e-12 * own);
}

TEST(SensorNoiseJackknife, ErrorOfARatioIsWhatItScattersBy)
{
  // Relative noise of 40 x 50 values: mean square over squared mean.
  const auto ratio = [](const Block & sums) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, sums.square * sums.count / (sums.sum * sums.sum)));
  };
  constexpr int trials = 200;
  double        sum = 0.0;
  double        square = 0.0;
  double        predicted = 0.0;
  for (int trial = 0; trial < trials; ++trial)
  {
    const auto found = Jackknife(NormalBlocks(40, 50, 100 + static_cast<std::uint64_t>(trial)), ratio);
    sum += found.value(0);
    square += found.value(0) * found.value(0);
    predicted += found.covariance(0, 0) / trials;
  }
  const double scatter = (square - sum * sum / trials) / (trials - 1.0);
  EXPECT_NEAR(predicted / scatter, 1.0, 4.5 * std::sqrt(2.0 / trials)); // a variance of 200 values
  EXPECT_NEAR(sum / trials, 1.0 + 4.0 / 9.0, 4.5 * std::sqrt(scatter / trials) + 1e-3);
}

TEST(SensorNoiseJackknife, EqualBlocksHaveNoError)
{
  const auto found = Jackknife(std::vector<Block>(8, { 2.0, 5.0, 20.0 }), MeanOf);
  EXPECT_EQ(found.value(0), 2.5);
  EXPECT_NEAR(found.StandardError(0), 0.0, 1e-15);
}

TEST(SensorNoiseJackknife, FewerThanTwoBlocksHaveAnInfiniteError)
{
  for (const std::size_t count : { 0, 1 })
  {
    const auto found = Jackknife(std::vector<Block>(count, { 2.0, 5.0, 20.0 }), MeanOf);
    EXPECT_EQ(found.StandardError(0), std::numeric_limits<double>::infinity()) << count;
    EXPECT_EQ(found.StandardErrors()(0), std::numeric_limits<double>::infinity()) << count;
  }
}
