// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMaps.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "sensornoise/Settings.h"
#include "moments/StackMoments.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 130; // 12,480 pixels: two blocks
constexpr std::size_t Height = 96;
constexpr std::size_t Frames = 16;

template <typename TPixel>
StackMaps
MapsOf(const Stack<TPixel> & stack, std::size_t chunk = Frames, const ParallelFor & parallelFor = SerialFor)
{
  StackMoments<TPixel> sums(stack.width * stack.height, stack.frames);
  for (std::size_t t = 0; t < stack.frames; t += chunk)
  {
    sums.AddFrames(stack.Frame(t), t, std::min(chunk, stack.frames - t), parallelFor);
  }
  return MakeStackMaps<TPixel>(sums.Take(), {}, parallelFor);
}

/** Returns digital numbers of a sensor that attains the levels from \a low to \a high only. */
Stack<std::uint16_t>
StackBetween(std::optional<double> low, std::optional<double> high, std::size_t width = Width)
{
  SimulationSettings settings = FlickeringSettings(Frames);
  settings.clipLowDn = low;
  settings.clipHighDn = high;
  return Simulate<std::uint16_t>(settings, width, Height);
}

/** Returns the values of a stack in another type. */
template <typename TPixel>
StackMaps
MapsInType(const Stack<std::uint16_t> & stack)
{
  return MapsOf(Stack<TPixel>{ stack.width, stack.height, stack.frames, { stack.pixels.begin(), stack.pixels.end() } });
}

void
ExpectTheSame(const StackMaps & maps, const StackMaps & expected)
{
  EXPECT_EQ(maps.summary.dnRange.clipLowDn, expected.summary.dnRange.clipLowDn);
  EXPECT_EQ(maps.summary.dnRange.clipHighDn, expected.summary.dnRange.clipHighDn);
  EXPECT_EQ(maps.summary.dnRange.clipSource, expected.summary.dnRange.clipSource);
  EXPECT_EQ(maps.summary.clipped, expected.summary.clipped);
  EXPECT_EQ(maps.summary.notFinite, expected.summary.notFinite);
  EXPECT_EQ(maps.valid, expected.valid);
}

template <typename TPixel>
class SensorNoiseStackMapsOfFloating : public ::testing::Test
{};
using FloatingTypes = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SensorNoiseStackMapsOfFloating, FloatingTypes, );
} // namespace

TYPED_TEST(SensorNoiseStackMapsOfFloating, CopiesOfIntegersThatSaturateLeaveOutTheSamePixels)
{
  for (const double scale : { 1.0, 0.25, 1.0 / 65535.0 })
  {
    for (const std::size_t width : { 48, 130, 400 })
    {
      const auto      greyValues = StackBetween({}, 2500.0, width);
      const StackMaps expected = MapsOf(greyValues);
      const StackMaps maps = MapsOf(greyValues.Map<TypeParam>([&](std::uint16_t u) { return scale * u; }));
      ASSERT_EQ(expected.summary.dnRange.clipSource, "low: code range, high: pile-up");
      const bool areWhole = scale == 1.0; // then the values are integers
      EXPECT_EQ(maps.summary.dnRange.clipSource,
                areWhole ? expected.summary.dnRange.clipSource : "low: none, high: pile-up");
      EXPECT_EQ(maps.summary.dnRange.clipHighDn, static_cast<double>(static_cast<TypeParam>(scale * 2500.0)));
      EXPECT_EQ(maps.summary.dnRange.clipLowDn.has_value(), areWhole);
      EXPECT_GT(maps.summary.clipped, 0u);
      EXPECT_EQ(maps.summary.clipped, expected.summary.clipped);
      EXPECT_EQ(maps.valid, expected.valid);
    }
  }
}

