// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/IlluminationResponses.h"
#include "base/Eigen.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/SurfaceSums.h"
#include "pixels/VarianceLine.h"
#include "sensornoise/Parallel.h"
#include "helpers/ProjectionTestHelper.h"

#include <cmath>
#include <cstddef>
#include <functional>
#include <gtest/gtest.h>
#include <optional>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::projection;

namespace
{
constexpr double OffsetDn = 120.0;
constexpr double CentreDn = 950.0;

/** Responses of a pixel to the two temporal components of the illumination, as a function of its mean. */
using Responses = std::function<Eigen::Vector2d(std::size_t p, double mean)>;

/** Pixels with a noise of 400 DN^2 and these responses. */
struct Scene
{
  Input            input;
  ProjectedSquares squares; // turns the sums of the input into coordinates
  VarianceLine     line;

  explicit Scene(const Responses & responses)
    : input(Series(responses))
    , squares(input.Project())
  {
    line.intercept = 400.0;
  }
  static Eigen::MatrixXd
  Series(const Responses & responses)
  {
    const std::vector<double> mean = WavyScene(Width, Height);
    Eigen::MatrixXd           series = NormalSeries();
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      series.col(static_cast<Eigen::Index>(p)) += Basis().GetBasis().leftCols<2>() * responses(p, mean[p]);
    }
    return series;
  }
  IlluminationResponses
  Data() const
  {
    return { input.frame, input.coordinates, Basis().NumberOfIlluminationFactors(), line, input.mask, CentreDn, 400.0,
             1200.0 };
  }
};

/** Returns illumination that is uniform, and illumination that decreases slightly from the left. */
Eigen::Vector2d
TwoSources(std::size_t p, double mean)
{
  const double x = static_cast<double>(p % Width) / Width;
  return (mean - OffsetDn) * Eigen::Vector2d(0.3, 0.4 + 0.02 * x);
}

/** Returns illumination that is uniform, and a level that drifts. */
Eigen::Vector2d
OneSourceAndADrift(std::size_t, double mean)
{
  return { 0.3 * (mean - OffsetDn), 300.0 };
}

std::optional<LocalOffset>
OffsetOf(const Scene & scene)
{
  const IlluminationResponses data = scene.Data();
  return FindLocalOffset(data, EstimateMotionLeakage(data).kappa);
}

bool
IsMotionLocal(const Responses & responses)
{
  const Scene scene(responses);
  return EstimateMotionLeakage(scene.Data()).isMotionLocal;
}
} // namespace

TEST(SensorNoiseLocalOffset, SourcesHaveOneOffset)
{
  const Scene scene(TwoSources);
  const auto  found = OffsetOf(scene);
  ASSERT_TRUE(found);
  EXPECT_GT(found->tiles, 0u);
  EXPECT_LT(found->standardError, 20.0);
  EXPECT_NEAR(found->offset + CentreDn, OffsetDn, 5.0 * found->standardError);
  EXPECT_LT(found->low, found->offset);
  EXPECT_GT(found->high, found->offset);
  EXPECT_LT(found->phi, 3.0);
}

TEST(SensorNoiseLocalOffset, SourcesWithoutACommonZeroAreReported)
{
  // The illumination by the second lamp is not proportional to that by the first: a part of the scene glows.
  const Scene scene([](std::size_t p, double mean) {
    return Eigen::Vector2d(0.3 * (mean - OffsetDn), 0.4 * (mean - (p % Width < Width / 2 ? 700.0 : -500.0)));
  });
  const auto  found = OffsetOf(scene);
  EXPECT_TRUE(!found || !found->doLinesMeet);
}

