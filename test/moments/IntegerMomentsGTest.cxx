// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/TemporalMoments.h"
#include "helpers/StackTestHelper.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
/** Returns frames of values over the whole range of the type; every eighth value is one of its ends. */
template <typename TPixel>
std::vector<TPixel>
RandomFrames(std::size_t pixels, std::size_t frames, std::uint64_t seed)
{
  using Limits = std::numeric_limits<TPixel>;
  std::mt19937_64     random(seed);
  std::vector<TPixel> stack(pixels * frames);
  for (TPixel & value : stack)
  {
    const std::uint64_t bits = random();
    value = bits % 8 == 0 ? (bits % 16 == 0 ? Limits::min() : Limits::max()) : static_cast<TPixel>(bits >> 32);
  }
  return stack;
}

template <typename TPixel>
IntegerMoments<TPixel>
MomentsOf(const std::vector<TPixel> & stack, std::size_t pixels, std::size_t first, std::size_t last)
{
  IntegerMoments<TPixel> moments(pixels);
  moments.AddFrames(stack.data() + first * pixels, pixels, last - first, 0, pixels);
  moments.AdvanceFrames(last - first);
  return moments;
}

template <typename TPixel>
IntegerMoments<TPixel>
MomentsOf(const std::vector<TPixel> & stack, std::size_t pixels)
{
  return MomentsOf(stack, pixels, 0, stack.size() / pixels);
}

/** Computes the mean S/n and the squared deviations (n Q - S^2)/n, with S, Q and n Q - S^2 as exact 64-bit integers. */
template <typename TPixel>
void
ExpectMomentsEqualBruteForce(const IntegerMoments<TPixel> & moments,
                             const std::vector<TPixel> &    stack,
                             std::size_t                    pixels)
{
  const std::size_t frames = stack.size() / pixels;
  const auto        n = static_cast<std::int64_t>(frames);
  ASSERT_EQ(moments.GetNumberOfFrames(), frames);
  for (std::size_t p = 0; p < pixels; ++p)
  {
    std::int64_t sum = 0;
    std::int64_t squares = 0;
    double       lowest = stack[p];
    double       highest = stack[p];
    for (std::size_t t = 0; t < frames; ++t)
    {
      const std::int64_t value = stack[t * pixels + p];
      sum += value;
      squares += value * value;
      lowest = std::min(lowest, static_cast<double>(value));
      highest = std::max(highest, static_cast<double>(value));
    }
    const double deviations = static_cast<double>(n * squares - sum * sum) / static_cast<double>(n);
    // The mean is rounded as S/n, and again after the shift by at most 2^15: by two halves of the last digit of 2^16.
    const double meanTolerance = 65536.0 * std::numeric_limits<double>::epsilon();
    ASSERT_NEAR(moments.GetMean(p), static_cast<double>(sum) / static_cast<double>(n), meanTolerance) << p;
    ASSERT_DOUBLE_EQ(moments.GetSumOfSquaredDeviations(p), deviations) << p;
    ASSERT_DOUBLE_EQ(moments.GetVariance(p), deviations / static_cast<double>(n - 1)) << p;
    ASSERT_EQ(moments.GetMinimum(p), lowest) << p;
    ASSERT_EQ(moments.GetMaximum(p), highest) << p;
    ASSERT_TRUE(moments.IsFinite(p));
  }
}

template <typename TPixel>
void
ExpectSameBits(const IntegerMoments<TPixel> & a, const IntegerMoments<TPixel> & b)
{
  ASSERT_EQ(a.GetNumberOfFrames(), b.GetNumberOfFrames());
  ASSERT_EQ(a.GetNumberOfPixels(), b.GetNumberOfPixels());
  for (std::size_t p = 0; p < a.GetNumberOfPixels(); ++p)
  {
    ASSERT_EQ(a.GetMean(p), b.GetMean(p)) << p;
    ASSERT_EQ(a.GetSumOfSquaredDeviations(p), b.GetSumOfSquaredDeviations(p)) << p;
    ASSERT_EQ(a.GetMinimum(p), b.GetMinimum(p)) << p;
    ASSERT_EQ(a.GetMaximum(p), b.GetMaximum(p)) << p;
  }
}

/** Expects the mean squared deviation of a two-point distribution: \a high of \a n frames have the value \a top, the
 * others \a bottom. */
