// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/OffsetLine.h"
#include "base/ChiSquare.h"
#include "base/Eigen.h"
#include "series/FrameEquations.h"
#include "series/FrameSums.h"
#include "series/SceneSeries.h"
#include "helpers/FrameTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <random>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
/** Returns equations without motion: response = illumination (a_t, d_t)' + noise with the covariance `light`. */
FrameEquations
EquationsOf(std::size_t frames, double offset, double flicker, double noise, double drift = 0.0)
{
  std::mt19937               random(31);
  std::normal_distribution<> normal;
  FrameEquations             equations;
  equations.illumination << 4000.0, 90000.0, 90000.0, 9e6;
  const Eigen::Matrix2d factor = equations.illumination.llt().matrixL();
  equations.response.resize(static_cast<Eigen::Index>(frames), 2);
  for (Eigen::Index t = 0; t < equations.response.rows(); ++t)
  {
    const double          gamma = flicker * normal(random);
    const Eigen::Vector2d change(-offset * gamma + drift * normal(random), gamma);
    const Eigen::Vector2d white(normal(random), normal(random));
    equations.response.row(t) = equations.illumination * change + noise * factor * white;
  }
  return equations;
}

/** Returns J(m) by its definition. */
double
Profile(const FrameEquations & equations, double m)
{
  const Eigen::Vector2d v(-m, 1.0);
  double                sum = 0.0;
  for (Eigen::Index t = 0; t < equations.response.rows(); ++t)
  {
    sum += std::pow(v.dot(equations.response.row(t)), 2);
  }
  return sum / v.dot(equations.illumination * v);
}

/** Returns the maximiser of J, from a grid that is refined step by step. */
double
BruteForceMaximum(const FrameEquations & equations)
{
  double low = -1e4;
  double high = 1e4;
  double best = 0.0;
  for (int round = 0; round < 12; ++round)
  {
    const double step = (high - low) / 1000.0;
    double       largest = -1.0;
    for (int i = 0; i <= 1000; ++i)
    {
      const double value = Profile(equations, low + i * step);
      if (value > largest)
      {
        largest = value;
        best = low + i * step;
      }
    }
    low = best - 20.0 * step;
    high = best + 20.0 * step;
  }
  return best;
}
} // namespace

TEST(SensorNoiseOffsetLine, ExactLineIsRecovered)
{
  const FrameEquations equations = EquationsOf(30, 250.0, 0.05, 0.0);
  const auto           line = FitOffsetLine(equations);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->offset, 250.0, 1e-7);
  EXPECT_NEAR(line->phi, 0.0, 1e-7);
  ASSERT_EQ(line->gamma.size(), 30u);
  for (Eigen::Index t = 0; t < 30; ++t)
  {
    // response = illumination (-mu, 1)' gamma_t
    const Eigen::Vector2d own = equations.illumination.ldlt().solve(equations.response.row(t).transpose());
    EXPECT_NEAR(line->gamma[static_cast<std::size_t>(t)], own(1), 1e-10);
  }
}

TEST(SensorNoiseOffsetLine, OffsetMaximisesTheProfileLikelihood)
{
  for (const double flicker : { 0.001, 0.02 })
  {
    const FrameEquations equations = EquationsOf(25, -40.0, flicker, 1.0, 0.05);
    const auto           line = FitOffsetLine(equations);
    ASSERT_TRUE(line);
    // The maximum is flat: the maximiser is known within the root of the precision of J.
    EXPECT_NEAR(line->offset, BruteForceMaximum(equations), 1e-6 * line->standardError + 1e-5) << flicker;
    for (const double distance : { -1e5, -300.0, -1.0, 1.0, 300.0, 1e5 })
    {
      EXPECT_GT(Profile(equations, line->offset), Profile(equations, line->offset + distance)) << distance;
    }
  }
}

