// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/StaticVariance.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "pixels/Constants.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/ProjectionSums.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "series/FrameEquations.h"
#include "series/SceneSeries.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Width = 256;
constexpr std::size_t Height = 192;
constexpr std::size_t Pixels = Width * Height;
constexpr std::size_t Frames = 24;
constexpr double      BlackDn = 100.0;

/** Returns a signal that rises from 20 to 1,020 DN along the rows. */
double
SignalAt(std::size_t p)
{
  return 20.0 + 1000.0 * static_cast<double>(p % Width) / (Width - 1.0);
}

/** Returns the line of the tests: a read noise of 10 DN, and many electrons per DN. */
VarianceLine
MakeLine()
{
  VarianceLine line;
  line.gain = 0.4;
  line.intercept = 100.0 - 0.4 * BlackDn;
  line.lowestDn2 = InCommon.lowestFraction * 108.0;
  line.pivotDn = BlackDn + 520.0;
  line.weightSum = 1.0;
  line.spreadDn2 = 1e6 / 12.0;
  line.isDetermined = true;
  return line;
}

/** Burst of normal noise, with the projection from which its pixels are tested. */
struct Burst
{
  ReferenceFrame                     frame;
  std::unique_ptr<TemporalBasis>     basis;
  InitialNoiseModel                  model;
  MotionSeries                       motion;
  std::unique_ptr<ProjectedSquares>  squares;
  std::unique_ptr<ProjectedVariance> projected;

  Burst(const std::function<double(std::size_t p)> & varianceOf, double offsetSdDn = 0.0)
  {
    std::mt19937               random(52);
    std::normal_distribution<> normal;
    std::vector<double>        stack(Pixels * Frames);
    std::vector<double>        mean(Pixels, 0.0);
    std::vector<double>        variance(Pixels, 0.0);
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      const double level = BlackDn + SignalAt(p) + offsetSdDn * normal(random);
      for (std::size_t t = 0; t < Frames; ++t)
      {
        stack[t * Pixels + p] = level + std::sqrt(varianceOf(p)) * normal(random);
        mean[p] += stack[t * Pixels + p] / Frames;
      }
      for (std::size_t t = 0; t < Frames; ++t)
      {
        variance[p] += std::pow(stack[t * Pixels + p] - mean[p], 2) / (Frames - 1.0);
      }
    }
    frame = MakeReferenceFrame(mean, variance, std::vector<std::uint8_t>(Pixels, 1), { Width, Height, 1 }, Frames);
    std::vector<double> gamma(Frames);
    Eigen::VectorXd     wave(Frames);
    for (std::size_t t = 0; t < Frames; ++t)
    {
      gamma[t] = std::sin(1.7 * static_cast<double>(t * t));
      wave(static_cast<Eigen::Index>(t)) = std::sin(0.9 * static_cast<double>(t) + 0.4);
    }
    basis = std::make_unique<TemporalBasis>(gamma, wave, wave.array().square().matrix());
    ProjectionSums sums(Pixels, basis->Size());
    sums.AddFrames(
      ProjectedFrames(*basis, stack.data(), PixelLayout::OfFrames({ Pixels, 1, 1 }), 0, Frames), 0, Pixels);
    model.interceptDn2 = 108.0;
    model.slopeDn = 0.4;
    model.darkestDn = BlackDn + 20.0;
    motion.inverseGram.resize(0, 0);
    ResidualSquares  rest;
    PixelCoordinates none;
    AppendResidualSquares(frame, *basis, sums, SerialFor, rest, none);
    squares =
      std::make_unique<ProjectedSquares>(frame, *basis, motion, std::move(rest), model, frame.usable, SerialFor);
    projected = std::make_unique<ProjectedVariance>(*squares, 0.0);
  }
  RejectionModel
  FitModel(const ParallelFor & parallelFor = SerialFor) const
  {
    return FitRejectionModel(MakeLine(), *projected, frame.usable, BlackDn, parallelFor);
  }
  std::vector<std::uint8_t>
  Rejected(const RejectionModel & rejection) const
  {
    return RejectNeighbourhoods(*projected, rejection, frame.usable, SerialFor);
  }
};

std::size_t
Count(const std::vector<std::uint8_t> & marks)
{
  return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), std::uint8_t{ 1 }));
}

double
StraightVariance(std::size_t p)
{
  return 100.0 + 0.4 * SignalAt(p);
}

/** Returns the variance of a non-linear response: it is 30 % larger in the middle of the levels than at the ends. */
double
NonlinearVariance(std::size_t p)
{
  const double u = SignalAt(p) / 1020.0;
  return StraightVariance(p) * (0.85 + 1.2 * u * (1.0 - u));
}

/** Returns whether a pixel is in the tile of 20 x 20 pixels with three times the variance. */
bool
IsInPatch(std::size_t p)
{
  return p % Width >= 150 && p % Width < 170 && p / Width >= 80 && p / Width < 100;
}
} // namespace

