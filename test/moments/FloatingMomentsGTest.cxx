// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/TemporalMoments.h"
#include "helpers/StackTestHelper.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
template <typename TPixel>
std::vector<TPixel>
NormalFrames(std::size_t pixels, std::size_t frames, double mean, double sd)
{
  std::mt19937_64            random(17);
  std::normal_distribution<> normal(mean, sd);
  std::vector<TPixel>        stack(pixels * frames);
  std::generate(stack.begin(), stack.end(), [&] { return static_cast<TPixel>(normal(random)); });
  return stack;
}

template <typename TPixel>
FloatingMoments<TPixel>
MomentsOf(const std::vector<TPixel> & stack, std::size_t pixels, std::size_t first, std::size_t last)
{
  FloatingMoments<TPixel> moments(pixels);
  moments.AddFrames(stack.data() + first * pixels, pixels, last - first, 0, pixels);
  moments.AdvanceFrames(last - first);
  return moments;
}

/** Computes the moments in long double in two passes: the mean, then the squared deviations. */
template <typename TPixel>
void
ExpectMomentsEqualTwoPasses(const FloatingMoments<TPixel> & moments,
                            const std::vector<TPixel> &     stack,
                            std::size_t                     pixels,
                            double                          tolerance)
{
  const std::size_t frames = stack.size() / pixels;
  ASSERT_EQ(moments.GetNumberOfFrames(), frames);
  for (std::size_t p = 0; p < pixels; ++p)
  {
    long double mean = 0.0L;
    double      lowest = stack[p];
    double      highest = stack[p];
    for (std::size_t t = 0; t < frames; ++t)
    {
      const double value = stack[t * pixels + p];
      mean += value / static_cast<long double>(frames);
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    long double squares = 0.0L;
    for (std::size_t t = 0; t < frames; ++t)
    {
      const long double deviation = stack[t * pixels + p] - mean;
      squares += deviation * deviation;
    }
    const auto expectedMean = static_cast<double>(mean);
    const auto expectedSquares = static_cast<double>(squares);
    ASSERT_NEAR(moments.GetMean(p), expectedMean, 1e-14 * std::abs(expectedMean) + 1e-14) << p;
    ASSERT_NEAR(moments.GetSumOfSquaredDeviations(p), expectedSquares, tolerance * expectedSquares) << p;
    const double dof = static_cast<double>(frames - 1);
    ASSERT_NEAR(moments.GetVariance(p), expectedSquares / dof, tolerance * expectedSquares / dof) << p;
    ASSERT_EQ(moments.GetMinimum(p), lowest) << p;
    ASSERT_EQ(moments.GetMaximum(p), highest) << p;
    ASSERT_TRUE(moments.IsFinite(p)) << p;
  }
}

template <typename TPixel>
void
ExpectSameBits(const FloatingMoments<TPixel> & a, const FloatingMoments<TPixel> & b)
{
  ASSERT_EQ(a.GetNumberOfFrames(), b.GetNumberOfFrames());
  for (std::size_t p = 0; p < a.GetNumberOfPixels(); ++p)
  {
    ASSERT_EQ(a.GetMean(p), b.GetMean(p)) << p;
    ASSERT_EQ(a.GetSumOfSquaredDeviations(p), b.GetSumOfSquaredDeviations(p)) << p;
    ASSERT_EQ(a.GetMinimum(p), b.GetMinimum(p)) << p;
    ASSERT_EQ(a.GetMaximum(p), b.GetMaximum(p)) << p;
  }
}
} // namespace

template <typename TPixel>
class SensorNoiseFloatingMoments : public ::testing::Test
{};
using PixelTypes = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SensorNoiseFloatingMoments, PixelTypes);

TYPED_TEST(SensorNoiseFloatingMoments, EqualTwoPassesInLongDouble)
{
  for (const std::size_t frames : { 2, 3, 60 })
  {
    const auto stack = NormalFrames<TypeParam>(1100, frames, 300.0, 20.0);
    // Each of T steps rounds by eps times mean/sd = 15: 60 * 2.2e-16 * 15 = 2e-13. Nearly equal pairs need more.
    ExpectMomentsEqualTwoPasses(MomentsOf(stack, 1100, 0, frames), stack, 1100, frames == 60 ? 1e-12 : 1e-9);
  }
}

TYPED_TEST(SensorNoiseFloatingMoments, ChunksAndRangesOfPixelsChangeNoBit)
{
  constexpr std::size_t      pixels = 1100;
  constexpr std::size_t      frames = 23;
  const auto                 stack = NormalFrames<TypeParam>(pixels, frames, -5.0, 2.0);
  FloatingMoments<TypeParam> moments(pixels);
  for (std::size_t t = 0, chunk = 1; t < frames; t += chunk, chunk = std::min(chunk + 2, frames - t))
  {
    moments.AddFrames(stack.data() + t * pixels, pixels, chunk, 333, pixels);
    moments.AddFrames(stack.data() + t * pixels, pixels, chunk, 0, 333);
    moments.AdvanceFrames(chunk);
  }
  ExpectSameBits(moments, MomentsOf(stack, pixels, 0, frames));
}

