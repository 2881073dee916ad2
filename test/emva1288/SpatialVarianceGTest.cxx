// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EvaluationSteps.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Columns = 12;
constexpr std::size_t Rows = 8;

/** Returns a value of alternating sign: its mean over an even number is 0 and its mean square is 1. */
double
Alternating(std::size_t i)
{
  return i % 2 == 0 ? 1.0 : -1.0;
}

/** Returns an image with patterns of columns, rows and pixels of these standard deviations. */
std::vector<double>
MakePattern(double column, double row, double pixel)
{
  std::vector<double> image;
  for (std::size_t y = 0; y < Rows; ++y)
  {
    for (std::size_t x = 0; x < Columns; ++x)
    {
      image.push_back(50.0 + column * Alternating(x) + row * Alternating(y) + pixel * Alternating(x + y));
    }
  }
  return image;
}
} // namespace

TEST(SensorNoiseEmvaSpatialVariance, SeparatesPatternsOfColumnsRowsAndPixels)
{
  // The pattern of pixels has no sums of columns or rows, so that (42) takes 1 / rows of it for none of both.
  const EmvaSpatialVariance found = MeasureSpatialVariance(MakePattern(3.0, 2.0, 5.0), Columns, Rows, 0.0, 4);
  const double              factor = 1.0 - 1.0 / Rows - 1.0 / Columns;
  EXPECT_NEAR(found.measuredDn2, 9.0 + 4.0 + 25.0, 1e-12);
  EXPECT_NEAR(found.columnMeanDn2, 9.0, 1e-12);
  EXPECT_NEAR(found.rowMeanDn2, 4.0, 1e-12);
  EXPECT_NEAR(found.pixelDn2, 25.0 / factor, 1e-12);
  EXPECT_NEAR(found.columnDn2, 9.0 - 25.0 / factor / Rows, 1e-12);
  EXPECT_NEAR(found.rowDn2, 4.0 - 25.0 / factor / Columns, 1e-12);
}

TEST(SensorNoiseEmvaSpatialVariance, ThePartsSolveTheEquationsOfTheStandard)
{
  std::vector<double> image;
  for (std::size_t p = 0; p < Columns * Rows; ++p)
  {
    image.push_back(std::sin(static_cast<double>(p * p)));
  }
  const EmvaSpatialVariance found = MeasureSpatialVariance(image, Columns, Rows, 0.3, 10);
  EXPECT_NEAR(found.columnDn2 + found.rowDn2 + found.pixelDn2, found.totalDn2, 1e-14);
  EXPECT_NEAR(found.columnDn2 + found.pixelDn2 / Rows, found.columnMeanDn2, 1e-14);
  EXPECT_NEAR(found.rowDn2 + found.pixelDn2 / Columns, found.rowMeanDn2, 1e-14);
  EXPECT_NEAR(found.totalDn2, found.measuredDn2 - 0.03, 1e-14);
}

TEST(SensorNoiseEmvaSpatialVariance, SubtractsTheTemporalNoiseOfTheMean)
{
  const EmvaSpatialVariance with = MeasureSpatialVariance(MakePattern(3.0, 2.0, 5.0), Columns, Rows, 2.0, 5);
  const EmvaSpatialVariance without = MeasureSpatialVariance(MakePattern(3.0, 2.0, 5.0), Columns, Rows, 0.0, 5);
  EXPECT_NEAR(without.columnMeanDn2 - with.columnMeanDn2, 0.4 / Rows, 1e-13);
  EXPECT_NEAR(without.rowMeanDn2 - with.rowMeanDn2, 0.4 / Columns, 1e-13);
  EXPECT_NEAR(without.pixelDn2 - with.pixelDn2, 0.4, 1e-13);
  EXPECT_NEAR(without.columnDn2, with.columnDn2, 1e-13); // white noise has no part of columns
}
