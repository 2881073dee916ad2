// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/FixedPatternEstimate.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceFit.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Side = 192; // 24 cells of 8 pixels along either axis
constexpr std::size_t Pixels = Side * Side;
constexpr double      Dof = 50.0;

/** Returns the widening for variances on a line whose cells deviate by factors of a standard deviation of their own. */
double
WideningOf(double deviationOfCells)
{
  const FrameGeometry             geometry{ Side, Side, 1 };
  const ScoreCells                cells(geometry);
  std::mt19937                    random(7);
  std::normal_distribution<>      normal;
  std::chi_squared_distribution<> chiSquare(Dof);
  std::vector<double>             factors;
  for (std::size_t c = 0; c < cells.Count(); ++c)
  {
    factors.push_back(1.0 + deviationOfCells * normal(random));
  }
  std::vector<double>             mean;
  std::vector<double>             variance;
  const std::vector<float>        dof(Pixels, static_cast<float>(Dof));
  const std::vector<std::uint8_t> mask(Pixels, 1);
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    mean.push_back(100.0 + 40.0 * static_cast<double>(cells.Of(p) * 7 % 24));
    variance.push_back((10.0 + 0.1 * mean[p]) * factors[cells.Of(p)] * chiSquare(random) / Dof);
  }
  const std::vector<float> neighbourMean(mean.begin(), mean.end());
  const VarianceData data{ mean.data(), neighbourMean.data(), { variance.data() }, dof.data(), mask.data(), Pixels };
  VarianceFit        fit(data, SerialFor, std::nullopt);
  fit.Iterate(8);
  return WideningByCells(fit, data, geometry);
}
} // namespace

TEST(SensorNoiseScoreCells, CoverTheFrame)
{
  for (const FrameGeometry & geometry :
       { FrameGeometry{ 5, 3, 1 }, FrameGeometry{ 193, 70, 1 }, FrameGeometry{ 9, 4000, 1 } })
  {
    const ScoreCells cells(geometry);
    EXPECT_LE(cells.Count(), 24u * 24u);
    for (std::size_t p = 0; p < geometry.Pixels(); ++p)
    {
      ASSERT_LT(cells.Of(p), cells.Count());
    }
  }
}

TEST(SensorNoiseScoreCells, IndependentPixelsWidenNothing)
{
  EXPECT_EQ(WideningOf(0.0), 1.0);
}

TEST(SensorNoiseScoreCells, CommonDeviationsWiden)
{
  // The relative variance of a pixel is 2 / dof + s^2, and of the mean of its cell of 64 pixels 2 / dof / 64 + s^2.
  constexpr double s = 0.1;
  const double     expected = (2.0 / Dof + 64.0 * s * s) / (2.0 / Dof + s * s);
  EXPECT_NEAR(WideningOf(s) / expected, 1.0, 5.0 * std::sqrt(2.0 / 576.0)); // a variance of 576 cells
}

TEST(SensorNoiseScoreCells, AnExcessIsAsLargeAsItsScatter)
{
  EXPECT_EQ(WideningOfExcess({ 1.0, -1.0, 1.0, 1.0 }, 4.0), 1.0);
  // Four cells that are alike: 5 times the variance of independent pixels. Chance explains 1 of these 5.
  EXPECT_DOUBLE_EQ(WideningOfExcess({ 2.0, 2.0, 2.0, 2.0, 0.0 }, 3.2), 1.0 + 4.0 * 4.0);
  EXPECT_DOUBLE_EQ(WideningOfExcess({ 4.0, 0.0, 0.0 }, 3.2), 1.0 + 4.0); // one of them
}