TEST(SensorNoiseLocalOffset, PartitionsWithinWhichTheIlluminationVariesAreNotUsed)
{
  // The illumination changes in proportion to the mean of blocks of 16 x 16 pixels. Smaller tiles have one pattern.
  // In larger tiles, bright pixels change more, as if the offset were higher.
  const std::vector<double> mean = WavyScene(Width, Height);
  std::vector<double>       ofBlock(mean.size(), 0.0);
  for (std::size_t p = 0; p < mean.size(); ++p)
  {
    ofBlock[p / Width / 16 * 16 * Width + p % Width / 16 * 16] += mean[p] / 256.0;
  }
  const Scene scene([&ofBlock](std::size_t p, double level) {
    const double rate = ofBlock[p / Width / 16 * 16 * Width + p % Width / 16 * 16] / CentreDn;
    return Eigen::Vector2d(rate * (level - OffsetDn), 0.0);
  });
  const auto  found = OffsetOf(scene);
  ASSERT_TRUE(found);
  EXPECT_GE(found->tiles, 20u); // the frame has 20 tiles of 16 x 16 pixels, and 6 of 32 x 32
  EXPECT_TRUE(!found->doLinesMeet || std::abs(found->offset + CentreDn - OffsetDn) < 4.0 * found->standardError);
}

// One lamp on the left and one on the right. Within a tile, the scene and the illumination have gradients, whose
// product looked like another offset.
TEST(SensorNoiseLocalOffset, GradientsOfTheIlluminationDoNotShiftTheOffset)
{
  const Scene scene([](std::size_t p, double mean) {
    const double x = static_cast<double>(p % Width) / Width;
    return Eigen::Vector2d((mean - OffsetDn) * 0.5 * x, (mean - OffsetDn) * 0.5 * (1.0 - x));
  });
  const auto  found = OffsetOf(scene);
  ASSERT_TRUE(found);
  EXPECT_LT(found->standardError, 10.0);
  EXPECT_NEAR(found->offset + CentreDn, OffsetDn, 4.0 * found->standardError);
  EXPECT_LT(found->phi, 2.0); // 20 tiles with 2 lines each scatter by 0.2
}

// A spot in the middle is curved within every tile: the lines meet where its curvature is projected out.
TEST(SensorNoiseLocalOffset, LinesMeetUnderCurvedIllumination)
{
  const Scene scene([](std::size_t p, double mean) {
    const double x = static_cast<double>(p % Width) / Width - 0.5;
    const double y = static_cast<double>(p / Width) / Height - 0.5;
    return Eigen::Vector2d((mean - OffsetDn) * (1.0 - 4.0 * (x * x + y * y)), 0.0);
  });
  const auto  found = OffsetOf(scene);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->doLinesMeet);
  EXPECT_LT(found->standardError, 20.0);
  EXPECT_NEAR(found->offset + CentreDn, OffsetDn, 3.0 * found->standardError);
}

// A light source flickers; another one is steady, and lights the right of the frame. No tile has another slope.
TEST(SensorNoiseLocalOffset, SteadyLightMakesParallelLines)
{
  const Scene scene([](std::size_t p, double mean) {
    const double x = static_cast<double>(p % Width) / Width;
    return Eigen::Vector2d(0.3 * (mean - OffsetDn - 300.0 * x * x), 0.0);
  });
  const auto  found = OffsetOf(scene);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->areParallel);
  EXPECT_FALSE(found->doLinesMeet);
  for (const Responses & uneven :
       { Responses(TwoSources), Responses([](std::size_t p, double mean) {
           return Eigen::Vector2d((mean - OffsetDn) * 0.5 * static_cast<double>(p % Width) / Width, 0.0);
         }) })
  {
    EXPECT_FALSE(OffsetOf(Scene(uneven))->areParallel);
  }
}

TEST(SensorNoiseLocalOffset, SlopesOfNoiseHaveNoCommonZero)
{
  const Scene scene([](std::size_t, double) { return Eigen::Vector2d(0.0, 0.0); });
  EXPECT_FALSE(OffsetOf(scene));
}

TEST(SensorNoiseLocalOffset, DriftingLevelIsOneLineOverTheFrame)
{
  EXPECT_TRUE(IsOffsetDrift(Scene(OneSourceAndADrift).Data()));
  EXPECT_FALSE(IsOffsetDrift(Scene(TwoSources).Data()));
}

