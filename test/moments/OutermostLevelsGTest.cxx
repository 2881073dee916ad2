// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMaps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
using End = OutermostLevels::End;

OutermostLevels
LevelsOf(const std::vector<double> & values, End end)
{
  OutermostLevels levels(end);
  for (const double value : values)
  {
    levels.Add(value);
  }
  return levels;
}

std::vector<double>
RoundedNormal(std::size_t count, double sd, double scale = 1.0)
{
  std::mt19937_64            random(5);
  std::normal_distribution<> normal(900.0, sd);
  std::vector<double>        values(count);
  std::generate(values.begin(), values.end(), [&] { return scale * std::floor(normal(random)); });
  return values;
}
} // namespace

TEST(SensorNoiseOutermostLevels, StuckPixelsBeyondAClipLevelAreLeftOut)
{
  std::vector<double> values = RoundedNormal(20000, 20.0, 0.25);
  const double        top = 0.25 * 960.0;
  for (double & value : values)
  {
    value = std::min(value, top - 0.25);
  }
  values.insert(values.end(), 200, top);
  values.insert(values.end(), { 0.25 * 4095.0, 0.25 * 3000.0 });
  OutermostLevels levels = LevelsOf(values, End::High);
  EXPECT_EQ(levels.Level(), 0.25 * 4095.0);
  levels.LeaveOutStray(0.25);
  EXPECT_EQ(levels.Level(), top);
  EXPECT_EQ(levels.Pixels(), 200U);
}

TEST(SensorNoiseOutermostLevels, AreThoseOfAWholeHistogramInAnyOrder)
{
  std::vector<double>           values = RoundedNormal(20000, 150.0); // about 1,000 levels; the table has room for 64
  std::map<double, std::size_t> counts;
  for (const double value : values)
  {
    ++counts[value];
  }
  const auto mostWithin = [&](double low, double high) {
    std::size_t most = 0;
    for (auto level = counts.lower_bound(low); level != counts.end() && level->first <= high; ++level)
    {
      most = std::max(most, level->second);
    }
    return most;
  };
  const double                                 lowest = counts.begin()->first;
  const double                                 highest = counts.rbegin()->first;
  std::vector<void (*)(std::vector<double> &)> orders;
  orders.push_back([](std::vector<double> &) {});
  orders.push_back([](std::vector<double> & list) { std::sort(list.begin(), list.end()); });
  orders.push_back([](std::vector<double> & list) { std::reverse(list.begin(), list.end()); });
  for (const auto order : orders)
  {
    order(values);
    const OutermostLevels low = LevelsOf(values, End::Low);
    const OutermostLevels high = LevelsOf(values, End::High);
    EXPECT_EQ(low.Level(), lowest);
    EXPECT_EQ(high.Level(), highest);
    EXPECT_EQ(low.Pixels(), counts.at(lowest));
    EXPECT_EQ(high.Pixels(), counts.at(highest));
    EXPECT_EQ(low.Step(), 1.0);
    EXPECT_EQ(high.Step(), 1.0);
    EXPECT_EQ(low.MostInside(2.0), mostWithin(lowest + 0.5, lowest + 33.0));
    EXPECT_EQ(high.MostInside(2.0), mostWithin(highest - 33.0, highest - 0.5));
  }
}

TEST(SensorNoiseOutermostLevels, StepIsTheDistanceOfGreyValuesWithGapsStraysAndAnyScale)
{
  for (const double scale : { 1.0, 16.0, 1.0 / 65535.0, 0.37 })
  {
    std::vector<double> values = RoundedNormal(3000, 300.0, scale); // most digital numbers are not attained at the ends
    values.push_back(LevelsOf(values, End::High).Level() - 0.4 * scale); // a stray value
    EXPECT_NEAR(LevelsOf(values, End::High).Step(), scale, 1e-9 * scale) << scale;
    EXPECT_NEAR(LevelsOf(values, End::Low).Step(), scale, 1e-9 * scale) << scale;
  }
}

TEST(SensorNoiseOutermostLevels, NothingAndOneLevelHaveNoStep)
{
  OutermostLevels levels(End::High);
  EXPECT_EQ(levels.Pixels(), 0u);
  EXPECT_EQ(levels.Step(), 0.0);
  EXPECT_EQ(levels.MostInside(1.0), 0u);
  levels.Add(7.5);
  levels.Add(7.5);
  EXPECT_EQ(levels.Pixels(), 2u);
  EXPECT_EQ(levels.Step(), 0.0);
  EXPECT_EQ(levels.MostInside(1.0), 0u);
}

TEST(SensorNoiseOutermostLevels, ZeroHasNoSign)
{
  for (const End end : { End::Low, End::High })
  {
    EXPECT_FALSE(std::signbit(LevelsOf({ -0.0, 0.0 }, end).Level()));
    EXPECT_FALSE(std::signbit(LevelsOf({ 0.0 }, end).Level()));
    EXPECT_EQ(LevelsOf({ -0.0, 0.0 }, end).Pixels(), 2u);
  }
}
