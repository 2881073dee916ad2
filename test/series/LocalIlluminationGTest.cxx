// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/LocalIllumination.h"
#include "base/Eigen.h"
#include "series/FrameEquations.h"
#include "series/FrameSums.h"
#include "helpers/FrameTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 96;
constexpr std::size_t Height = 80;
constexpr std::size_t Frames = 50;
constexpr std::size_t Most = 8;
constexpr double      Offset = 100.0;

Eigen::VectorXd
Normal(std::size_t seed)
{
  std::mt19937               random(static_cast<unsigned int>(seed));
  std::normal_distribution<> normal;
  Eigen::VectorXd            series(static_cast<Eigen::Index>(Frames));
  for (Eigen::Index t = 0; t < series.size(); ++t)
  {
    series(t) = normal(random);
  }
  return series;
}

/** Flicker of 5 %, and two light sources that illuminate the left and the lower part. */
struct Factors
{
  Eigen::VectorXd flicker = 0.05 * Normal(1);
  Eigen::VectorXd left = Normal(2);
  Eigen::VectorXd below = Normal(3);
};

LocalIllumination
Find(const SyntheticFrames & frames,
     const Factors &         factors,
     std::size_t             most = Most,
     const Eigen::MatrixXd & motion = {},
     double                  offsetDn = Offset)
{
  const FrameSums           sums = frames.Sums();
  const std::vector<double> gamma(factors.flicker.data(), factors.flicker.data() + Frames);
  const double              offset = offsetDn - sums.GetRegressors().GetModel().centreDn;
  const FrameEquations      equations = MakeFrameEquations(sums, {}, GradientClasses - 1);
  const MotionSeries        series = SolveMotion(equations, gamma, offset);
  return FindLocalIllumination(
    sums, series, motion.size() > 0 ? motion : Eigen::MatrixXd(series.coefficients), gamma, offset, most);
}

/** Returns frames with flicker, noise, and light sources of a relative amplitude. */
SyntheticFrames
Lit(const Factors & factors, double amplitude)
{
  std::vector<FrameChange> changes(Frames);
  for (std::size_t t = 0; t < Frames; ++t)
  {
    changes[t].slope = factors.flicker(static_cast<Eigen::Index>(t));
    changes[t].level = -Offset * changes[t].slope;
  }
  SyntheticFrames frames(Width, Height, changes, 1.0);
  for (std::size_t i = 0; i < frames.pixels.size(); ++i)
  {
    const auto        t = static_cast<Eigen::Index>(i / frames.Pixels());
    const std::size_t p = i % frames.Pixels();
    const double      x = static_cast<double>(p % Width) / Width;
    const double      y = static_cast<double>(p / Width) / Height;
    const double      illumination = factors.left(t) * (0.5 - x) + factors.below(t) * std::cos(6.0 * y);
    frames.pixels[i] += amplitude * illumination * (frames.reference.mean[p] - Offset);
  }
  return frames;
}

/** Returns the fraction of the centred \a series outside the span of the columns and the constant. */
double
Unexplained(const Eigen::VectorXd & series, const Eigen::MatrixXd & columns)
{
  const Eigen::MatrixXd basis = Orthonormalise(columns, columns.cols());
  const Eigen::VectorXd centred = series.array() - series.mean();
  return (centred - basis * (basis.transpose() * centred)).squaredNorm() / centred.squaredNorm();
}
} // namespace

TEST(SensorNoiseLocalIllumination, TwoSimulatedSourcesAreFound)
{
  const Factors factors;
  const auto    found = Find(Lit(factors, 0.01), factors);
  ASSERT_EQ(found.series.cols(), 2);
  EXPECT_EQ(found.series.rows(), static_cast<Eigen::Index>(Frames));
  EXPECT_GT(found.excess, 2.0);
  // The components of the light sources are found within the noise, together with the global flicker.
  Eigen::MatrixXd columns(Frames, 3);
  columns << factors.flicker, found.series;
  EXPECT_LT(Unexplained(factors.left, columns), 0.01);
  EXPECT_LT(Unexplained(factors.below, columns), 0.01);
  EXPECT_GT(Unexplained(Normal(99), columns), 0.5);
}

TEST(SensorNoiseLocalIllumination, NothingIsFoundInNoise)
{
  for (std::size_t seed = 1; seed <= 10; ++seed)
  {
    Factors factors;
    factors.flicker = 0.05 * Normal(100 * seed);
    const auto found = Find(Lit(factors, 0.0), factors);
    EXPECT_EQ(found.series.cols(), 0) << seed;
    EXPECT_LT(found.excess, 1.0) << seed;
    EXPECT_GT(found.excess, 0.5) << seed; // the edge of the noise is measured, not only bounded
  }
}

