// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/RegressorBand.h"
#include "sensornoise/Parallel.h"
#include "base/Stencils.h"
#include "series/Constants.h"
#include "series/FrameRegressors.h"
#include "series/FrameSums.h"
#include "helpers/FrameTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 72;
constexpr std::size_t Height = 45;
constexpr std::size_t Cells = 3;

const FrameSums &
Sums()
{
  static const SyntheticFrames frames(Width, Height, FlickerAndMotion(8, 100.0, 0.1), 1.0);
  static const FrameSums       sums = frames.EmptySums();
  return sums;
}

/** Returns the regressors of pixel \a p, times their weights. */
FrameRegressors::WeightedColumns
ColumnsAt(const FrameRegressors & regressors, std::size_t p)
{
  const ReferenceFrame &           frame = regressors.GetFrame();
  const InitialNoiseModel &        model = regressors.GetModel();
  const ShiftInstruments &         instruments = regressors.GetInstruments();
  const auto                       derivatives = ApplyStencils(frame.mean.data(), Width, p);
  const double                     noise = model.NoiseVariance(frame.neighbourMean[p]);
  const double                     motion = model.MotionVariance(derivatives[StencilX], derivatives[StencilY]);
  const double                     ofCell = 1.0 / (noise + InSeries.motionLeftInCells * motion);
  const double                     level = frame.mean[p] - model.centreDn;
  FrameRegressors::WeightedColumns columns{ 1.0 / noise, 1.0 / noise * level };
  for (std::size_t k = 0; k < derivatives.size(); ++k)
  {
    columns[2 + k] = 1.0 / noise * derivatives[k];
  }
  columns[FrameColumns] = double{ instruments.x[p] } * instruments.weight[p];
  columns[FrameColumns + 1] = double{ instruments.y[p] } * instruments.weight[p];
  columns[FrameColumns + 2] = ofCell;
  columns[FrameColumns + 3] = ofCell * level;
  return columns;
}

double
SeriesAt(std::size_t k, std::size_t p)
{
  return std::sin(0.37 * static_cast<double>(p) + static_cast<double>(k)) * 100.0;
}
} // namespace

// GroupProductsGTest compares the bits.
TEST(SensorNoiseRegressorBand, ProductsAreTheSumsOneAfterTheOther)
{
  const FrameRegressors & regressors = Sums().GetRegressors();
  RegressorBand           band(regressors, Cells);
  for (const std::size_t firstRow : { 7U, 20U, 0U }) // a band that moves keeps nothing of its old place
  {
    band.MoveTo(firstRow, firstRow == 20 ? 5 : 3);
    for (std::size_t k = 0; k < RegressorBand::Together; ++k)
    {
      for (std::size_t i = 0; i < band.Pixels(); ++i)
      {
        band.Series(k)[i] = static_cast<float>(SeriesAt(k, band.First() + i) / band.UnitDn());
      }
    }
    const std::vector<RegressorBand::Sums> & sums = band.Multiply([](std::size_t) {});
    ASSERT_EQ(sums.size(), band.GetGroups().size());
    ASSERT_GT(sums.size(), Cells);
    for (std::size_t g = 0; g < sums.size(); ++g)
    {
      const RegressorBand::Group & group = band.GetGroups()[g];
      RegressorBand::Sums          expected{};
      RegressorBand::Sums          largest{}; // sums of the absolute products
      for (std::size_t place = group.begin; place < group.end; ++place)
      {
        const std::size_t p = band.First() + band.GetOrder()[place];
        EXPECT_EQ(regressors.ClassOf(p), group.gradientClass);
        EXPECT_EQ(p % Width * Cells / Width, group.cell);
        const auto columns = ColumnsAt(regressors, p);
        for (std::size_t k = 0; k < RegressorBand::Together; ++k)
        {
          for (std::size_t c = 0; c < columns.size(); ++c)
          {
            expected[k][c] += columns[c] * SeriesAt(k, p);
            largest[k][c] += std::abs(columns[c] * SeriesAt(k, p));
          }
        }
      }
      for (std::size_t k = 0; k < RegressorBand::Together; ++k)
      {
        for (std::size_t c = 0; c < expected[k].size(); ++c)
        {
          EXPECT_NEAR(sums[g][k][c], expected[k][c], RoundingOfSums * largest[k][c]) << g;
        }
      }
    }
  }
}