template <typename TPixel>
void
ExpectTwoPointLaw(std::size_t n, std::size_t high, TPixel bottom, TPixel top)
{
  std::vector<TPixel> stack(2 * n, bottom); // pixel 0 begins with the high frames, pixel 1 ends with them
  for (std::size_t t = 0; t < high; ++t)
  {
    stack[2 * t] = top;
    stack[2 * (n - 1 - t) + 1] = top;
  }
  const auto   moments = MomentsOf(stack, 2);
  const double fraction = static_cast<double>(high) / static_cast<double>(n);
  const double height = static_cast<double>(top) - static_cast<double>(bottom);
  for (std::size_t p = 0; p < 2; ++p)
  {
    EXPECT_NEAR(moments.GetMean(p), bottom + fraction * height, 65536.0 * std::numeric_limits<double>::epsilon());
    EXPECT_DOUBLE_EQ(moments.GetSumOfSquaredDeviations(p), fraction * static_cast<double>(n - high) * height * height);
  }
}
} // namespace

template <typename TPixel>
class SensorNoiseIntegerMoments : public ::testing::Test
{};
using PixelTypes = ::testing::Types<unsigned char, signed char, unsigned short, short>;
TYPED_TEST_SUITE(SensorNoiseIntegerMoments, PixelTypes);

TYPED_TEST(SensorNoiseIntegerMoments, EqualBruteForceForEvenAndOddNumbersOfFrames)
{
  constexpr std::size_t pixels = 2100; // more than two blocks
  for (const std::size_t frames : { 2, 3, 36, 37 })
  {
    const auto stack = RandomFrames<TypeParam>(pixels, frames, frames);
    ExpectMomentsEqualBruteForce(MomentsOf(stack, pixels), stack, pixels);
  }
}

TYPED_TEST(SensorNoiseIntegerMoments, ChunksAndRangesOfPixelsChangeNoBit)
{
  constexpr std::size_t     pixels = 2100;
  constexpr std::size_t     frames = 29;
  const auto                stack = RandomFrames<TypeParam>(pixels, frames, 4);
  IntegerMoments<TypeParam> moments(pixels);
  for (std::size_t t = 0, chunk = 1; t < frames; t += chunk, chunk = std::min(chunk + 3, frames - t))
  {
    for (const auto & range : { std::pair{ 700, 2100 }, std::pair{ 0, 1 }, std::pair{ 1, 700 } })
    {
      moments.AddFrames(stack.data() + t * pixels,
                        pixels,
                        chunk,
                        static_cast<std::size_t>(range.first),
                        static_cast<std::size_t>(range.second));
    }
    moments.AdvanceFrames(chunk);
  }
  ExpectSameBits(moments, MomentsOf(stack, pixels));
}

TYPED_TEST(SensorNoiseIntegerMoments, MergingInAnyOrderChangesNoBit)
{
  constexpr std::size_t pixels = 50;
  const auto            stack = RandomFrames<TypeParam>(pixels, 31, 5);
  const auto            whole = MomentsOf(stack, pixels);
  const auto            a = MomentsOf(stack, pixels, 0, 7);
  const auto            b = MomentsOf(stack, pixels, 7, 20);
  const auto            c = MomentsOf(stack, pixels, 20, 31);
  auto                  forwards = a;
  forwards.Merge(b);
  forwards.Merge(c);
  auto backwards = IntegerMoments<TypeParam>(pixels); // initially empty
  backwards.Merge(c);
  backwards.Merge(a);
  backwards.Merge(b);
  ExpectSameBits(forwards, whole);
  ExpectSameBits(backwards, whole);
}

TYPED_TEST(SensorNoiseIntegerMoments, ConstantPixelHasNoVariance)
{
  using Limits = std::numeric_limits<TypeParam>;
  for (const TypeParam value : { Limits::min(), Limits::max(), TypeParam{ 0 }, TypeParam{ 77 } })
  {
    const auto moments = MomentsOf(std::vector<TypeParam>(3 * 11, value), 3);
    EXPECT_EQ(moments.GetMean(1), value);
    EXPECT_EQ(moments.GetVariance(1), 0.0);
    EXPECT_EQ(moments.GetMinimum(1), value);
    EXPECT_EQ(moments.GetMaximum(1), value);
  }
}