TEST(SensorNoiseOffsetLine, IntervalIsWhereTheProfileIsHighEnough)
{
  for (const double drift : { 0.0, 0.5 }) // a drift makes phi much larger than 1
  {
    const FrameEquations equations = EquationsOf(40, 100.0, 0.02, 1.0, drift);
    const auto           line = FitOffsetLine(equations);
    ASSERT_TRUE(line);
    EXPECT_EQ(line->phi > 2.0, drift > 0.0) << line->phi;
    ASSERT_TRUE(std::isfinite(line->low) && std::isfinite(line->high));
    EXPECT_LT(line->low, line->offset);
    EXPECT_GT(line->high, line->offset);
    const double top = Profile(equations, line->offset);
    const double drop = std::pow(StudentQuantile(0.975, 38.0), 2) * line->Widening();
    EXPECT_NEAR(Profile(equations, line->low), top - drop, 0.01 * drop) << drift;
    EXPECT_NEAR(Profile(equations, line->high), Profile(equations, line->low), 1e-9 * top) << drift;
    EXPECT_NEAR(line->high - line->low,
                2.0 * StudentQuantile(0.975, 38.0) * line->standardError,
                0.2 * (line->high - line->low)); // J is nearly a parabola
  }
}

TEST(SensorNoiseOffsetLine, DispersionIsWhatTheLineLeaves)
{
  for (const double drift : { 0.0, 0.5 })
  {
    const FrameEquations equations = EquationsOf(40, 100.0, 0.02, 1.0, drift);
    const auto           line = FitOffsetLine(equations);
    ASSERT_TRUE(line);
    // sum_t r' G^-1 r is the fit with free a_t and d_t, and J(m) is the fit with the line.
    const double all = (equations.response * equations.illumination.inverse() * equations.response.transpose()).trace();
    EXPECT_NEAR(line->phi, (all - Profile(equations, line->offset)) / 38.0, 1e-9 * all) << drift;
  }
}

TEST(SensorNoiseOffsetLine, IntervalIsUnboundedWhereNoDirectionStandsOut)
{
  // Noise alone, with the same strength in every direction: J(m) is constant.
  FrameEquations        equations = EquationsOf(40, 100.0, 0.0, 1.0);
  const Eigen::Matrix2d factor = equations.illumination.llt().matrixL();
  for (Eigen::Index t = 0; t < 40; ++t)
  {
    const double angle = 6.2831853071795865 * static_cast<double>(t) / 40.0;
    equations.response.row(t) = std::sqrt(2.0) * factor * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  const auto line = FitOffsetLine(equations);
  ASSERT_TRUE(line);
  EXPECT_TRUE(std::isinf(line->low) && line->low < 0.0);
  EXPECT_TRUE(std::isinf(line->high) && line->high > 0.0);
  EXPECT_LT(FitOffsetLine(EquationsOf(40, 100.0, 0.0, 1.0))->flickerZ, 6.0);
  EXPECT_GT(FitOffsetLine(EquationsOf(40, 100.0, 0.02, 1.0))->flickerZ, 6.0);
}

TEST(SensorNoiseOffsetLine, FollowsTheUnitsAndTheLevel)
{
  // mean -> mean + b: the regressors are (1, I + b). Matrix and responses of the illumination change by B = (1 0; b 1),
  // the offset by b.
  const FrameEquations equations = EquationsOf(30, 100.0, 0.02, 1.0);
  const auto           line = FitOffsetLine(equations);
  Eigen::Matrix2d      b;
  b << 1.0, 0.0, 700.0, 1.0;
  FrameEquations moved = equations;
  moved.illumination = b * equations.illumination * b.transpose();
  moved.response = equations.response * b.transpose();
  const auto shifted = FitOffsetLine(moved);
  ASSERT_TRUE(line && shifted);
  EXPECT_NEAR(shifted->offset, line->offset + 700.0, 1e-7);
  EXPECT_NEAR(shifted->low, line->low + 700.0, 1e-7);
  EXPECT_NEAR(shifted->standardError, line->standardError, 1e-7 * line->standardError);
  EXPECT_NEAR(shifted->phi, line->phi, 1e-9);
  for (std::size_t t = 0; t < 30; ++t)
  {
    EXPECT_NEAR(shifted->gamma[t], line->gamma[t], 1e-10);
  }
}

TEST(SensorNoiseOffsetLine, IsNullIfTheMatrixIsNotPositive)
{
  FrameEquations equations = EquationsOf(30, 100.0, 0.02, 1.0);
  equations.illumination << 1.0, 2.0, 2.0, 4.0 - 1e-9; // pixels of one intensity
  EXPECT_FALSE(FitOffsetLine(equations));
  equations = EquationsOf(30, 100.0, 0.02, 1.0);
  equations.response(3, 1) = std::nan("");
  EXPECT_FALSE(FitOffsetLine(equations));
}

TEST(SensorNoiseOffsetLine, FramesWithMotionLieOnOneLine)
{
  // With motion of all orders and no noise, over all gradient classes.
  const SyntheticFrames frames(70, 45, FlickerAndMotion(24, 120.0, 2.0));
  const FrameSums       sums = frames.Sums();
  const auto            line = FitOffsetLine(sums, {});
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->offset + sums.GetRegressors().GetModel().centreDn, 120.0, 1e-3);
  EXPECT_LT(line->lastClass, GradientClasses);
}

