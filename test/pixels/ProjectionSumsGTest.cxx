// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ProjectionSums.h"
#include "base/Eigen.h"
#include "moments/TemporalMoments.h"
#include "scene/ReferenceFrame.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Pixels = 300; // more than a block
constexpr std::size_t Frames = 23;
constexpr std::size_t Series = 5;

const TemporalBasis &
Basis()
{
  static const auto basis = [] {
    std::mt19937               random(3);
    std::normal_distribution<> normal;
    std::vector<double>        flicker(Frames);
    Eigen::MatrixXd            motion(Frames, Series - 1);
    for (std::size_t t = 0; t < Frames; ++t)
    {
      flicker[t] = normal(random);
      for (Eigen::Index j = 0; j < motion.cols(); ++j)
      {
        motion(static_cast<Eigen::Index>(t), j) = normal(random);
      }
    }
    return TemporalBasis(flicker, Eigen::MatrixXd(Frames, 0), motion);
  }();
  return basis;
}

/** Returns values over the whole range of the type; floating-point values are about 1000. */
template <typename TPixel>
std::vector<TPixel>
Stack()
{
  std::mt19937_64            random(5);
  std::normal_distribution<> normal(1000.0, 100.0);
  std::vector<TPixel>        stack(Pixels * Frames);
  for (TPixel & value : stack)
  {
    value = std::is_integral_v<TPixel> ? static_cast<TPixel>(random() >> 20) : static_cast<TPixel>(normal(random));
  }
  return stack;
}

/** Returns the sums over the frames [first, last), which are added in chunks. */
template <typename TPixel>
ProjectionSums
SumsOf(const std::vector<TPixel> & stack, std::size_t first, std::size_t last, std::size_t chunk = Frames)
{
  ProjectionSums sums(Pixels, Series);
  for (std::size_t t = first; t < last; t += chunk)
  {
    const std::size_t     count = std::min(chunk, last - t);
    const ProjectedFrames frames(Basis(), stack.data() + t * Pixels, PixelLayout::OfFrames({ Pixels, 1, 1 }), t, count);
    sums.AddFrames(frames, 100, Pixels);
    sums.AddFrames(frames, 0, 100);
  }
  return sums;
}

void
ExpectSameBits(const ProjectionSums & a, const ProjectionSums & b)
{
  ASSERT_EQ(a.GetNumberOfSeries(), b.GetNumberOfSeries());
  for (std::size_t i = 0; i < Pixels * Series; ++i)
  {
    ASSERT_EQ(a.At(i / Series, i % Series), b.At(i / Series, i % Series)) << i;
  }
}
} // namespace

template <typename TPixel>
class SensorNoiseProjectionSumsOf : public ::testing::Test
{};
using PixelTypes = ::testing::Types<unsigned char, short, unsigned short, float, double>;
TYPED_TEST_SUITE(SensorNoiseProjectionSumsOf, PixelTypes);

TYPED_TEST(SensorNoiseProjectionSumsOf, AnyChunksAndRangesOfPixelsGiveTheSameBits)
{
  const auto stack = Stack<TypeParam>();
  const auto expected = SumsOf(stack, 0, Frames);
  for (const std::size_t chunk : { 1, 3, 4, 10 })
  {
    ExpectSameBits(SumsOf(stack, 0, Frames, chunk), expected);
  }
}

TYPED_TEST(SensorNoiseProjectionSumsOf, AreSumsOfSeriesTimesValue)
{
  ASSERT_EQ(Basis().Size(), Series);
  const auto stack = Stack<TypeParam>();
  const auto sums = SumsOf(stack, 0, Frames);
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    for (std::size_t j = 0; j < Series; ++j)
    {
      long double sum = 0.0L; // 64 bits, exact for integers
      long double size = 0.0L;
      for (std::size_t t = 0; t < Frames; ++t)
      {
        const long double product = static_cast<long double>(Basis().Rounded(t, j)) * stack[t * Pixels + p];
        sum += product;
        size += std::abs(product);
      }
      const long double tolerance = std::is_integral_v<TypeParam> ? 0.0L : 1e-15L * size;
      ASSERT_LE(std::abs(sums.At(p, j) - sum), tolerance) << p << ' ' << j;
    }
  }
}

