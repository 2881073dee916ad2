// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/Codes.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::uint32_t Many = 100;

/** Returns codes from \a lowest on in steps of \a step. */
std::vector<SeenCode>
EvenCodes(std::int32_t lowest, std::int32_t step, int count)
{
  std::vector<SeenCode> codes;
  for (int i = 0; i < count; ++i)
  {
    codes.push_back({ lowest + i * step, Many });
  }
  return codes;
}

std::vector<SeenCode>
ScaledCodes(double factor, int count)
{
  std::vector<SeenCode> codes;
  for (int i = 0; i < count; ++i)
  {
    codes.push_back({ static_cast<std::int32_t>(std::floor(i * factor + 0.5)), Many });
  }
  return codes;
}

/** Returns square-root codes of \a bits, expanded to 12 bits. Their step is 2 sqrt(4095 v) / (2^bits - 1) at level v.
 */
std::vector<SeenCode>
RootCodes(int bits)
{
  const double          top = std::exp2(bits) - 1.0;
  std::vector<SeenCode> codes;
  for (int k = 0; k <= static_cast<int>(top); ++k)
  {
    const auto code = static_cast<std::int32_t>(std::floor(4095.0 * k * k / (top * top) + 0.5));
    if (codes.empty() || codes.back().code != code)
    {
      codes.push_back({ code, Many });
    }
  }
  return codes;
}

double
RootStep(int bits, double level)
{
  return 2.0 * std::sqrt(4095.0 * level) / (std::exp2(bits) - 1.0);
}
} // namespace

TEST(SensorNoiseCodeSteps, EvenAndRescaledCodesHaveNoTable)
{
  EXPECT_FALSE(FindCodeSteps({}).IsCompanded());
  EXPECT_FALSE(FindCodeSteps(EvenCodes(100, 1, 5)).IsCompanded());
  EXPECT_FALSE(FindCodeSteps(EvenCodes(0, 1, 4096)).IsCompanded());
  EXPECT_FALSE(FindCodeSteps(EvenCodes(0, 16, 4096)).IsCompanded());
  for (const double factor : { 1.01, 1.1, 1.25, 1.5, 1.9, 2.3, 65535.0 / 4095.0 })
  {
    EXPECT_FALSE(FindCodeSteps(ScaledCodes(factor, 4000)).IsCompanded()) << factor;
  }
  EXPECT_EQ(CodeSteps().StepAt(10.0), 0.0);
  EXPECT_EQ(CodeSteps().VarianceAt(10.0), 0.0);
}

TEST(SensorNoiseCodeSteps, RootCodesHaveTheStepOfTheirCurve)
{
  for (const int bits : { 8, 10 })
  {
    const CodeSteps steps = FindCodeSteps(RootCodes(bits));
    ASSERT_TRUE(steps.IsCompanded());
    for (double level = 300.0; level < 4095.0; level += 50.0)
    {
      // The error of the sum of 12 distances is at most 1 DN.
      const double expected = RootStep(bits, level);
      EXPECT_NEAR(steps.StepAt(level), expected, 1.0 / 12.0 + 0.01 * expected) << bits << ' ' << level;
      const double variance = (expected * expected + 1.0) / 12.0;
      EXPECT_NEAR(steps.VarianceAt(level), variance, 2.0 * expected / 144.0 + 0.03 * variance) << bits << ' ' << level;
    }
  }
}

TEST(SensorNoiseCodeSteps, EndsReachToTheOutermostCodes)
{
  std::vector<SeenCode> codes = RootCodes(8);
  codes.erase(codes.begin(), codes.begin() + 40); // the codes from about 100 DN on remain
  const CodeSteps steps = FindCodeSteps(codes);
  ASSERT_TRUE(steps.IsCompanded());
  EXPECT_NEAR(steps.StepAt(codes.front().code), RootStep(8, codes.front().code), 0.4);
  EXPECT_NEAR(steps.StepAt(4095.0), RootStep(8, 4095.0), 0.4);
  EXPECT_EQ(steps.StepAt(-50.0), steps.GetTable().front().stepDn);
}

TEST(SensorNoiseCodeSteps, KneesOfStraightPiecesAreFound)
{
  std::vector<SeenCode>       codes = EvenCodes(0, 1, 512);
  const std::vector<SeenCode> middle = EvenCodes(512, 8, 192);
  const std::vector<SeenCode> bright = EvenCodes(2048, 32, 64);
  codes.insert(codes.end(), middle.begin(), middle.end());
  codes.insert(codes.end(), bright.begin(), bright.end());
  const CodeSteps steps = FindCodeSteps(codes);
  ASSERT_TRUE(steps.IsCompanded());
  EXPECT_EQ(steps.StepAt(300.0), 1.0);
  EXPECT_EQ(steps.VarianceAt(300.0), 1.0 / 12.0);
  EXPECT_EQ(steps.StepAt(1300.0), 8.0);
  EXPECT_EQ(steps.VarianceAt(3000.0), 32.0 * 32.0 / 12.0);
}

TEST(SensorNoiseCodeSteps, CodesMissingByChanceHaveNoEffect)
{
  // The bright end of a scene: every tenth code, attained by a few pixels.
  std::vector<SeenCode> codes = EvenCodes(0, 1, 2000);
  for (std::int32_t code = 2000; code < 4000; code += 10)
  {
    codes.push_back({ code, static_cast<std::uint32_t>(1 + code % 7) });
  }
  EXPECT_FALSE(FindCodeSteps(codes).IsCompanded());
  // Single missing codes among many, and gaps between the levels of a test chart.
  codes.clear();
  for (std::int32_t code = 0; code < 4000; ++code)
  {
    if (code % 13 != 5 && code % 200 < 60)
    {
      codes.push_back({ code, Many });
    }
  }
  EXPECT_FALSE(FindCodeSteps(codes).IsCompanded());
}

TEST(SensorNoiseCodeSteps, StrayCodesHaveNoEffect)
{
  std::vector<SeenCode> codes;
  for (const SeenCode & code : RootCodes(8))
  {
    codes.push_back(code);
    if (code.code > 500 && code.code % 7 == 0)
    {
      codes.push_back({ code.code + 3, 1 });
    }
  }
  const CodeSteps steps = FindCodeSteps(codes);
  ASSERT_TRUE(steps.IsCompanded());
  for (const double level : { 1000.0, 2000.0, 3500.0 })
  {
    EXPECT_NEAR(steps.StepAt(level), RootStep(8, level), 0.02 * RootStep(8, level)) << level;
  }
}

TEST(SensorNoiseCodeSteps, CodesOfAStackEndAtTheirTopAndTheStepCanBeGiven)
{
  CodeHistogram extremes;
  for (const SeenCode & code : RootCodes(8))
  {
    for (int i = 0; i < 10 && code.code < 3000; ++i)
    {
      extremes.Add(code.code);
    }
  }
  const CodeRange found = FindCodes(extremes, extremes, 400.0, {});
  ASSERT_TRUE(found.steps.IsCompanded());
  EXPECT_EQ(found.bitDepth, 12);
  EXPECT_EQ(found.clipHighDn, 4095.0); // the outermost code has no close neighbours, and is no pile-up
  EXPECT_EQ(found.StepAt(2000.0), found.steps.StepAt(2000.0));
  EXPECT_EQ(found.quantisationStepDn, found.steps.GetTable().front().stepDn);
  CodeSettings given;
  given.quantisationStepDn = 1.0;
  const CodeRange even = FindCodes(extremes, extremes, 400.0, given);
  EXPECT_FALSE(even.steps.IsCompanded());
  EXPECT_EQ(even.StepAt(2000.0), 1.0);
}