TEST(SensorNoiseLocalOffset, PartsThatMoveByThemselvesAreNoIllumination)
{
  const std::vector<double> mean = WavyScene(Width, Height);
  const auto                shifted = [&mean](std::size_t p, double shift) {
    const bool isInside = p > 0 && p + 1 < mean.size();
    return Eigen::Vector2d(0.0, isInside ? 0.5 * shift * (mean[p + 1] - mean[p - 1]) : 0.0);
  };
  EXPECT_FALSE(IsMotionLocal(TwoSources));
  EXPECT_FALSE(IsMotionLocal(OneSourceAndADrift));
  EXPECT_FALSE(IsMotionLocal([&](std::size_t p, double) { return shifted(p, 10.0); })); // the whole frame
  EXPECT_TRUE(IsMotionLocal([&](std::size_t p, double) { return shifted(p, p % Width < Width / 2 ? 10.0 : 0.0); }));
}

// The sums over a tile are those over its parts, moved, and both are the sums that the definition of the terms gives.
TEST(SensorNoiseSurfaceSums, SumsOverPartsAreSumsOverTheTile)
{
  const Scene                 scene(TwoSources);
  const IlluminationResponses data = scene.Data();
  constexpr std::size_t       side = 16;
  const auto                  secondResponse = [&data](const PixelOfTile & pixel, double * variables) {
    variables[0] = data.coordinates.At(pixel.index, 1);
  };
  SurfaceSums joined(1);
  for (std::size_t row = 0; row < 2; ++row)
  {
    const std::vector<SurfaceSums> parts = SumRowOfTiles(data, row * side / 2, side / 2, side / 4, 1, secondResponse);
    for (std::size_t column = 0; column < 4; ++column)
    {
      joined.AddPart(parts[column], Move(column, 4.0), Move(row, 2.0));
    }
  }
  const SurfaceSums whole = SumRowOfTiles(data, 0, side, side, 1, secondResponse).front();

  constexpr double  ofNoise = 0.01;
  SurfaceSums::Gram gram = SurfaceSums::Gram::Zero();
  CurvedSurface     products = CurvedSurface::Zero();
  double            pixels = 0.0;
  for (std::size_t p = 0; p < side * Width; ++p)
  {
    if (p % Width < side && data.mask[p] != 0)
    {
      const double  x = (static_cast<double>(p % Width) + 0.5) / side - 0.5;
      const double  y = (static_cast<double>(p / Width) + 0.5) / side - 0.5;
      const double  level = data.frame.mean[p] - CentreDn;
      const double  w = 1.0 / data.line.At(data.frame.neighbourMean[p]);
      CurvedSurface terms;
      terms << 1.0, level, x, y, x * level, y * level, x * x, x * y, y * y, x * x * level, x * y * level, y * y * level;
      CurvedSurface ofLevel; // derivatives of the terms by the level
      ofLevel << 0.0, 1.0, 0.0, 0.0, x, y, 0.0, 0.0, 0.0, x * x, x * y, y * y;
      gram += w * terms * terms.transpose() - ofNoise * ofLevel * ofLevel.transpose();
      products += w * data.coordinates.At(p, 1) * (terms - ofNoise * ofLevel);
      pixels += 1.0;
    }
  }
  ASSERT_GT(pixels, 0.0);
  for (const SurfaceSums & sums : { joined, whole })
  {
    EXPECT_DOUBLE_EQ(sums.NumberOfPixels(), pixels);
    const double rounding = 1e-12 * gram.cwiseAbs().maxCoeff();
    EXPECT_LT((sums.ProductsOfTerms(ofNoise) - gram).cwiseAbs().maxCoeff(), rounding);
    EXPECT_LT((sums.ProductsWith(0, ofNoise) - products).cwiseAbs().maxCoeff(), 1e-12 * products.cwiseAbs().maxCoeff());
  }
}
