// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/StaticVariance.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "pixels/ProjectedVariance.h"
#include "helpers/ProjectionTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::projection;

namespace
{
constexpr double Intercept = 100.0;
constexpr double Gain = 0.3;
constexpr double OffsetDn = 100.0;

constexpr std::uint8_t Unknown = 99;

/** Returns noise whose variance is a line in the mean. The noise of every 97th pixel is ten times as large. */
Eigen::MatrixXd
Series()
{
  const std::vector<double> mean = WavyScene(Width, Height);
  Eigen::MatrixXd           series = NormalSeries() / 20.0;
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    series.col(static_cast<Eigen::Index>(p)) *= (p % 97 == 0 ? 10.0 : 1.0) * std::sqrt(Intercept + Gain * mean[p]);
  }
  return series;
}

StaticVariance
Find(const ProjectedSquares & projected, const std::vector<std::uint8_t> & usable)
{
  return FitStaticVariance(
    projected, usable, std::vector<std::uint8_t>(Pixels, Unknown), Gain, OffsetDn, OffsetDn, SerialFor);
}
} // namespace

TEST(SensorNoiseStaticVariance, LineIsFoundAndNoisyPixelsAreTrimmed)
{
  Input                  input(Series());
  const ProjectedSquares projected = input.Project();
  const auto             found = Find(projected, input.mask);
  ASSERT_TRUE(found.line.isDetermined);
  EXPECT_NEAR(found.line.gain, Gain, 4.0 * std::sqrt(found.line.covariance(0, 0)));
  EXPECT_NEAR(found.line.intercept, Intercept, 4.0 * std::sqrt(found.line.covariance(1, 1)));
  std::size_t used = 0;
  std::size_t trimmed = 0;
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    const bool isOutlier = found.pixelUse[p] == static_cast<std::uint8_t>(PixelUse::Outlier);
    const bool isUsed = found.pixelUse[p] == static_cast<std::uint8_t>(PixelUse::Used);
    ASSERT_EQ(found.mask[p] != 0, isUsed || isOutlier) << p;
    ASSERT_EQ(input.mask[p] == 0, found.pixelUse[p] == Unknown) << p;
    EXPECT_TRUE(p % 97 != 0 || isOutlier == (found.mask[p] != 0)) << p;
    used += found.mask[p];
    trimmed += isOutlier ? 1 : 0;
  }
  EXPECT_EQ(found.line.trimmedFraction, static_cast<double>(trimmed) / static_cast<double>(used));
  EXPECT_LT(found.line.trimmedFraction, 0.02);
}

TEST(SensorNoiseStaticVariance, TooFewPixelsDetermineNoLine)
{
  Input                     input(Series());
  const ProjectedSquares    projected = input.Project();
  std::vector<std::uint8_t> few(Pixels, 0);
  for (std::size_t x = 30; x < 38; ++x)
  {
    few[30 * Width + x] = 1;
  }
  const auto found = Find(projected, few);
  EXPECT_FALSE(found.line.isDetermined);
  EXPECT_EQ(found.pixelUse, std::vector<std::uint8_t>(Pixels, Unknown)); // no pixel was classified
}
