// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/UsablePixels.h"
#include "base/ChiSquare.h"
#include "scene/InitialNoiseModel.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Width = 64; // 8 x 4 tiles of 8 x 8 pixels
constexpr std::size_t Height = 32;
constexpr std::size_t Frames = 50;

/** All pixels of a frame with levels from 0 to 100 DN, and with a predicted variance of 10 DN^2, which the median pixel
 * has. */
struct Cells
{
  std::vector<std::size_t> pixels = std::vector<std::size_t>(Width * Height);
  VarianceSample           sample;
  VariancePrediction       prediction;
  double                   median = ChiSquareQuantile(0.5, Frames - 1.0) / (Frames - 1.0);

  Cells()
  {
    std::iota(pixels.begin(), pixels.end(), std::size_t{ 0 });
    sample.design = decltype(sample.design)::Zero(static_cast<Eigen::Index>(pixels.size()), VarianceSample::Terms);
    sample.scale = 100.0;
    for (const std::size_t p : pixels)
    {
      sample.design(static_cast<Eigen::Index>(p), 1) = 0.01 * static_cast<double>(p % 101);
    }
    sample.raw.assign(pixels.size(), 10.0 * median);
    prediction.variance.assign(pixels.size(), 10.0);
    prediction.keep.assign(pixels.size(), 1);
  }
  VarianceTiles
  Make() const
  {
    return VarianceTiles(sample, pixels, { Width, Height, 1 }, Frames);
  }
  /** Calls function(pixel) for the pixels of a tile. */
  template <typename TFunction>
  void
  ForCell(std::size_t column, std::size_t row, TFunction function)
  {
    for (std::size_t p = 0; p < pixels.size(); ++p)
    {
      if (p % Width / 8 == column && p / Width / 8 == row)
      {
        function(p);
      }
    }
  }
};
} // namespace

TEST(SensorNoiseVarianceTiles, AreTestedByTheirMedianAndByCrowdsFarAbove)
{
  Cells input;
  input.ForCell(1, 0, [&](std::size_t p) { input.sample.raw[p] *= 1.5; });
  input.ForCell(2, 0, [&](std::size_t p) { input.sample.raw[p] /= 1.5; });
  input.ForCell(3, 0, [&](std::size_t p) { input.sample.raw[p] *= 1.3; });
  input.ForCell(4, 1, [&](std::size_t p) { input.prediction.keep[p] = p % 8 < 2 ? 0 : 1; }); // a quarter
  input.ForCell(5, 1, [&](std::size_t p) { input.prediction.keep[p] = p % 8 < 1 ? 0 : 1; }); // an eighth
  const VarianceTiles cells = input.Make();
  ASSERT_EQ(cells.Columns(), 8u);
  ASSERT_EQ(cells.Rows(), 4u);
  const TileComparison comparison = cells.Compare(input.prediction);
  EXPECT_EQ(comparison.fits[0], CellFit::Fits);
  EXPECT_EQ(comparison.fits[1], CellFit::Above);
  EXPECT_EQ(comparison.fits[2], CellFit::Below);
  EXPECT_EQ(comparison.fits[3], CellFit::Fits);
  EXPECT_EQ(comparison.fits[8 + 4], CellFit::Above);
  EXPECT_EQ(comparison.fits[8 + 5], CellFit::Fits);
  EXPECT_DOUBLE_EQ(comparison.above, 2.0 / 32.0);
  EXPECT_DOUBLE_EQ(comparison.below, 1.0 / 32.0);
  EXPECT_DOUBLE_EQ(comparison.fitting, 29.0 / 32.0);
}

TEST(SensorNoiseVarianceTiles, FewPixelsAreNotTested)
{
  Cells input;
  input.pixels.resize(7); // all in the first tile
  input.sample.raw.resize(7);
  const TileComparison comparison = input.Make().Compare(input.prediction);
  EXPECT_EQ(comparison.fits, std::vector<CellFit>(32, CellFit::Unknown));
  EXPECT_EQ(comparison.fitting + comparison.below + comparison.above, 0.0);
}

TEST(SensorNoiseVarianceTiles, IlluminationChangesPixelsInProportionToTheirSignal)
{
  Cells      input;
  const auto levelOf = [&](std::size_t p) { return 100.0 * input.sample.TermsOf(p)(1); };
  // Two tiles flicker by 20 and 10 %. An object moves in a third tile, and changes the dark pixels most.
  input.ForCell(0, 0, [&](std::size_t p) { input.sample.raw[p] += input.median * 0.04 * levelOf(p) * levelOf(p); });
  input.ForCell(1, 0, [&](std::size_t p) { input.sample.raw[p] += input.median * 0.01 * levelOf(p) * levelOf(p); });
  input.ForCell(
    2, 2, [&](std::size_t p) { input.sample.raw[p] += 0.04 * (100.0 - levelOf(p)) * (100.0 - levelOf(p)); });
  const VarianceTiles cells = input.Make();
  TileComparison      comparison = cells.Compare(input.prediction);
  for (const std::size_t c : { 0, 1, 18 })
  {
    EXPECT_EQ(comparison.fits[c], CellFit::Above) << c;
  }
  EXPECT_DOUBLE_EQ(cells.TestIllumination(comparison, input.prediction, 2.5).explained, 2.0 / 3.0);
  comparison.fits[18] = CellFit::Unknown;
  comparison.fits[1] = CellFit::Unknown;
  const IlluminationTest illumination = cells.TestIllumination(comparison, input.prediction, 2.5);
  EXPECT_EQ(illumination.explained, 1.0);
  EXPECT_NEAR(illumination.modulation, 0.2, 0.01); // the median agrees with the mean within 1 %
}