TEST(SensorNoiseRejectionModel, LinearSensorIsTestedByItsLine)
{
  const Burst          burst(StraightVariance);
  const RejectionModel rejection = burst.FitModel();
  EXPECT_TRUE(rejection.levels.empty() && rejection.ratios.empty());
  EXPECT_FALSE(rejection.byNeighbours);
  EXPECT_EQ(rejection.line.noiseDispersionDn4, 0.0);
  EXPECT_EQ(rejection.At(500.0), MakeLine().At(500.0));
  EXPECT_EQ(Count(burst.Rejected(rejection)), 0u);
}

TEST(SensorNoiseRejectionModel, NonlinearResponseIsFollowedAndRejectsNoPixel)
{
  const Burst          burst(NonlinearVariance);
  const RejectionModel rejection = burst.FitModel();
  ASSERT_GE(rejection.levels.size(), 8u);
  EXPECT_TRUE(std::is_sorted(rejection.levels.begin(), rejection.levels.end()));
  // The median of six tiles of 256 pixels with 20 degrees of freedom: 5 x 1.25 x sqrt(2 / 20 / 256 / 6) = 5 %.
  for (std::size_t x = 20; x < Width - 20; x += 20)
  {
    EXPECT_NEAR(rejection.At(BlackDn + SignalAt(x)) / NonlinearVariance(x), 1.0, 0.05) << x;
  }
  EXPECT_EQ(Count(burst.Rejected(rejection)), 0u);
  // With the straight line pixels at the middle levels are rejected.
  EXPECT_GT(Count(burst.Rejected({ MakeLine(), {}, {} })), Pixels / 10);
}

TEST(SensorNoiseRejectionModel, MovingPatchIsFoundUnderANonlinearResponse)
{
  const Burst burst([](std::size_t p) { return (IsInPatch(p) ? 3.0 : 1.0) * NonlinearVariance(p); });
  const auto  rejected = burst.Rejected(burst.FitModel());
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    EXPECT_FALSE(IsInPatch(p) && rejected[p] == 0) << p % Width << ' ' << p / Width;
  }
  EXPECT_LT(Count(rejected), 50u * 50u); // the moving tile with a margin of one core
}

TEST(SensorNoiseRejectionModel, PixelsWithUnequalReadNoiseAreNotRejected)
{
  // The logarithm of the read noise has the standard deviation 0.4. The mean of its square is 1.38 times the median.
  std::vector<double>        read(Pixels);
  std::mt19937               random(53);
  std::normal_distribution<> normal;
  double                     mean = 0.0;
  for (double & value : read)
  {
    value = 100.0 * std::exp(0.8 * normal(random));
    mean += value / Pixels;
  }
  double spread = 0.0;
  for (const double value : read)
  {
    spread += (value - mean) * (value - mean) / Pixels;
  }
  const auto           varianceOf = [&](std::size_t p) { return read[p] + 0.4 * SignalAt(p); };
  const RejectionModel rejection = Burst(varianceOf).FitModel();
  EXPECT_FALSE(rejection.levels.empty());
  // The median tile has fewer pixels of the heavy tail than the mean of all tiles.
  EXPECT_GT(rejection.line.noiseDispersionDn4, 0.3 * spread);
  EXPECT_LT(rejection.line.noiseDispersionDn4, 1.5 * spread);
  EXPECT_EQ(Count(Burst(varianceOf).Rejected(rejection)), 0u);
  const auto  moved = [&](std::size_t p) { return (IsInPatch(p) ? 3.0 : 1.0) * varianceOf(p); };
  const Burst patch(moved);
  const auto  rejected = patch.Rejected(patch.FitModel());
  EXPECT_EQ(rejected[90 * Width + 160], 1);
  EXPECT_LT(Count(rejected), 50u * 50u);
}

TEST(SensorNoiseRejectionModel, PixelsWithUnequalOffsetsAreTestedAtTheMeanOfTheirNeighbours)
{
  // With these offsets the value of the line changes by 0.4 x 60 DN^2, a fifth of its value at the darkest level.
  const Burst          burst(StraightVariance, 60.0);
  const RejectionModel rejection = burst.FitModel();
  EXPECT_TRUE(rejection.byNeighbours);
  EXPECT_EQ(rejection.LevelOf(burst.frame, 1000), burst.frame.neighbourMean[1000]);
  EXPECT_EQ(Count(burst.Rejected(rejection)), 0u);
}

TEST(SensorNoiseRejectionModel, RatioIsLinearBetweenLevelsAndConstantBeyond)
{
  const RejectionModel rejection{ MakeLine(), { 200.0, 400.0 }, { 1.0, 1.2 } };
  EXPECT_EQ(rejection.At(100.0), MakeLine().At(100.0));
  EXPECT_NEAR(rejection.At(250.0), 1.05 * MakeLine().At(250.0), 1e-9);
  EXPECT_NEAR(rejection.At(900.0), 1.2 * MakeLine().At(900.0), 1e-9);
}

TEST(SensorNoiseRejectionModel, ThreadsChangeNoBit)
{
  const Burst burst(NonlinearVariance);
  EXPECT_EQ(burst.FitModel().ratios, burst.FitModel(test::Threads(3)).ratios);
}
