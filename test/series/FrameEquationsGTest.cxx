// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameEquations.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "base/Stencils.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "series/FrameSums.h"
#include "series/FrameRegressors.h"
#include "helpers/FrameTestHelper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 70;
constexpr std::size_t Height = 45;
constexpr std::size_t LastClass = GradientClasses - 1;

/** Returns frames with flicker, motion of all orders, and noise of the variance of the model. */
const SyntheticFrames &
NoisyFrames()
{
  static const SyntheticFrames frames(Width, Height, FlickerAndMotion(24, 100.0, 0.3), 1.0);
  return frames;
}

const FrameSums &
NoisySums()
{
  static const FrameSums sums = NoisyFrames().Sums();
  return sums;
}

/** Returns the coefficients of frame \a t by weighted least squares over single pixels, with an orthogonal
 * decomposition. */
Eigen::VectorXd
DenseFit(const SyntheticFrames &          frames,
         const FrameSums &                sums,
         const std::vector<std::size_t> & active,
         std::size_t                      lastClass,
         std::size_t                      t)
{
  std::vector<std::size_t> pixels;
  for (std::size_t p = 0; p < frames.Pixels(); ++p)
  {
    if (sums.GetRegressors().ClassOf(p) <= lastClass)
    {
      pixels.push_back(p);
    }
  }
  Eigen::MatrixXd design(pixels.size(), active.size());
  Eigen::VectorXd change(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    const double root = std::sqrt(frames.Weight(pixels[i]));
    const auto   columns = frames.ColumnsOf(pixels[i]);
    const auto   row = static_cast<Eigen::Index>(i);
    for (std::size_t k = 0; k < active.size(); ++k)
    {
      design(row, static_cast<Eigen::Index>(k)) = root * columns(static_cast<Eigen::Index>(active[k]));
    }
    change(row) = root * (frames.Frame(t)[pixels[i]] - frames.reference.mean[pixels[i]]);
  }
  return design.householderQr().solve(change);
}

RegressorNoise
SomeNoise()
{
  RegressorNoise noise;
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    noise.variance[c] = 100.0 + 10.0 * static_cast<double>(c);
    noise.shot[c] = 50.0 + 7.0 * static_cast<double>(c);
  }
  return noise;
}

double
SumUpTo(const std::array<double, GradientClasses> & values, std::size_t last)
{
  double sum = 0.0;
  for (std::size_t c = 0; c <= last; ++c)
  {
    sum += values[c];
  }
  return sum;
}

double
CentreWeightOf(std::size_t column)
{
  return column == 0 ? 0.0 : column == 1 ? 1.0 : MotionStencils()[column - 2].CentreWeight();
}
} // namespace

TEST(SensorNoiseFrameEquations, EqualsDenseWeightedLeastSquares)
{
  for (const std::size_t lastClass : { std::size_t{ 2 }, LastClass })
  {
    const FrameEquations equations = MakeFrameEquations(NoisySums(), {}, lastClass);
    ASSERT_GT(equations.active.size(), 4u) << "the motion has higher orders";
    for (const std::size_t t : { 0, 23 })
    {
      const Eigen::VectorXd expected = DenseFit(NoisyFrames(), NoisySums(), equations.active, lastClass, t);
      const auto            row = static_cast<Eigen::Index>(t);
      const Eigen::VectorXd all = equations.gram.ldlt().solve(equations.right.row(row).transpose());
      const Eigen::Vector2d illumination = equations.illumination.ldlt().solve(equations.response.row(row).transpose());
      EXPECT_LT((all - expected).norm(), 1e-6 * expected.norm()) << t;
      EXPECT_LT((illumination - expected.head<2>()).norm(), 1e-6 * expected.norm()) << t;
    }
  }
}

TEST(SensorNoiseFrameEquations, FindsWhatNoiseFreeFramesAreMadeOf)
{
  const auto            changes = FlickerAndMotion(24, 100.0, 0.3);
  const SyntheticFrames frames(Width, Height, changes);
  const FrameEquations  equations = MakeFrameEquations(frames.Sums(), {}, LastClass);
  ASSERT_EQ(equations.active.size(), FrameColumns);
  for (std::size_t t = 0; t < changes.size(); ++t)
  {
    const Eigen::VectorXd fit =
      equations.gram.ldlt().solve(equations.right.row(static_cast<Eigen::Index>(t)).transpose());
    const FrameChange & change = changes[t];
    EXPECT_NEAR(fit(0), change.level + change.slope * frames.model.centreDn, 1e-4) << t;
    EXPECT_NEAR(fit(1), change.slope, 1e-7) << t;
    for (std::size_t k = 0; k < NumberOfStencils; ++k)
    {
      EXPECT_NEAR(fit(static_cast<Eigen::Index>(2 + k)), change.motion[k], 3e-5) << t << ' ' << k;
    }
  }
}

TEST(SensorNoiseFrameEquations, MotionIsPartialledOutOfTheIllumination)
{
  // The Schur complement is the inverse of the block of the illumination in the inverse matrix.
  const FrameEquations equations = MakeFrameEquations(NoisySums(), SomeNoise(), LastClass);
  ASSERT_GT(equations.active.size(), 2u);
  const Eigen::Matrix2d expected = equations.gram.inverse().topLeftCorner<2, 2>().inverse();
  EXPECT_LT((equations.illumination - expected).norm(), 1e-9 * expected.norm());
}