TYPED_TEST(SensorNoiseProjectionSumsOf, MergedPartsAgreeWithTheWhole)
{
  const auto stack = Stack<TypeParam>();
  const auto whole = SumsOf(stack, 0, Frames);
  const auto a = SumsOf(stack, 0, 7);
  const auto b = SumsOf(stack, 7, 8);
  const auto c = SumsOf(stack, 8, Frames);
  auto       backwards = ProjectionSums(Pixels, Series);
  backwards.Merge(c);
  backwards.Merge(a);
  backwards.Merge(b);
  if (std::is_integral_v<TypeParam>)
  {
    ExpectSameBits(backwards, whole);
  }
  for (std::size_t i = 0; i < Pixels * Series; ++i)
  {
    // 23 products of up to 2^20 times 2,000.
    const double tolerance = 1e-15 * 23.0 * 2000.0 * TemporalBasis::Unit;
    ASSERT_NEAR(backwards.At(i / Series, i % Series), whole.At(i / Series, i % Series), tolerance) << i;
  }
}

TEST(SensorNoiseProjectionSums, ResidualSquaresOfMergedChunksAreTheWholes)
{
  // RSS = M2 - C' P^-1 C of merged chunks, estimator.md 6. From exact sums it has the same bits in any order.
  using GreyValue = unsigned short;
  const auto stack = Stack<GreyValue>();
  const auto rssOf = [&](const std::vector<std::pair<std::size_t, std::size_t>> & parts) {
    IntegerMoments<GreyValue> moments(Pixels);
    ProjectionSums            sums(Pixels, Series);
    for (const auto & [first, last] : parts)
    {
      IntegerMoments<GreyValue> own(Pixels);
      own.AddFrames(stack.data() + first * Pixels, Pixels, last - first, 0, Pixels);
      own.AdvanceFrames(last - first);
      moments.Merge(own);
      sums.Merge(SumsOf(stack, first, last));
    }
    std::vector<double> rss;
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      const double mean = moments.GetMean(p);
      Basis().ToCoordinates(&sums.At(p, 0), ProjectionSums::BlockPixels, &mean, 1);
      rss.push_back(moments.GetSumOfSquaredDeviations(p));
      for (std::size_t j = 0; j < Series; ++j)
      {
        rss.back() -= sums.At(p, j) * sums.At(p, j);
      }
    }
    return rss;
  };
  const auto whole = rssOf({ { 0, Frames } });
  EXPECT_EQ(rssOf({ { 15, Frames }, { 0, 4 }, { 4, 15 } }), whole);
  EXPECT_GT(*std::min_element(whole.begin(), whole.end()), 0.0);
}