TEST(SensorNoiseOffsetLine, RampDeterminesTheFlickerAtAnyLevel)
{
  // Motion along a ramp changes all levels equally, as an offset does; motion across it changes nothing.
  for (const double across : { 0.0, 0.5, 2.0 })
  {
    const std::vector<FrameChange> changes = FlickerAndMotion(24, 0.0, 0.0);
    SyntheticFrames                frames(70, 45, changes);
    std::vector<double> &          mean = frames.reference.mean;
    for (std::size_t p = 0; p < mean.size(); ++p)
    {
      mean[p] = 400.0 + 15.0 * (static_cast<double>(p % 70) + across * static_cast<double>(p / 70));
    }
    FrameSums sums = frames.EmptySums();
    for (std::size_t t = 0; t < changes.size(); ++t)
    {
      std::vector<double> frame = mean;
      for (double & value : frame)
      {
        value += changes[t].slope * value + 10.0 * static_cast<double>(t % 5);
      }
      sums.AddFrames(frame.data(), t, 1, SerialFor);
    }
    const FrameEquations equations = MakeFrameEquations(sums, {}, GradientClasses - 1);
    EXPECT_TRUE(equations.isLevelMotion) << across;
    const std::vector<std::size_t> stronger{ 0, 1, 2 + (across > 1.0 ? StencilY : StencilX) };
    EXPECT_EQ(equations.active, stronger) << across;
    const auto line = FitOffsetLine(sums, {});
    ASSERT_TRUE(line) << across;
    EXPECT_TRUE(line->isLevelMotion) << across;
    EXPECT_FALSE(line->DeterminesOffset()) << across;
    for (std::size_t t = 0; t < changes.size(); ++t)
    {
      EXPECT_NEAR(line->gamma[t], changes[t].slope, 1e-6) << across << ' ' << t;
    }
  }
}

TEST(SensorNoiseOffsetLine, ClassesThatDisagreeAreSeen)
{
  // Flicker of a scene with the offset 120 DN. In the second burst, edges brighten with the illumination on top of it,
  // as where the optics settle with the lamp: their class has a higher offset.
  SyntheticFrames      frames(256, 192, FlickerAndMotion(24, 120.0, 0.0), 1.0);
  const RegressorNoise noise = NoiseOfModel(frames.EmptySums().GetRegressors());
  const auto           plain = FitOffsetLine(frames.Sums(), noise);
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->differenceOfClassesDn, 0.0);
  EXPECT_NEAR(plain->offset + frames.model.centreDn, 120.0, 4.0 * plain->standardError);

  const auto changes = FlickerAndMotion(24, 120.0, 0.0);
  for (std::size_t t = 0; t < changes.size(); ++t)
  {
    for (std::size_t p = 0; p < frames.Pixels(); ++p)
    {
      const bool   isInner = frames.take[p] != 0;
      const double energy =
        isInner ? std::pow(frames.Derivative(StencilX, p), 2) + std::pow(frames.Derivative(StencilY, p), 2) : 0.0;
      frames.pixels[t * frames.Pixels() + p] += energy > 1e4 ? 100.0 * changes[t].slope : 0.0;
    }
  }
  const auto line = FitOffsetLine(frames.Sums(), noise);
  ASSERT_TRUE(line);
  const double error = std::abs(line->offset + frames.model.centreDn - 120.0);
  EXPECT_GT(error, 6.0 * line->standardError);
  EXPECT_GT(line->differenceOfClassesDn, 0.5 * error);
}