TYPED_TEST(SensorNoiseStackMapsOfFloating, ClipLevelThatMostPixelsAttainIsFound)
{
  const auto      greyValues = StackBetween({}, 600.0);
  const StackMaps expected = MapsOf(greyValues);
  EXPECT_EQ(expected.summary.dnRange.clipSource, "low: code range, high: pile-up");
  EXPECT_EQ(expected.summary.dnRange.clipHighDn, 600.0);
  EXPECT_GT(expected.summary.clipped, Width * Height / 2);
  const StackMaps maps = MapsOf(greyValues.Map<TypeParam>([](std::uint16_t u) { return u / 16.0; }));
  EXPECT_EQ(maps.summary.dnRange.clipHighDn, 600.0 / 16.0);
  EXPECT_EQ(maps.valid, expected.valid);
}

TYPED_TEST(SensorNoiseStackMapsOfFloating, FloorIsFoundBelowAboveAndAtZero)
{
  const auto      greyValues = StackBetween(500.0, {});
  const StackMaps expected = MapsOf(greyValues);
  ASSERT_EQ(expected.summary.dnRange.clipSource, "low: pile-up, high: code range");
  for (const double floorDn : { 500.25, 0.25, -300.25 }) // levels that are not integers
  {
    const StackMaps maps = MapsOf(greyValues.Map<TypeParam>([&](std::uint16_t u) { return u - 500.0 + floorDn; }));
    EXPECT_EQ(maps.summary.dnRange.clipLowDn, floorDn);
    EXPECT_FALSE(maps.summary.dnRange.clipHighDn);
    EXPECT_EQ(maps.summary.dnRange.clipSource, "low: pile-up, high: none");
    EXPECT_EQ(maps.valid, expected.valid);
  }
}

TYPED_TEST(SensorNoiseStackMapsOfFloating, LevelsBetweenIntegersSaturateToo)
{
  const auto stack = Simulate<TypeParam>(FlickeringSettings(Frames), Width, Height);
  EXPECT_EQ(MapsOf(stack).summary.dnRange.clipSource, "none");
  const auto      saturated = stack.Map([](TypeParam u) { return std::clamp<TypeParam>(u, 500, 2500); });
  const StackMaps maps = MapsOf(saturated);
  EXPECT_EQ(maps.summary.dnRange.clipLowDn, 500.0);
  EXPECT_EQ(maps.summary.dnRange.clipHighDn, 2500.0);
  EXPECT_EQ(maps.summary.dnRange.clipSource, "pile-up");
  for (std::size_t p = 0; p < Width * Height; ++p)
  {
    bool isWithin = true;
    for (std::size_t t = 0; t < Frames; ++t)
    {
      const TypeParam value = stack.Frame(t)[p];
      isWithin = isWithin && value > 500 && value < 2500;
    }
    ASSERT_EQ(maps.valid[p], isWithin ? 1 : 0) << p;
  }
}

TYPED_TEST(SensorNoiseStackMapsOfFloating, WithoutSaturationNothingIsLeftOut)
{
  for (const std::size_t width : { 48, 130, 400 })
  {
    const auto greyValues = StackBetween({}, {}, width);
    for (const double stepDn : { 1.0, 16.0, 60.0, 250.0 }) // the noise is from 3 to 40 DN
    {
      const StackMaps maps = MapsOf(
        greyValues.Map<TypeParam>([&](std::uint16_t u) { return 0.25 + stepDn * static_cast<int>(u / stepDn + 0.5); }));
      EXPECT_EQ(maps.summary.dnRange.clipSource, "none") << width << ", " << stepDn;
      EXPECT_EQ(maps.summary.clipped, 0u);
      EXPECT_EQ(std::count(maps.valid.begin(), maps.valid.end(), 1), static_cast<std::ptrdiff_t>(maps.valid.size()));
    }
  }
}

