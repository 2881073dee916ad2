// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "base/Stencils.h"
#include "scene/ReferenceFrame.h"
#include "series/FrameEquations.h"
#include "series/FrameSums.h"
#include "series/OffsetLine.h"
#include "series/FrameRegressors.h"
#include "helpers/FrameTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 70;
constexpr std::size_t Height = 55;
constexpr std::size_t Frames = 24;
constexpr double      OffsetDn = 120.0;

const std::vector<FrameChange> &
Changes()
{
  static const auto changes = FlickerAndMotion(Frames, OffsetDn, 1.0);
  return changes;
}

std::vector<double>
Flicker()
{
  std::vector<double> gamma;
  for (const FrameChange & change : Changes())
  {
    gamma.push_back(change.slope);
  }
  return gamma;
}

/** Returns Changes() with third differences along both axes, \a third times the first differences. */
std::vector<FrameChange>
ChangesWithThird(double third)
{
  std::vector<FrameChange> changes = Changes();
  for (FrameChange & change : changes)
  {
    change.motion[StencilXXX] = third * change.motion[StencilX];
    change.motion[StencilYYY] = third * change.motion[StencilY];
    std::fill(change.motion.begin() + StencilYYY + 1, change.motion.end(), 0.0);
  }
  return changes;
}

/** Input and results of the regression. */
struct Fit
{
  SyntheticFrames frames;
  FrameSums       sums;
  FrameEquations  equations;
  MotionSeries    motion;
  double          offset;

  explicit Fit(double noise, const std::vector<FrameChange> & changes = Changes())
    : frames(Width, Height, changes, noise)
    , sums(frames.Sums())
    , equations(MakeFrameEquations(sums, {}, GradientClasses - 1))
    , offset(OffsetDn - sums.GetRegressors().GetModel().centreDn)
  {
    motion = SolveMotion(equations, Flicker(), offset);
  }
};
} // namespace

TEST(SensorNoiseMotionSeries, MotionOfNoiseFreeFramesIsFound)
{
  const Fit fit(0.0);
  ASSERT_EQ(fit.motion.stencils.size(), NumberOfStencils);
  for (std::size_t t = 0; t < Frames; ++t)
  {
    for (std::size_t k = 0; k < NumberOfStencils; ++k)
    {
      EXPECT_NEAR(fit.motion.Get(t, k), Changes()[t].motion[k], 3e-5) << t << ' ' << k;
    }
  }
}

TEST(SensorNoiseMotionSeries, MotionIsTheDenseFitWithoutTheIllumination)
{
  const Fit         fit(1.0);
  const auto        size = static_cast<Eigen::Index>(fit.motion.stencils.size());
  Eigen::MatrixXd   gram = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd   right = Eigen::VectorXd::Zero(size);
  const std::size_t t = 5;
  for (std::size_t p = 0; p < fit.frames.Pixels(); ++p)
  {
    if (fit.frames.take[p] != 0)
    {
      Eigen::VectorXd derivatives(size);
      for (Eigen::Index i = 0; i < size; ++i)
      {
        derivatives(i) = fit.frames.Derivative(fit.motion.stencils[static_cast<std::size_t>(i)], p);
      }
      const double mean = fit.frames.reference.mean[p];
      const double rest = fit.frames.Frame(t)[p] - mean - Flicker()[t] * (mean - OffsetDn);
      gram += fit.frames.Weight(p) * derivatives * derivatives.transpose();
      right += fit.frames.Weight(p) * rest * derivatives;
    }
  }
  const Eigen::VectorXd expected = gram.ldlt().solve(right);
  EXPECT_LT((fit.motion.coefficients.row(t).transpose() - expected).norm(), 1e-6 * expected.norm());
  // With weights 1 / V the covariance of the coefficients is the inverse of the Gram matrix.
  EXPECT_LT((fit.motion.covariance - gram.inverse()).norm(), 1e-8 * gram.inverse().norm());
}

