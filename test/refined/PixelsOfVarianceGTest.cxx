// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "refined/RefinedResults.h"
#include "sensornoise/StackMethod.h"
#include "helpers/SensorTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::sensor;

namespace
{
constexpr std::size_t Width = 16;
constexpr std::size_t Height = 9;

/** Returns the pixel uses after LeaveOutEdges() of a frame whose level is a function of x. All pixels were chosen, and
 * the variance is 1 DN times the level. */
template <typename TLevel>
std::vector<std::uint8_t>
UsesOf(const TLevel & level)
{
  ReferenceFrame frame;
  frame.geometry = { Width, Height };
  for (std::size_t p = 0; p < Width * Height; ++p)
  {
    frame.mean.push_back(level(p % Width));
  }
  VarianceLine line;
  line.gain = 1.0;
  std::vector<std::uint8_t> chosen(frame.mean.size(), 1);
  std::vector<std::uint8_t> uses(frame.mean.size(), 0);
  LeaveOutEdges(frame, line, chosen, uses);
  for (std::size_t p = 0; p < uses.size(); ++p)
  {
    EXPECT_EQ(chosen[p] == 0, uses[p] == static_cast<std::uint8_t>(PixelUse::Edge)) << p;
  }
  return uses;
}
} // namespace

TEST(SensorNoisePixelsOfVariance, PixelsBesideAStepAreEdges)
{
  // Two columns of the 5 x 5 pixels around x = 7 have the other level, 40 % of them: a step of 10.1 % gives just above
  // 4 %.
  const auto uses = UsesOf([](std::size_t x) { return x < 8 ? 1000.0 : 1101.0; });
  for (std::size_t p = 0; p < uses.size(); ++p)
  {
    const std::size_t x = p % Width;
    const std::size_t y = p / Width;
    // from the brighter side the step is 9.2 %
    EXPECT_EQ(uses[p] != 0, x == 7 && y >= 2 && y + 2 < Height) << x << ' ' << y;
  }
}

TEST(SensorNoisePixelsOfVariance, ARampHasNoEdges)
{
  const auto uses = UsesOf([](std::size_t x) { return 100.0 + 50.0 * static_cast<double>(x); });
  EXPECT_TRUE(std::all_of(uses.begin(), uses.end(), [](std::uint8_t use) { return use == 0; }));
}

TEST(SensorNoisePixelsOfVariance, SmoothedEdgesAreNoNonlinearity)
{
  SimulationSettings settings = StaticCamera(50);
  const auto         edgesOf = [&settings] {
    const auto stack = Simulate<GreyValue>(settings, 256, 256);
    const auto method = Measure(stack, {});
    EXPECT_FALSE(HasWarning(method.GetReport(), WarningCode::ResponseNotStraight));
    ExpectHolds(method.GetReport().gain, 1.0);
    ExpectHolds(method.GetReport().readNoise, 8.0);
    const auto & uses = method.GetPixelUse();
    return std::count(uses.begin(), uses.end(), static_cast<std::uint8_t>(PixelUse::Edge));
  };
  EXPECT_EQ(edgesOf(), 0);
  settings.flaws.smoothing.sdPixels = 1.0;
  // 4 x 4 uniform fields: their outlines are 6 lines of 256 pixels, each with at least two columns of edges
  EXPECT_GT(edgesOf(), 6 * 2 * 200);
}

TEST(SensorNoisePixelsOfVariance, MeansOfNeighboursAreLeftOut)
{
  // Every 33rd pixel of the frame is replaced, as by a camera that corrects defective pixels.
  constexpr std::size_t size = 256;
  auto                  stack = Simulate<GreyValue>(StaticCamera(50), size, size);
  const auto            outliersOf = [&stack](Quantity & gain) {
    const auto method = Measure(stack, {});
    gain = method.GetReport().gain;
    const auto & uses = method.GetPixelUse();
    return std::count(uses.begin(), uses.end(), static_cast<std::uint8_t>(PixelUse::Outlier));
  };
  Quantity gain;
  EXPECT_LT(outliersOf(gain), 30); // dark pixels beside bright edges are none
  std::ptrdiff_t replaced = 0;
  for (std::size_t p = size + 1; p + size + 1 < size * size; p += 33)
  {
    ++replaced;
    for (std::size_t t = 0; t < 50; ++t)
    {
      GreyValue * const pixel = stack.pixels.data() + t * size * size + p;
      const auto        sum = [pixel](std::ptrdiff_t row) { return pixel[row - 1] + pixel[row] + pixel[row + 1]; };
      constexpr auto    below = static_cast<std::ptrdiff_t>(size);
      *pixel = static_cast<GreyValue>((sum(-below) + pixel[-1] + pixel[1] + sum(below) + 4) / 8);
    }
  }
  EXPECT_GT(outliersOf(gain), replaced * 8 / 10);
  ExpectHolds(gain, 1.0);
}