TYPED_TEST(SensorNoiseStackMapsOfFloating, PixelsThatAreNotFiniteHideNoClipLevel)
{
  auto            stack = StackBetween({}, 2500.0).Map<TypeParam>([](std::uint16_t u) { return u; });
  const StackMaps expected = MapsOf(stack);
  for (const TypeParam value : { std::numeric_limits<TypeParam>::quiet_NaN(),
                                 std::numeric_limits<TypeParam>::infinity(),
                                 -std::numeric_limits<TypeParam>::infinity() })
  {
    for (std::size_t k = 0; k < 20; ++k)
    {
      stack.pixels[(k % Frames) * Width * Height + 7 * k] = value;
      stack.pixels[((k + 1) % Frames) * Width * Height + 7 * k] = 9999; // beyond the clip level
    }
    const StackMaps maps = MapsOf(stack);
    EXPECT_EQ(maps.summary.dnRange.clipHighDn, 2500.0);
    EXPECT_EQ(maps.summary.dnRange.clipSource, expected.summary.dnRange.clipSource);
    EXPECT_EQ(maps.summary.notFinite, 20u);
    for (std::size_t p = 0; p < Width * Height; ++p)
    {
      ASSERT_EQ(maps.valid[p], p % 7 == 0 && p < 140 ? 0 : expected.valid[p]) << p;
    }
  }
  std::fill(stack.pixels.begin(), stack.pixels.end(), std::numeric_limits<TypeParam>::quiet_NaN());
  const StackMaps maps = MapsOf(stack);
  EXPECT_EQ(maps.summary.dnRange.clipSource, "none");
  EXPECT_EQ(maps.summary.notFinite, Width * Height);
}

TYPED_TEST(SensorNoiseStackMapsOfFloating, AreTheSameForAnyChunksThreadsAndProcesses)
{
  const auto      stack = StackBetween(500.0, 2500.0).Map<TypeParam>([](std::uint16_t u) { return u / 3.0; });
  const StackMaps expected = MapsOf(stack);
  ASSERT_EQ(expected.summary.dnRange.clipSource, "pile-up");
  for (const std::size_t chunk : { 1, 5 })
  {
    ExpectTheSame(MapsOf(stack, chunk, Threads(3)), expected);
  }
  StackMoments<TypeParam> whole(Width * Height, Frames);
  for (const std::size_t first : { 11, 0, 6 }) // each part in another process, in any order
  {
    const std::size_t       end = first == 0 ? 6 : (first == 6 ? 11 : Frames);
    StackMoments<TypeParam> part(Width * Height, Frames);
    part.AddFrames(stack.Frame(first), first, end - first, Threads(2));
    std::stringstream stream;
    part.Save(stream);
    whole.Merge(stream);
  }
  ExpectTheSame(MakeStackMaps<TypeParam>(whole.Take(), {}, SerialFor), expected);
}

TEST(SensorNoiseStackMaps, TheTypeOfWholeNumbersChangesNothing)
{
  const Stack<std::uint16_t> stack = StackBetween(std::nullopt, 2000.0);
  const StackMaps            expected = MapsOf(stack);
  EXPECT_EQ(expected.summary.dnRange.clipHighDn, 2000.0);
  for (const StackMaps & maps : { MapsInType<short>(stack), MapsInType<float>(stack), MapsInType<double>(stack) })
  {
    ExpectTheSame(maps, expected);
    EXPECT_EQ(maps.summary.dnRange.bitDepth, expected.summary.dnRange.bitDepth);
    EXPECT_EQ(maps.summary.dnRange.quantisationStepDn, 1.0);
  }
}

TEST(SensorNoiseStackMaps, ClipLevelsThatNoPixelAttainsHaveCutOffNothing)
{
  const StackSummary plain = MapsOf(StackBetween(std::nullopt, std::nullopt)).summary;
  EXPECT_TRUE(plain.dnRange.clipLowDn && plain.dnRange.clipHighDn); // the ends of the DN range
  EXPECT_FALSE(plain.AttainedRange().clipLowDn || plain.AttainedRange().clipHighDn);
  const StackSummary saturated = MapsOf(StackBetween(std::nullopt, 2000.0)).summary;
  EXPECT_EQ(saturated.clippedLow, 0U);
  EXPECT_EQ(saturated.clippedHigh, saturated.clipped);
  EXPECT_EQ(saturated.AttainedRange().clipHighDn, 2000.0);
  EXPECT_FALSE(saturated.AttainedRange().clipLowDn);
}