TYPED_TEST(SensorNoiseProjectionSumsOf, AllFramesAtOnceHaveTheResidualSquaresOfTheirSums)
{
  constexpr std::size_t      factors = 2;
  const auto                 stack = Stack<TypeParam>();
  TemporalMoments<TypeParam> moments(Pixels);
  ReferenceFrame             frame;
  frame.frames = Frames;
  moments.AddFrames(stack.data(), Pixels, Frames, 0, Pixels);
  moments.AdvanceFrames(Frames);
  std::vector<double> variance;
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    frame.mean.push_back(moments.GetMean(p));
    variance.push_back(moments.GetVariance(p));
  }
  frame.variance = variance;
  ProjectionSums   sums = SumsOf(stack, 0, Frames);
  ResidualSquares  expected;
  PixelCoordinates coordinates(Pixels, factors);
  AppendResidualSquares(frame, Basis(), sums, SerialFor, expected, coordinates);
  EXPECT_EQ(sums.FirstPixel(), ProjectionSums::SlabPixels);

  PixelCoordinates kept(Pixels, factors);
  kept.AllocateSlabOf(0);
  const ProjectedFrames frames(Basis(), stack.data(), PixelLayout::OfFrames({ Pixels, 1, 1 }), 0, Frames);
  ResidualSquares       squares{ std::vector<double>(Pixels), std::vector<float>(Pixels) };
  FillResidualSquares(frame, Basis(), frames, 0, Pixels, squares, kept);
  EXPECT_EQ(squares.rss.GetDoubles(), expected.rss.GetDoubles());
  EXPECT_EQ(squares.skew, expected.skew);
  for (std::size_t i = 0; i < Pixels * factors; ++i)
  {
    ASSERT_EQ(kept.At(i / factors, i % factors), coordinates.At(i / factors, i % factors)) << i;
  }
}

TYPED_TEST(SensorNoiseProjectionSumsOf, ManyFramesOfTheLargestProductsAreExact)
{
  // Two temporal components as far from 0 as possible, and pixels at both ends of their range.
  if constexpr (std::is_integral_v<TypeParam>)
  {
    constexpr std::size_t frames = 71;
    std::vector<double>   flicker(frames, 1.0);
    flicker[40] = -1e9; // the temporal component is nearly 2^20 here
    Eigen::MatrixXd motion = Eigen::MatrixXd::Ones(frames, 1);
    motion(5, 0) = 1e9;
    const TemporalBasis basis(flicker, Eigen::MatrixXd(frames, 0), motion);
    ASSERT_EQ(basis.Size(), 2U);
    ASSERT_GT(std::abs(basis.Rounded(40, 0)), 0.98 * TemporalBasis::Unit);
    using Limits = std::numeric_limits<TypeParam>;
    std::vector<TypeParam> stack(Pixels * frames);
    for (std::size_t i = 0; i < stack.size(); ++i)
    {
      const std::size_t p = i % Pixels;
      stack[i] = p % 3 == 0 ? Limits::max() : p % 3 == 1 ? Limits::lowest() : static_cast<TypeParam>(i * 2654435761U);
    }
    ProjectionSums sums(Pixels, 2);
    sums.AddFrames(ProjectedFrames(basis, stack.data(), PixelLayout::OfFrames({ Pixels, 1, 1 }), 0, frames), 0, Pixels);
    for (std::size_t i = 0; i < 2 * Pixels; ++i)
    {
      double sum = 0.0;
      for (std::size_t t = 0; t < frames; ++t)
      {
        sum += basis.Rounded(t, i % 2) * stack[t * Pixels + i / 2];
      }
      ASSERT_EQ(sums.At(i / 2, i % 2), sum) << i;
    }
  }
}