// Bright frames have more noise than dark frames. This is not taken for a second light source, and does not hide one.
TEST(SensorNoiseLocalIllumination, StrongChangesOfIlluminationAreNotLocal)
{
  Factors factors;
  for (Eigen::Index t = 0; t < factors.flicker.size(); ++t)
  {
    factors.flicker(t) = t % 4 == 3 ? 2.12 : -0.68;
  }
  factors.flicker.array() -= factors.flicker.mean();
  for (const double amplitude : { 0.0, 0.02 })
  {
    SyntheticFrames            frames = Lit(factors, amplitude);
    std::mt19937               random(5);
    std::normal_distribution<> normal;
    for (std::size_t i = 0; i < frames.pixels.size(); ++i)
    {
      // Adds the missing noise of the frame to the variance 30 + 0.5 (mean - darkest). For dark frames none is removed.
      const auto   t = static_cast<Eigen::Index>(i / frames.Pixels());
      const double signal = frames.reference.mean[i % frames.Pixels()] - Offset;
      frames.pixels[i] += std::sqrt(0.5 * (1.0 + factors.flicker(t)) * signal) * normal(random);
    }
    EXPECT_EQ(Find(frames, factors).series.cols(), amplitude > 0.0 ? 2 : 0) << amplitude;
  }
}

TEST(SensorNoiseLocalIllumination, NoMoreSeriesThanAskedForTheStrongestFirst)
{
  Factors factors;
  factors.below *= 0.3;
  const auto frames = Lit(factors, 0.02);
  const auto found = Find(frames, factors, 1);
  ASSERT_EQ(found.series.cols(), 1);
  Eigen::MatrixXd columns(Frames, 2);
  columns << factors.flicker, found.series;
  EXPECT_LT(Unexplained(factors.left, columns), Unexplained(factors.below, columns));
  EXPECT_EQ(Find(frames, factors, 0).series.cols(), 0);
}

TEST(SensorNoiseLocalIllumination, ComponentsThatResembleMotionAreNotIllumination)
{
  const Factors   factors;
  Eigen::MatrixXd motion(Frames, 2);
  motion << factors.left, factors.below;
  EXPECT_EQ(Find(Lit(factors, 0.01), factors, Most, motion).series.cols(), 0);
}

TEST(SensorNoiseLocalIllumination, OneSeriesOfUnequalSizeIsUneven)
{
  // The flicker of 5 % increases by a fifth from the left to the right: 0.2 / sqrt(12) rms.
  const Factors   factors;
  SyntheticFrames frames = Lit(factors, 0.0);
  for (std::size_t i = 0; i < frames.pixels.size(); ++i)
  {
    const double      flicker = factors.flicker(static_cast<Eigen::Index>(i / frames.Pixels()));
    const std::size_t p = i % frames.Pixels();
    const double      x = static_cast<double>(p % Width) / Width;
    frames.pixels[i] += 0.2 * flicker * (x - 0.5) * (frames.reference.mean[p] - Offset);
  }
  const auto found = Find(frames, factors);
  EXPECT_EQ(found.series.cols(), 0); // there is no further series
  EXPECT_TRUE(found.IsLocal());
  EXPECT_NEAR(found.unevenness.size, 0.2 / std::sqrt(12.0), 0.015);
}

TEST(SensorNoiseLocalIllumination, UniformFlickerIsNotUnevenAboutAWrongOffset)
{
  const Factors factors;
  const auto    right = Find(Lit(factors, 0.0), factors);
  EXPECT_FALSE(right.IsLocal());
  EXPECT_LT(right.unevenness.size, 0.01);
  const auto wrong = Find(Lit(factors, 0.0), factors, Most, {}, Offset - 30.0);
  EXPECT_FALSE(wrong.IsLocal());
}

TEST(SensorNoiseLocalIllumination, ShortBurstsAndFewCellsGiveNothing)
{
  const Factors            factors;
  std::vector<FrameChange> changes(5);
  const SyntheticFrames    burst(Width, Height, changes, 1.0);
  const FrameSums          sums = burst.Sums();
  MotionSeries             noMotion;
  noMotion.coefficients.resize(5, 0);
  const auto none = FindLocalIllumination(sums,
                                          noMotion,
                                          Eigen::MatrixXd(5, 0),
                                          std::vector<double>(5, 0.0),
                                          Offset - sums.GetRegressors().GetModel().centreDn,
                                          Most);
  EXPECT_EQ(none.series.cols(), 0);
  EXPECT_EQ(none.series.rows(), 5);
}

TEST(SensorNoiseLocalIllumination, MedianNoiseEigenvalueAgreesWithASimulation)
{
  std::mt19937               random(61);
  std::normal_distribution<> normal;
  constexpr Eigen::Index     longer = 200;
  constexpr int              repeats = 10;
  for (const Eigen::Index shorter : { 20, 100, 200 })
  {
    double mean = 0.0;
    for (int repeat = 0; repeat < repeats; ++repeat)
    {
      Eigen::MatrixXd noise(longer, shorter);
      for (Eigen::Index i = 0; i < noise.size(); ++i)
      {
        noise(i) = normal(random);
      }
      const Eigen::MatrixXd gram = noise.transpose() * noise / static_cast<double>(longer);
      const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram, Eigen::EigenvaluesOnly).eigenvalues();
      mean += 0.5 * (values(shorter / 2 - 1) + values(shorter / 2)) / repeats;
    }
    const double expected = MedianNoiseEigenvalue(static_cast<double>(shorter) / longer);
    EXPECT_NEAR(mean / expected, 1.0, 0.03) << shorter; // 5 standard deviations of the mean, and 1 / 200
  }
}