TEST(SensorNoiseStackMaps, ScaledNumbersHaveTheirStep)
{
  const Stack<std::uint16_t> greyValues = StackBetween(std::nullopt, std::nullopt);
  Stack<float>               scaled{ greyValues.width, greyValues.height, greyValues.frames, {} };
  Stack<float>               noisy = scaled;
  for (std::size_t i = 0; i < greyValues.pixels.size(); ++i)
  {
    scaled.pixels.push_back(static_cast<float>(greyValues.pixels[i]) / 65535.0F);
    noisy.pixels.push_back(static_cast<float>(greyValues.pixels[i]) + 0.001F * static_cast<float>(i % 997));
  }
  EXPECT_NEAR(MapsOf(scaled).summary.dnRange.quantisationStepDn, 1.0 / 65535.0, 1e-9);
  EXPECT_EQ(MapsOf(noisy).summary.dnRange.quantisationStepDn, 0.0);
}

TEST(SensorNoiseStackMaps, NumbersWithoutAGridHaveNoStep)
{
  const Stack<std::uint16_t> greyValues = StackBetween(std::nullopt, std::nullopt);
  Stack<float>               coarse{ greyValues.width, greyValues.height, greyValues.frames, {} };
  for (const std::uint16_t value : greyValues.pixels) // steps of 1/16 are the last digits at 10^6
  {
    coarse.pixels.push_back(1e6F + 1e-3F * static_cast<float>(value));
  }
  EXPECT_EQ(MapsOf(coarse).summary.dnRange.quantisationStepDn, 0.0);
  for (const float stray : { 1e30F, -1e9F })
  {
    Stack<float> scaled = coarse;
    for (std::size_t i = 0; i < greyValues.pixels.size(); ++i)
    {
      scaled.pixels[i] = static_cast<float>(greyValues.pixels[i]) + 0.001F * static_cast<float>(i % 997);
    }
    for (std::size_t t = 0; t < Frames; ++t)
    {
      scaled.pixels[t * Width * Height] = stray; // pixel 0, which is sampled
    }
    EXPECT_EQ(MapsOf(scaled).summary.dnRange.quantisationStepDn, 0.0) << stray;
  }
}

TEST(SensorNoiseStackMaps, MaskedPixelsHaveNoPartInTheSummary)
{
  Stack<std::uint16_t>      stack = StackBetween(std::nullopt, 2000.0);
  std::vector<std::uint8_t> mask(Width * Height, 1);
  std::fill(mask.begin(), mask.begin() + Width * Height / 2, std::uint8_t{ 0 });
  const auto mapsOf = [&] {
    StackMoments<std::uint16_t> sums(Width * Height, Frames);
    sums.AddFrames(stack.Frame(0), 0, Frames, SerialFor);
    return MakeStackMaps<std::uint16_t>(sums.Take(), {}, SerialFor, mask);
  };
  const StackSummary before = mapsOf().summary;
  for (std::size_t i = 0; i < stack.pixels.size(); ++i)
  {
    const std::size_t p = i % (Width * Height);
    stack.pixels[i] = mask[p] == 0 ? std::uint16_t{ 4095 } : stack.pixels[i];
  }
  const StackSummary after = mapsOf().summary;
  EXPECT_EQ(before.dnRange.clipHighDn, 2000.0);
  EXPECT_EQ(after.dnRange.clipHighDn, before.dnRange.clipHighDn);
  EXPECT_EQ(after.clipped, before.clipped);
  EXPECT_EQ(after.dnRange.bitDepth, before.dnRange.bitDepth);
}