TEST(SensorNoiseMotionSeries, InactiveStencilsHaveTheCoefficientZero)
{
  MotionSeries series;
  series.stencils = { StencilY };
  series.coefficients = Eigen::MatrixXd::Constant(3, 1, 7.0);
  EXPECT_EQ(series.Get(2, StencilY), 7.0);
  EXPECT_EQ(series.Get(2, StencilX), 0.0);
}

// The third differences are between the values for cubics and for a band-limited scene.
TEST(SensorNoiseMotionSeries, InstrumentsFindTheShiftsOfNoiseFreeFrames)
{
  for (const double third : { 0.0, -1.0 / 12.0, -1.0 / 6.0 })
  {
    const Fit  fit(0.0, ChangesWithThird(third));
    const auto shifts = SolveShifts(fit.sums, fit.equations, fit.motion, {}, Flicker(), fit.offset);
    ASSERT_TRUE(shifts);
    for (std::size_t t = 0; t < Frames; ++t)
    {
      const auto row = static_cast<Eigen::Index>(t);
      // Least squares finds the third difference within 1e-4.
      EXPECT_NEAR(shifts->coefficients(row, 0), Changes()[t].motion[StencilX], 1e-4) << t << ' ' << third;
      EXPECT_NEAR(shifts->coefficients(row, 1), Changes()[t].motion[StencilY], 1e-4) << t << ' ' << third;
    }
    EXPECT_LT(shifts->scaleErrors.norm(), 1e-3) << third;
  }
}

// At edges that are sharper than the pixels, least squares finds larger third differences than a derivative has.
TEST(SensorNoiseMotionSeries, ThirdDifferencesBeyondADerivativeAreNotSubtracted)
{
  const Fit             fit(0.0, ChangesWithThird(-0.5));
  const auto            shifts = SolveShifts(fit.sums, fit.equations, fit.motion, {}, Flicker(), fit.offset);
  const auto            gram = fit.sums.GetInstrumentGram();
  const Eigen::Matrix2d first = gram.middleCols<2>(2 + StencilX);
  const Eigen::Matrix2d third = gram.middleCols<2>(2 + StencilXXX);
  ASSERT_TRUE(shifts);
  for (std::size_t t = 0; t < Frames; ++t)
  {
    const Eigen::Vector2d shift(Changes()[t].motion[StencilX], Changes()[t].motion[StencilY]);
    const Eigen::Vector2d expected = (first - third / 6.0).inverse() * (first - 0.5 * third) * shift;
    const Eigen::Vector2d found = shifts->coefficients.row(static_cast<Eigen::Index>(t)).transpose();
    EXPECT_LT((found - expected).norm(), 1e-6 * (1.0 + expected.norm())) << t;
  }
}

// The frames contain noise alone, so that the shifts have no other variance.
TEST(SensorNoiseMotionSeries, TheCovarianceOfTheShiftsHoldsTheNoiseOfTheFlicker)
{
  constexpr std::size_t frames = 400;
  const SyntheticFrames noise(Width, Height, std::vector<FrameChange>(frames), 1.0);
  const FrameSums       sums = noise.Sums();
  const FrameEquations  equations = MakeFrameEquations(sums, {}, GradientClasses - 1);
  const auto            line = FitOffsetLine(equations);
  ASSERT_TRUE(line);
  OffsetLine illumination = *line;
  illumination.UseOffset(OffsetDn - sums.GetRegressors().GetModel().centreDn);
  const double       offset = OffsetDn - sums.GetRegressors().GetModel().centreDn;
  const MotionSeries motion = SolveMotion(equations, illumination.gamma, offset);
  const double       black = noise.model.interceptDn2 - noise.model.slopeDn * noise.model.darkestDn;
  const auto         ofInstruments = sums.NoiseOfInstruments(noise.model.slopeDn, black);
  const auto         shifts = SolveShifts(sums, equations, motion, ofInstruments, illumination.gamma, offset);
  ASSERT_TRUE(shifts);
  for (const Eigen::Index axis : { 0, 1 })
  {
    const Eigen::ArrayXd series = shifts->coefficients.col(axis).array();
    const double         variance = (series - series.mean()).square().sum() / (frames - 1.0);
    EXPECT_NEAR(variance / shifts->covariance(axis, axis), 1.0, 4.0 * std::sqrt(2.0 / frames)) << axis;
  }
}

