// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMaps.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::uint32_t Many = 100;

/** Returns digital numbers from \a lowest on in steps of \a step. */
std::vector<DnCount>
EvenNumbers(std::int32_t lowest, std::int32_t step, int count)
{
  std::vector<DnCount> numbers;
  for (int i = 0; i < count; ++i)
  {
    numbers.push_back({ lowest + i * step, Many });
  }
  return numbers;
}

std::vector<DnCount>
ScaledNumbers(double factor, int count)
{
  std::vector<DnCount> numbers;
  for (int i = 0; i < count; ++i)
  {
    numbers.push_back({ static_cast<std::int32_t>(std::floor(i * factor + 0.5)), Many });
  }
  return numbers;
}

/** Returns digital numbers on a square-root scale of \a bits, expanded to 12 bits. Their step is 2 sqrt(4095 v) /
 * (2^bits - 1) at level v.
 */
std::vector<DnCount>
RootNumbers(int bits)
{
  const double         top = std::exp2(bits) - 1.0;
  std::vector<DnCount> numbers;
  for (int k = 0; k <= static_cast<int>(top); ++k)
  {
    const auto number = static_cast<std::int32_t>(std::floor(4095.0 * k * k / (top * top) + 0.5));
    if (numbers.empty() || numbers.back().valueDn != number)
    {
      numbers.push_back({ number, Many });
    }
  }
  return numbers;
}

double
RootStep(int bits, double level)
{
  return 2.0 * std::sqrt(4095.0 * level) / (std::exp2(bits) - 1.0);
}
} // namespace

TEST(SensorNoiseQuantisationSteps, EvenAndRescaledNumbersHaveNoTable)
{
  EXPECT_FALSE(FindLocalSteps({}).IsCompanded());
  EXPECT_FALSE(FindLocalSteps(EvenNumbers(100, 1, 5)).IsCompanded());
  EXPECT_FALSE(FindLocalSteps(EvenNumbers(0, 1, 4096)).IsCompanded());
  EXPECT_FALSE(FindLocalSteps(EvenNumbers(0, 16, 4096)).IsCompanded());
  for (const double factor : { 1.01, 1.1, 1.25, 1.5, 1.9, 2.3, 65535.0 / 4095.0 })
  {
    EXPECT_FALSE(FindLocalSteps(ScaledNumbers(factor, 4000)).IsCompanded()) << factor;
  }
  EXPECT_EQ(QuantisationSteps().StepAt(10.0), 0.0);
  EXPECT_EQ(QuantisationSteps().VarianceAt(10.0), 0.0);
}

TEST(SensorNoiseQuantisationSteps, RootNumbersHaveTheStepOfTheirCurve)
{
  for (const int bits : { 8, 10 })
  {
    const QuantisationSteps steps = FindLocalSteps(RootNumbers(bits));
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

TEST(SensorNoiseQuantisationSteps, EndsReachToTheOutermostNumbers)
{
  std::vector<DnCount> numbers = RootNumbers(8);
  numbers.erase(numbers.begin(), numbers.begin() + 40); // the digital numbers from about 100 DN on remain
  const QuantisationSteps steps = FindLocalSteps(numbers);
  ASSERT_TRUE(steps.IsCompanded());
  EXPECT_NEAR(steps.StepAt(numbers.front().valueDn), RootStep(8, numbers.front().valueDn), 0.4);
  EXPECT_NEAR(steps.StepAt(4095.0), RootStep(8, 4095.0), 0.4);
  EXPECT_EQ(steps.StepAt(-50.0), steps.GetTable().front().stepDn);
}

TEST(SensorNoiseQuantisationSteps, KneesOfStraightPiecesAreFound)
{
  std::vector<DnCount>       numbers = EvenNumbers(0, 1, 512);
  const std::vector<DnCount> middle = EvenNumbers(512, 8, 192);
  const std::vector<DnCount> bright = EvenNumbers(2048, 32, 64);
  numbers.insert(numbers.end(), middle.begin(), middle.end());
  numbers.insert(numbers.end(), bright.begin(), bright.end());
  const QuantisationSteps steps = FindLocalSteps(numbers);
  ASSERT_TRUE(steps.IsCompanded());
  EXPECT_EQ(steps.StepAt(300.0), 1.0);
  EXPECT_EQ(steps.VarianceAt(300.0), 1.0 / 12.0);
  EXPECT_EQ(steps.StepAt(1300.0), 8.0);
  EXPECT_EQ(steps.VarianceAt(3000.0), 32.0 * 32.0 / 12.0);
}

TEST(SensorNoiseQuantisationSteps, NumbersMissingByChanceHaveNoEffect)
{
  // The bright end of a scene: every tenth digital number, attained by a few pixels.
  std::vector<DnCount> numbers = EvenNumbers(0, 1, 2000);
  for (std::int32_t number = 2000; number < 4000; number += 10)
  {
    numbers.push_back({ number, static_cast<std::uint32_t>(1 + number % 7) });
  }
  EXPECT_FALSE(FindLocalSteps(numbers).IsCompanded());
  // Single missing digital numbers among many, and gaps between the levels of a test chart.
  numbers.clear();
  for (std::int32_t number = 0; number < 4000; ++number)
  {
    if (number % 13 != 5 && number % 200 < 60)
    {
      numbers.push_back({ number, Many });
    }
  }
  EXPECT_FALSE(FindLocalSteps(numbers).IsCompanded());
}

TEST(SensorNoiseQuantisationSteps, StrayNumbersHaveNoEffect)
{
  std::vector<DnCount> numbers;
  for (const DnCount & number : RootNumbers(8))
  {
    numbers.push_back(number);
    if (number.valueDn > 500 && number.valueDn % 7 == 0)
    {
      numbers.push_back({ number.valueDn + 3, 1 });
    }
  }
  const QuantisationSteps steps = FindLocalSteps(numbers);
  ASSERT_TRUE(steps.IsCompanded());
  for (const double level : { 1000.0, 2000.0, 3500.0 })
  {
    EXPECT_NEAR(steps.StepAt(level), RootStep(8, level), 0.02 * RootStep(8, level)) << level;
  }
}

TEST(SensorNoiseQuantisationSteps, NumbersOfAStackEndAtTheirTopAndTheStepCanBeGiven)
{
  DnHistogram extremes;
  for (const DnCount & number : RootNumbers(8))
  {
    for (int i = 0; i < 10 && number.valueDn < 3000; ++i)
    {
      extremes.Add(number.valueDn);
    }
  }
  const DnRange found = FindDnRange(extremes, extremes, 400.0, {});
  ASSERT_TRUE(found.steps.IsCompanded());
  EXPECT_EQ(found.bitDepth, 12);
  EXPECT_EQ(found.clipHighDn,
            4095.0); // the outermost digital number has no close neighbours, and is no saturation level
  EXPECT_EQ(found.StepAt(2000.0), found.steps.StepAt(2000.0));
  EXPECT_EQ(found.quantisationStepDn, found.steps.GetTable().front().stepDn);
  DnSettings given;
  given.quantisationStepDn = 1.0;
  const DnRange even = FindDnRange(extremes, extremes, 400.0, given);
  EXPECT_FALSE(even.steps.IsCompanded());
  EXPECT_EQ(even.StepAt(2000.0), 1.0);
}