TYPED_TEST(SensorNoiseFloatingMoments, MergingAgreesWithAddingFrames)
{
  constexpr std::size_t      pixels = 40;
  const auto                 stack = NormalFrames<TypeParam>(pixels, 50, 300.0, 20.0);
  FloatingMoments<TypeParam> merged(pixels); // initially empty
  for (const auto & part : { std::pair{ 0, 3 }, std::pair{ 3, 30 }, std::pair{ 30, 30 }, std::pair{ 30, 50 } })
  {
    merged.Merge(MomentsOf(stack, pixels, static_cast<std::size_t>(part.first), static_cast<std::size_t>(part.second)));
  }
  ExpectMomentsEqualTwoPasses(merged, stack, pixels, 1e-12); // the guaranteed accuracy
  auto other = MomentsOf(stack, pixels, 30, 50);
  other.Merge(MomentsOf(stack, pixels, 0, 30));
  ExpectMomentsEqualTwoPasses(other, stack, pixels, 1e-12);
  FloatingMoments<TypeParam> empty(pixels);
  empty.Merge(FloatingMoments<TypeParam>(pixels));
  EXPECT_EQ(empty.GetNumberOfFrames(), 0u);
  EXPECT_EQ(empty.GetMean(0), 0.0);
}

TYPED_TEST(SensorNoiseFloatingMoments, OnePixelThatIsNotFiniteOnceStaysNotFiniteAndAlone)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { nan, infinity, -infinity })
  {
    for (const std::size_t when : { 0, 4, 8 })
    {
      auto stack = NormalFrames<TypeParam>(3, 9, 10.0, 1.0);
      stack[when * 3 + 1] = static_cast<TypeParam>(bad);
      auto moments = MomentsOf(stack, 3, 0, 5);
      moments.Merge(MomentsOf(stack, 3, 5, 9));
      EXPECT_FALSE(moments.IsFinite(1)) << bad << " in frame " << when;
      EXPECT_TRUE(moments.IsFinite(0));
      EXPECT_TRUE(moments.IsFinite(2));
      EXPECT_FALSE(MomentsOf(stack, 3, 0, 9).IsFinite(1)) << bad << " in frame " << when;
    }
  }
}

TYPED_TEST(SensorNoiseFloatingMoments, MapsHaveTheBitsOfTheMoments)
{
  constexpr std::size_t pixels = 2 * PixelsPerBlock + 100;
  for (const std::size_t frames : { 1, 2, 9 })
  {
    auto stack = NormalFrames<TypeParam>(pixels, frames, 300.0, 20.0);
    stack[7] = std::numeric_limits<TypeParam>::infinity();
    auto       moments = MomentsOf(stack, pixels, 0, frames);
    const auto kept = moments;
    const auto maps = moments.TakeMaps(test::Threads(2));
    EXPECT_EQ(moments.GetNumberOfPixels(), 0U); // they were moved out
    ASSERT_EQ(maps.GetNumberOfPixels(), pixels);
    for (std::size_t p = 0; p < pixels; ++p)
    {
      ASSERT_EQ(maps.IsFinite(p), p != 7) << p;
      ASSERT_TRUE(p == 7 ? std::isnan(maps.mean[p]) : maps.mean[p] == kept.GetMean(p)) << p;
      const double expected = frames > 1 ? kept.GetVariance(p) : 0.0;
      ASSERT_TRUE(p == 7 ? std::isnan(maps.variance[p]) : maps.variance[p] == expected) << p;
      ASSERT_EQ(maps.GetMinimum(p), kept.GetMinimum(p)) << p;
      ASSERT_EQ(maps.GetMaximum(p), kept.GetMaximum(p)) << p;
    }
  }
}

TYPED_TEST(SensorNoiseFloatingMoments, ExtremesPassOverNaN)
{
  const auto nan = std::numeric_limits<TypeParam>::quiet_NaN();
  const auto moments = MomentsOf<TypeParam>({ nan, 3, 1, nan }, 1, 0, 4);
  EXPECT_EQ(moments.GetMinimum(0), 1.0);
  EXPECT_EQ(moments.GetMaximum(0), 3.0);
}

TEST(SensorNoiseFloatingMomentsOfDoubles, LargeOffsetKeepsTheVariance)
{
  const auto stack = NormalFrames<double>(20, 200, 1e9, 1.0);
  // The running mean rounds by at most 1.2e-7: 200 deviations of order 1 give a relative error below 1e-6.
  ExpectMomentsEqualTwoPasses(MomentsOf(stack, 20, 0, 200), stack, 20, 1e-6);
}

TEST(SensorNoiseFloatingMomentsOfDoubles, ConstantPixelHasNoVariance)
{
  const auto moments = MomentsOf(std::vector<double>(30, 0.1), 1, 0, 30);
  EXPECT_EQ(moments.GetMean(0), 0.1);
  EXPECT_EQ(moments.GetVariance(0), 0.0);
}

TEST(SensorNoiseFloatingMomentsOfDoubles, MergeRefusesAnotherNumberOfPixels)
{
  FloatingMoments<double> moments(4);
  EXPECT_THROW(moments.Merge(FloatingMoments<double>(5)), std::invalid_argument);
}
