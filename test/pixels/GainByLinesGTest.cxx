// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/GainByLines.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

// Columns and rows with gains of their own, in maps of known variance.

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 240;
constexpr std::size_t Height = 200;
constexpr double      Dof = 30.0;

/** Maps whose pixels have the gain 1 DN/e- times 1 + \a excess of the place, and 10 DN^2 of read noise. */
struct Maps
{
  std::vector<double>       mean;
  std::vector<double>       variance;
  std::vector<float>        dof = std::vector<float>(Width * Height, static_cast<float>(Dof));
  std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(Width * Height, 1);

  explicit Maps(const std::function<double(std::size_t, std::size_t)> & excess)
  {
    std::mt19937              random(3);
    std::gamma_distribution<> chi2(0.5 * Dof, 2.0 / Dof);
    for (std::size_t p = 0; p < Width * Height; ++p)
    {
      mean.push_back(50.0 + static_cast<double>(37 * p % 401));
      variance.push_back((10.0 + mean[p] * (1.0 + excess(p % Width, p / Width))) * chi2(random));
    }
  }
  LinesOfSensor
  Compared() const
  {
    VarianceData data;
    data.mean = mean.data();
    data.variance.map = variance.data();
    data.dof = dof.data();
    data.mask = mask.data();
    data.pixels = mean.size();
    PartReference reference;
    reference.line.gain = 1.0;
    reference.line.intercept = 10.0;
    reference.line.isDetermined = true;
    return CompareLines(data, { Width, Height, 1 }, reference, SerialFor);
  }
};
} // namespace

TEST(SensorNoiseGainByLines, UniformSensorsAndSlowChangesHaveNone)
{
  for (const double slope : { 0.0, 0.0004 })
  {
    const LinesOfSensor found =
      Maps([&](std::size_t x, std::size_t y) { return slope * static_cast<double>(x + y); }).Compared();
    EXPECT_FALSE(found.columns.Differ()) << found.columns.size << ' ' << found.columns.z;
    EXPECT_FALSE(found.rows.Differ()) << found.rows.size << ' ' << found.rows.z;
  }
}

TEST(SensorNoiseGainByLines, PeriodAndGainsOfColumnsAreFound)
{
  const std::vector<double> gains{ -0.05, 0.01, 0.04 };
  const LinesOfSensor       found = Maps([&](std::size_t x, std::size_t) { return gains[x % 3]; }).Compared();
  EXPECT_TRUE(found.columns.Differ());
  EXPECT_FALSE(found.rows.Differ());
  EXPECT_NEAR(found.columns.size, std::sqrt(0.0042 / 3.0), 0.003);
  ASSERT_EQ(found.columns.excess.size(), gains.size());
  for (std::size_t k = 0; k < gains.size(); ++k)
  {
    EXPECT_NEAR(found.columns.excess[k], gains[k], 4.5 * found.columns.error);
  }
  EXPECT_LT(found.columns.error, 0.004); // 16,000 pixels of 30 degrees of freedom
}

TEST(SensorNoiseGainByLines, RowsWithGainsAtRandomHaveASizeAndNoPeriod)
{
  std::mt19937               random(8);
  std::normal_distribution<> normal(0.0, 0.03);
  std::vector<double>        gains(Height);
  double                     square = 0.0;
  for (double & gain : gains)
  {
    gain = normal(random);
    square += gain * gain / static_cast<double>(Height);
  }
  const LinesOfSensor found = Maps([&](std::size_t, std::size_t y) { return gains[y]; }).Compared();
  EXPECT_FALSE(found.columns.Differ());
  EXPECT_TRUE(found.rows.Differ());
  EXPECT_NEAR(found.rows.size, std::sqrt(square), 0.2 * std::sqrt(square)); // less the mean of the rows around
  EXPECT_TRUE(found.rows.excess.empty());
}