TEST(SensorNoiseProjectionSums, NarrowOnesGiveTheWideOnes)
{
  // Sums over some of the frames exceed 2^32; what is within 2^31 is the sum over all of series times deviation.
  std::mt19937                random(8);
  std::normal_distribution<>  normal(0.0, 5.0);
  std::vector<unsigned short> stack(Pixels * Frames);
  std::vector<double>         mean(Pixels);
  for (std::size_t i = 0; i < stack.size(); ++i)
  {
    const double level = 219.0 * static_cast<double>(i % Pixels);
    stack[i] = static_cast<unsigned short>(std::clamp(level + normal(random), 0.0, 65535.0));
    mean[i % Pixels] += static_cast<double>(stack[i]) / static_cast<double>(Frames);
  }
  const TemporalBasis   basis = Basis().WithUnit(TemporalBasis::Unit / 4.0);
  const auto            layout = PixelLayout::OfFrames({ Pixels, 1, 1 });
  const ProjectedFrames frames(basis, stack.data(), layout, 0, Frames);
  ProjectionSums        wide(Pixels, Series);
  wide.AddFrames(frames, 0, Pixels);
  const auto narrowOf = [&](std::size_t first, std::size_t count) {
    ProjectionSums sums(Pixels, Series, SerialFor, 0, 1, SumWidth::Narrow);
    sums.AddFrames(ProjectedFrames(basis, stack.data() + first * Pixels, layout, first, count), 0, Pixels);
    return sums;
  };
  ProjectionSums narrow = narrowOf(9, Frames - 9);
  narrow.Merge(narrowOf(0, 9));
  ProjectionSums part(Pixels, Series);
  part.AddFrames(ProjectedFrames(basis, stack.data(), layout, 0, 9), 0, Pixels);
  double largest = 0.0; // largest error of this part
  for (std::size_t first = 0; first < Pixels; first += ProjectionSums::BlockPixels)
  {
    const std::size_t   pixels = std::min(ProjectionSums::BlockPixels, Pixels - first);
    std::vector<double> sums(Series * ProjectionSums::BlockPixels);
    narrow.CopyBlock(first, pixels, basis, mean.data() + first, sums.data());
    for (std::size_t i = 0; i < pixels * Series; ++i)
    {
      const double own = sums[i % Series * ProjectionSums::BlockPixels + i / Series];
      ASSERT_EQ(own, wide.At(first + i / Series, i % Series)) << first << ' ' << i;
      largest = std::max(largest, std::abs(part.At(first + i / Series, i % Series)));
    }
  }
  EXPECT_GT(largest, std::exp2(32.0));
  EXPECT_THROW(narrow.Merge(wide), std::invalid_argument);
}

TEST(SensorNoiseProjectionSums, MergeRefusesOtherSizes)
{
  ProjectionSums sums(4, 2);
  EXPECT_THROW(sums.Merge(ProjectionSums(5, 2)), std::invalid_argument);
  EXPECT_THROW(sums.Merge(ProjectionSums(4, 3)), std::invalid_argument);
}

TEST(SensorNoiseProjectionSums, SlabsByThemselvesHaveTheBitsOfAllTogether)
{
  constexpr std::size_t       pixels = 2 * ProjectionSums::SlabPixels + 1000;
  std::mt19937                random(6);
  std::vector<unsigned short> stack(pixels * Frames);
  std::generate(stack.begin(), stack.end(), [&random] { return static_cast<unsigned short>(random()); });
  const auto sumsOf = [&](std::size_t firstSlab, std::size_t lastSlab) {
    ProjectionSums sums(pixels, Series, SerialFor, firstSlab, lastSlab);
    sums.AddFrames(ProjectedFrames(Basis(), stack.data(), PixelLayout::OfFrames({ pixels, 1, 1 }), 0, Frames),
                   sums.FirstPixel(),
                   sums.LastPixel());
    return sums;
  };
  ASSERT_EQ(ProjectionSums::NumberOfSlabs(pixels), 3U);
  ProjectionSums all = sumsOf(0, 100);
  EXPECT_EQ(all.LastPixel(), pixels);
  for (std::size_t slab = 0; slab < 3; ++slab)
  {
    const ProjectionSums own = sumsOf(slab, slab + 1);
    EXPECT_EQ(own.FirstPixel(), slab * ProjectionSums::SlabPixels);
    ASSERT_EQ(all.FirstPixel(), own.FirstPixel());
    for (std::size_t p = own.FirstPixel(); p < own.LastPixel(); p += 97)
    {
      for (std::size_t j = 0; j < Series; ++j)
      {
        ASSERT_EQ(own.At(p, j), all.At(p, j)) << p << ' ' << j;
      }
    }
    all.ReleaseFirstSlab();
  }
  EXPECT_GE(all.FirstPixel(), all.LastPixel());
  ProjectionSums first = sumsOf(0, 1);
  EXPECT_THROW(first.Merge(sumsOf(1, 2)), std::invalid_argument);
}