TEST(SensorNoiseMotionSeries, CommonNoiseOfInstrumentsAndRegressorsIsSubtracted)
{
  // White noise of variance V / T in the mean adds V / T times the product of the weights of the smoothed and the plain
  // derivative to their Gram matrix. The weights of the smoothed derivative are its response to an impulse.
  ReferenceFrame impulse;
  impulse.geometry = { 41, 41, 1 };
  impulse.mean.assign(41 * 41, 0.0);
  impulse.mean[20 * 41 + 20] = 1.0;
  const std::vector<float> response = SmoothedDerivative(impulse, StencilX, SerialFor);
  double                   shared = 0.0; // sum over dx of response(-dx) weight(dx)
  for (const StencilTap & tap : MotionStencils()[StencilX].taps)
  {
    shared += tap.weight * response[static_cast<std::size_t>((20 - tap.dy) * 41 + 20 - tap.dx)];
  }
  ASSERT_GT(shared, 0.0);
  constexpr double third = -1.0 / 12.0;
  const Fit        fit(0.0, ChangesWithThird(third));
  InstrumentNoise  noise;
  // The noise subtracts a tenth.
  noise.variance = 0.1 * static_cast<double>(Frames) / shared * fit.sums.GetInstrumentGram()(0, 2 + StencilX);
  const auto shifts = SolveShifts(fit.sums, fit.equations, fit.motion, noise, Flicker(), fit.offset);
  const auto plain = SolveShifts(fit.sums, fit.equations, fit.motion, {}, Flicker(), fit.offset);
  ASSERT_TRUE(shifts && plain);
  const auto             gram = fit.sums.GetInstrumentGram();
  Eigen::Matrix2d        gradient = gram.middleCols<2>(2 + StencilX) + third * gram.middleCols<2>(2 + StencilXXX);
  const auto             rest = plain->coefficients * gradient.transpose();
  const Eigen::MatrixX2d expected = rest;
  // The product with a third difference is as large as with a first difference, with the opposite sign.
  gradient.diagonal().array() -= (1.0 - third) * shared * noise.variance / static_cast<double>(Frames);
  // The weights of the smoothed derivative have single precision.
  EXPECT_LT((shifts->coefficients * gradient.transpose() - expected).norm(), 1e-7 * expected.norm());
}

namespace
{
/** Returns \a equations without column 2 + StencilY, and without all columns of higher order. */
FrameEquations
AlongX(FrameEquations equations)
{
  equations.active.resize(3);
  equations.rawGram = equations.rawGram.topLeftCorner<3, 3>().eval();
  equations.gram = equations.gram.topLeftCorner<3, 3>().eval();
  equations.right = equations.right.leftCols<3>().eval();
  return equations;
}
} // namespace