TEST(SensorNoiseFrameEquations, NoiseOfTheRegressorsIsSubtractedFromTheGramMatrix)
{
  // White noise of variance V / T in the mean adds the inner products of the stencils; the mean is a stencil of one
  // pixel.
  const RegressorNoise       noise = SomeNoise();
  const std::vector<Stencil> own{ { "", 0, StencilTaps() }, { "1", 0, StencilTaps(StencilTap{ 0, 0, 1.0 }) } };
  for (const std::size_t last : { std::size_t{ 3 }, LastClass })
  {
    const FrameEquations  equations = MakeFrameEquations(NoisySums(), noise, last);
    const Eigen::MatrixXd taken = equations.rawGram - equations.gram;
    for (std::size_t i = 0; i < equations.active.size(); ++i)
    {
      for (std::size_t j = 0; j < equations.active.size(); ++j)
      {
        const auto stencil = [&](std::size_t column) {
          return column < 2 ? own[column] : MotionStencils()[column - 2];
        };
        const double product = InnerProduct(stencil(equations.active[i]), stencil(equations.active[j]));
        EXPECT_NEAR(taken(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                    SumUpTo(noise.variance, last) / 24.0 * product,
                    1e-9 * equations.rawGram.norm())
          << i << ' ' << j;
      }
    }
  }
}

TEST(SensorNoiseFrameEquations, FlickeringNoiseIsSubtractedFromTheRightHandSide)
{
  const RegressorNoise noise = SomeNoise();
  std::vector<double>  gamma;
  for (std::size_t t = 0; t < 24; ++t)
  {
    gamma.push_back(0.1 * std::sin(static_cast<double>(t)));
  }
  const std::size_t    last = 4;
  const FrameEquations with = MakeFrameEquations(NoisySums(), noise, last, gamma);
  const FrameEquations without = MakeFrameEquations(NoisySums(), noise, last);
  ASSERT_EQ(with.active, without.active);
  for (std::size_t t = 0; t < gamma.size(); ++t)
  {
    for (std::size_t k = 0; k < with.active.size(); ++k)
    {
      const auto   row = static_cast<Eigen::Index>(t);
      const auto   column = static_cast<Eigen::Index>(k);
      const double expected = gamma[t] * CentreWeightOf(with.active[k]) * SumUpTo(noise.shot, last) / 24.0;
      EXPECT_NEAR(without.right(row, column) - with.right(row, column),
                  expected,
                  1e-13 * without.right.cwiseAbs().maxCoeff() + 1e-12)
        << t << ' ' << k;
    }
  }
}

TEST(SensorNoiseFrameEquations, MotionThatIsNotThereIsEliminated)
{
  const auto activeOf = [](std::size_t frames, double motion) {
    const SyntheticFrames noisy(Width, Height, FlickerAndMotion(frames, 100.0, motion), 1.0);
    return MakeFrameEquations(noisy.Sums(), {}, LastClass).active;
  };
  const auto largestOrder = [](const std::vector<std::size_t> & active) {
    int largest = 0;
    for (const std::size_t column : active)
    {
      largest = std::max(largest, column < 2 ? 0 : MotionStencils()[column - 2].order);
    }
    return largest;
  };
  EXPECT_EQ(activeOf(24, 0.0), (std::vector<std::size_t>{ 0, 1, 2 + StencilX, 2 + StencilY }));
  EXPECT_EQ(largestOrder(activeOf(24, 0.3)), 3);
  EXPECT_EQ(largestOrder(activeOf(19, 0.3)), 2); // fewer than 20 frames
}

TEST(SensorNoiseFrameEquations, MotionThatIsLostInTheNoiseOfTheMeanIsNotActive)
{
  RegressorNoise noise;
  // More than the whole energy of the x derivative.
  noise.variance[0] = 24.0 * NoisySums().GetClassGram(0)(2, 2) / InnerProduct(MotionStencils()[0], MotionStencils()[0]);
  const FrameEquations equations = MakeFrameEquations(NoisySums(), noise, 0);
  EXPECT_FALSE(equations.Find(2 + StencilX));
  EXPECT_EQ(equations.Find(0), 0u);
  EXPECT_EQ(equations.Find(1), 1u);
}

TEST(SensorNoiseFrameEquations, OneIntensityLeavesTheIlluminationUnchanged)
{
  // No derivative is active, and the mean is a multiple of 1: there is nothing to eliminate.
  const std::size_t         pixels = Width * Height;
  const std::vector<double> mean(pixels, 500.0);
  const ReferenceFrame      frame = MakeReferenceFrame(
    mean, std::vector<double>(pixels, 50.0), std::vector<std::uint8_t>(pixels, 1), { Width, Height, 1 }, 24);
  InitialNoiseModel model;
  model.interceptDn2 = 30.0;
  model.centreDn = 200.0;
  const std::vector<float> ones(pixels, 1.0F);
  ShiftInstruments         instruments{ ones, ones, ones };
  FrameSums                sums(FrameRegressors(frame, model, frame.usable, std::move(instruments)));
  for (std::size_t t = 0; t < 24; ++t)
  {
    sums.AddFrames(mean.data(), t, 1, SerialFor);
  }
  const FrameEquations equations = MakeFrameEquations(sums, {}, LastClass);
  EXPECT_EQ(equations.active, (std::vector<std::size_t>{ 0, 1 }));
  // The regressors 1 and mean - centre are 1 and 300.
  EXPECT_NEAR(equations.illumination.determinant(), 0.0, 1e-12 * equations.illumination.squaredNorm());
  EXPECT_NEAR(equations.illumination(0, 1), 300.0 * equations.illumination(0, 0), 1e-6 * equations.illumination(0, 1));
}