TEST(SensorNoiseStackMaps, FrameMeansAreOfFinitePixelsThatAreMeasured)
{
  std::vector<float> frame{ 10.0F, 20.0F, std::numeric_limits<float>::quiet_NaN(), 1000.0F };
  for (const bool isMasked : { false, true })
  {
    const std::vector<std::uint8_t> mask{ 1, 1, 1, static_cast<std::uint8_t>(isMasked ? 0 : 1) };
    StackMoments<float>             sums(frame.size(), 1);
    StackMoments<float>::AddFrames(
      { { &sums, PixelLayout::OfPixels(frame.size(), frame.size()), mask.data() } }, frame.data(), 0, 1, SerialFor);
    EXPECT_EQ(sums.GetFrameMeans()[0], isMasked ? 15.0 : 1030.0 / 3.0);
  }
}

// The steps are 1 DN to 512 DN, 8 DN to 2048 DN, and 32 DN above. 300 pixels are clipped at 3072 DN. Five noisy pixels
// lie three steps beyond: by the steps of the maxima alone, 32 DN, they are the end of the digital numbers.
TEST(SensorNoiseStackMaps, TheDepthOfCompandedDataIsTakenAtTheEndOfBothHistograms)
{
  TemporalMaps<std::uint16_t> maps;
  const auto                  add = [&](int low, int high, double mean, double sd) {
    constexpr std::int32_t centre = TemporalMaps<std::uint16_t>::Centre;
    maps.minimum.push_back(static_cast<std::int16_t>(low - centre));
    maps.maximum.push_back(static_cast<std::int16_t>(high - centre));
    maps.mean.push_back(mean);
    maps.variance.push_back(sd * sd);
  };
  constexpr int clip = 3072;
  for (int pixel = 0; pixel < 640; ++pixel)
  {
    const int dark = pixel % 80; // the lowest value: 40 numbers of either step
    add(dark < 40 ? 472 + dark : 512 + 8 * (dark - 40), 2048 + 32 * (pixel / 20), 2000.0, 20.0);
  }
  for (int pixel = 0; pixel < 300; ++pixel)
  {
    add(500, clip, clip - 10.0, 20.0);
  }
  for (int pixel = 0; pixel < 5; ++pixel)
  {
    add(500, clip + 96, clip - 4.0, 25.0);
  }
  std::vector<std::uint8_t> valid(maps.mean.size());
  const DnRange             range = SummariseStack(maps, {}, SerialFor, valid.data()).dnRange;
  ASSERT_TRUE(range.steps.IsCompanded());
  EXPECT_EQ(range.clipHighDn, clip);
}

TEST(SensorNoiseStackMaps, AValueThatMovesTheMeansOfNeighboursIsReplaced)
{
  const auto mapsOf = [](const Stack<float> & stack) {
    StackMoments<float> sums(Width * Height, Frames);
    sums.AddFrames(stack.Frame(0), 0, Frames, SerialFor);
    return MakeStackMaps<float>(sums.Take(), {}, SerialFor, {}, Width);
  };
  Stack<float> stack = StackBetween(std::nullopt, std::nullopt).Map<float>([](double value) { return 1.003 * value; });
  const StackMaps   expected = mapsOf(stack);
  const std::size_t p = 40 * Width + 57;
  for (const float spike : { 1e5F, -1e12F, 1e30F })
  {
    Stack<float> with = stack;
    with.pixels[5 * Width * Height + p] = spike;
    const StackMaps found = mapsOf(with);
    EXPECT_TRUE(std::isnan(found.variance[p])) << spike;
    EXPECT_NEAR(found.mean[p], expected.mean[p], 200.0) << spike;
    EXPECT_EQ(found.valid, expected.valid) << spike;
    EXPECT_EQ(found.mean[p + 1], expected.mean[p + 1]) << spike;
  }
  // A flash changes all pixels of a frame.
  for (std::size_t i = 0; i < Width * Height; ++i)
  {
    stack.pixels[5 * Width * Height + i] *= 1e4F;
  }
  const StackMaps flash = mapsOf(stack);
  EXPECT_EQ(std::count_if(flash.variance.begin(), flash.variance.end(), [](double v) { return std::isnan(v); }), 0);
}