TYPED_TEST(SensorNoiseIntegerMoments, SeventyThousandFramesAtTheEndsOfTheRangeAreExact)
{
  using Limits = std::numeric_limits<TypeParam>;
  for (const std::size_t high : { 0, 1, 35000, 69999, 70000 })
  {
    ExpectTwoPointLaw<TypeParam>(70000, high, Limits::min(), Limits::max());
  }
  ExpectTwoPointLaw<TypeParam>(70001, 30000, Limits::min(), Limits::max());
}

TYPED_TEST(SensorNoiseIntegerMoments, AsManyFramesAsThereMayBeAreExact)
{
  using Limits = std::numeric_limits<TypeParam>;
  // Pixel 0 is low in one of four frames, pixel 1 high, pixel 2 never changes.
  const TypeParam              low = Limits::min();
  const TypeParam              high = Limits::max();
  const std::vector<TypeParam> four = { low, high, low, high, low, low, high, low, low, high, low, low };
  IntegerMoments<TypeParam>    moments = MomentsOf(four, 3);
  while (2 * moments.GetNumberOfFrames() <= IntegerMoments<TypeParam>::MostFrames)
  {
    const IntegerMoments<TypeParam> same = moments;
    moments.Merge(same);
  }
  const auto   n = static_cast<double>(IntegerMoments<TypeParam>::MostFrames);
  const double height = static_cast<double>(high) - static_cast<double>(low);
  ASSERT_EQ(moments.GetNumberOfFrames(), IntegerMoments<TypeParam>::MostFrames);
  for (const std::size_t p : { 0, 1 }) // a quarter times three quarters of the frames, exact below 2^53
  {
    EXPECT_EQ(moments.GetSumOfSquaredDeviations(p), 3.0 / 16.0 * n * height * height) << p;
  }
  EXPECT_EQ(moments.GetSumOfSquaredDeviations(2), 0.0);
  EXPECT_EQ(moments.GetMean(2), static_cast<double>(low));
  EXPECT_THROW(moments.AdvanceFrames(1), std::invalid_argument);
  EXPECT_THROW(moments.Merge(MomentsOf(four, 3)), std::invalid_argument);
  EXPECT_EQ(moments.GetNumberOfFrames(), IntegerMoments<TypeParam>::MostFrames); // the refused calls changed nothing
}

TYPED_TEST(SensorNoiseIntegerMoments, MapsHaveTheBitsOfTheMoments)
{
  constexpr std::size_t pixels = 2 * PixelsPerBlock + 100;
  for (const std::size_t frames : { 1, 2, 9 })
  {
    auto       moments = MomentsOf(RandomFrames<TypeParam>(pixels, frames, 3), pixels);
    const auto kept = moments;
    const auto maps = moments.TakeMaps(test::Threads(2));
    EXPECT_EQ(moments.GetNumberOfPixels(), 0U); // they were moved out
    ASSERT_EQ(maps.GetNumberOfPixels(), pixels);
    for (std::size_t p = 0; p < pixels; ++p)
    {
      ASSERT_EQ(maps.mean[p], kept.GetMean(p)) << p;
      ASSERT_EQ(maps.variance[p], frames > 1 ? kept.GetVariance(p) : 0.0) << p;
      ASSERT_EQ(maps.GetMinimum(p), kept.GetMinimum(p)) << p;
      ASSERT_EQ(maps.GetMaximum(p), kept.GetMaximum(p)) << p;
      ASSERT_TRUE(maps.IsFinite(p));
    }
  }
}

TYPED_TEST(SensorNoiseIntegerMoments, FramesMayLieApart)
{
  constexpr std::size_t     pixels = 5;
  constexpr std::size_t     stride = 9;
  const auto                wide = RandomFrames<TypeParam>(stride, 6, 8);
  IntegerMoments<TypeParam> moments(pixels);
  moments.AddFrames(wide.data(), stride, 6, 0, pixels);
  moments.AdvanceFrames(6);
  std::vector<TypeParam> narrow;
  for (std::size_t i = 0; i < wide.size(); ++i)
  {
    if (i % stride < pixels)
    {
      narrow.push_back(wide[i]);
    }
  }
  ExpectMomentsEqualBruteForce(moments, narrow, pixels);
}

TYPED_TEST(SensorNoiseIntegerMoments, MergeRefusesAnotherNumberOfPixels)
{
  IntegerMoments<TypeParam> moments(4);
  EXPECT_THROW(moments.Merge(IntegerMoments<TypeParam>(5)), std::invalid_argument);
}