TEST(SensorNoiseMotionSeries, AlongOneAxisTheInstrumentsFindTheShiftsAlone)
{
  std::vector<FrameChange> changes = Changes();
  for (FrameChange & change : changes)
  {
    std::fill(change.motion.begin() + 1, change.motion.end(), 0.0); // a shift along x alone
  }
  const Fit            fit(0.0, changes);
  const FrameEquations equations = AlongX(fit.equations);
  const MotionSeries   motion = SolveMotion(equations, Flicker(), fit.offset);
  const auto           shifts = SolveShifts(fit.sums, equations, motion, {}, Flicker(), fit.offset);
  ASSERT_TRUE(shifts);
  for (std::size_t t = 0; t < Frames; ++t)
  {
    const auto row = static_cast<Eigen::Index>(t);
    EXPECT_NEAR(shifts->coefficients(row, 0), changes[t].motion[StencilX], 1e-5) << t;
    EXPECT_EQ(shifts->coefficients(row, 1), 0.0) << t;
  }
  EXPECT_EQ(shifts->covariance(1, 1), 0.0);
  // Each gradient class has the same shifts.
  EXPECT_NEAR(ScaleErrorsOf(fit.sums, {}, motion, Flicker(), fit.offset)(0), 0.0, 1e-5);
}

TEST(SensorNoiseMotionSeries, BlocksThatDoNotMoveDeviate)
{
  std::vector<FrameChange> changes = Changes();
  for (FrameChange & change : changes)
  {
    std::fill(change.motion.begin() + 1, change.motion.end(), 0.0);
  }
  Fit fit(1e-3, changes);
  EXPECT_LT(SolveShifts(fit.sums, fit.equations, fit.motion, {}, Flicker(), fit.offset)->ofBlocks[0].rms, 1e-3);

  // The right half does not move. Cells, and so blocks, end at the middle.
  for (std::size_t i = 0; i < fit.frames.pixels.size(); ++i)
  {
    const std::size_t p = i % fit.frames.Pixels();
    if (p % Width >= Width / 2 && fit.frames.take[p] != 0)
    {
      fit.frames.pixels[i] -= changes[i / fit.frames.Pixels()].motion[StencilX] * fit.frames.Derivative(StencilX, p);
    }
  }
  const FrameSums      sums = fit.frames.Sums();
  const FrameEquations equations = AlongX(MakeFrameEquations(sums, {}, GradientClasses - 1));
  const MotionSeries   motion = SolveMotion(equations, Flicker(), fit.offset);
  const auto           shifts = SolveShifts(sums, equations, motion, {}, Flicker(), fit.offset);
  ASSERT_TRUE(shifts);
  // With the fraction c of the derivatives in the left half, the common shift is c times the shift of this half.
  double      ofLeft = 0.0;
  std::size_t blocks = 0;
  for (std::size_t block = 0; block < FrameProducts::Blocks; ++block)
  {
    const double own = sums.GetInstrumentGram(block)(0, 2 + StencilX);
    ofLeft += block % FrameProducts::BlocksPerAxis < FrameProducts::BlocksPerAxis / 2 ? own : 0.0;
    blocks += own != 0.0 ? 1 : 0;
  }
  EXPECT_EQ(blocks, 8U); // two cells side by side
  const double c = ofLeft / sums.GetInstrumentGram()(0, 2 + StencilX);
  EXPECT_NEAR(shifts->ofBlocks[0].rms, std::sqrt(c * std::pow(1.0 / c - 1.0, 2) + 1.0 - c), 0.01);
  EXPECT_NEAR(shifts->coefficients(3, 0), c * changes[3].motion[StencilX], 0.02 * changes[3].motion[StencilX]);
  EXPECT_EQ(shifts->ofBlocks[1].rms, 0.0); // no shift along y
}

TEST(SensorNoiseMotionSeries, WithoutDerivativesNoShiftsAreFound)
{
  Fit fit(0.0);
  fit.equations.active.resize(2);
  EXPECT_FALSE(SolveShifts(fit.sums, fit.equations, fit.motion, {}, Flicker(), fit.offset));
}

TEST(SensorNoiseMotionSeries, TheScaleErrorIsTheDeviationOfTheGradientClasses)
{
  std::vector<FrameChange> changes = Changes();
  for (FrameChange & change : changes)
  {
    std::fill(change.motion.begin() + 1, change.motion.end(), 0.0);
  }
  const Fit    fit(0.0, changes);
  MotionSeries motion = SolveMotion(AlongX(fit.equations), Flicker(), fit.offset);
  motion.coefficients *= 0.8; // each class has shifts that are 1 / 0.8 times as large
  EXPECT_NEAR(ScaleErrorsOf(fit.sums, {}, motion, Flicker(), fit.offset)(0), 0.25, 1e-8);
}

TEST(SensorNoiseMotionSeries, SmoothedDerivativeOfARampIsItsSlope)
{
  ReferenceFrame ramp;
  ramp.geometry = { 50, 40, 1 };
  for (std::size_t p = 0; p < 50 * 40; ++p)
  {
    ramp.mean.push_back(3.0 * static_cast<double>(p % 50) - 2.0 * static_cast<double>(p / 50));
  }
  const std::size_t middle = 20 * 50 + 25;
  EXPECT_NEAR(SmoothedDerivative(ramp, StencilX, SerialFor)[middle], 3.0, 1e-6);
  EXPECT_NEAR(SmoothedDerivative(ramp, StencilY, SerialFor)[middle], -2.0, 1e-6);
}

TEST(SensorNoiseMotionSeries, SmoothedDerivativeIsThatOfTwoBoxesInEveryRow)
{
  ReferenceFrame frame; // more rows than two bands of box sums
  frame.geometry = { 23, 140, 1 };
  const int width = 23;
  const int height = 140;
  for (int p = 0; p < width * height; ++p)
  {
    frame.mean.push_back(100.0 * std::sin(0.7 * p * p));
  }
  std::vector<double> expected(frame.mean.size(), 0.0);
  for (int y = 2; y + 2 < height; ++y)
  {
    for (int x = 2; x + 2 < width; ++x)
    {
      const auto p = static_cast<std::size_t>(y * width + x);
      expected[p] = ApplyStencil(MotionStencils()[StencilY], frame.mean.data(), frame.geometry.width, p);
    }
  }
  for (int box = 0; box < 2; ++box)
  {
    const std::vector<double> before = expected;
    for (int p = 0; p < width * height; ++p)
    {
      double sum = 0.0;
      for (int y = std::max(0, p / width - 3); y <= std::min(height - 1, p / width + 3); ++y)
      {
        for (int x = std::max(0, p % width - 3); x <= std::min(width - 1, p % width + 3); ++x)
        {
          sum += before[static_cast<std::size_t>(y * width + x)];
        }
      }
      expected[static_cast<std::size_t>(p)] = sum / 49.0;
    }
  }
  const auto smoothed = SmoothedDerivative(frame, StencilY, Threads(3));
  for (std::size_t p = 0; p < expected.size(); ++p)
  {
    EXPECT_FLOAT_EQ(smoothed[p], static_cast<float>(expected[p])) << p;
  }
  EXPECT_TRUE(HaveSameBits(smoothed, SmoothedDerivative(frame, StencilY, SerialFor)));
}

TEST(SensorNoiseMotionSeries, InstrumentWeightIsTheInverseNoiseAndFallsToZeroWherePixelsAreMissing)
{
  SyntheticFrames frames(Width, Height, std::vector<FrameChange>(5));
  frames.model.slopeDn = 0.0; // one noise variance
  auto              mask = frames.take;
  const std::size_t hole = 27 * Width + 20;
  mask[hole] = 0;
  const auto   weight = InstrumentWeight(frames.reference, frames.model, mask, SerialFor);
  const double full = 1.0 / frames.model.NoiseVariance(500.0);
  EXPECT_NEAR(weight[27 * Width + 50], full, 1e-7 * full); // far away
  EXPECT_EQ(weight[hole], 0.0);
  for (std::size_t x = 20; x < 50; ++x)
  {
    EXPECT_GE(weight[27 * Width + x + 1] + 1e-12, weight[27 * Width + x]) << x;
    EXPECT_LT(weight[27 * Width + x + 1] - weight[27 * Width + x], 0.5 * full) << x;
  }
}
