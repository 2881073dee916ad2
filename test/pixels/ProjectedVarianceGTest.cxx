// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ProjectedVariance.h"
#include "base/Eigen.h"
#include "base/Stencils.h"
#include "helpers/ProjectionTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::projection;

namespace
{
double
DofWithoutMotion()
{
  return static_cast<double>(Frames - 1 - Basis().Size());
}
} // namespace

TEST(SensorNoiseProjectedVariance, IsTheExplicitResidualOverItsDegreesOfFreedom)
{
  ASSERT_EQ(Basis().Size(), 3u);
  ASSERT_EQ(Basis().NumberOfIlluminationFactors(), IlluminationFactors);
  const Eigen::MatrixXd   series = NormalSeries();
  Input                   input(series);
  const ProjectedSquares  squares = input.Project();
  const ProjectedVariance projected(squares, 0.0);
  Eigen::MatrixXd         design(Frames, 4);
  design << Eigen::VectorXd::Ones(Frames), Basis().GetBasis();
  const Eigen::MatrixXd rest = series - design * design.householderQr().solve(series);
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    const double rss = rest.col(static_cast<Eigen::Index>(p)).squaredNorm();
    if (input.mask[p] != 0)
    {
      ASSERT_EQ(projected.GetDof()[p], Frames - 1 - 3);
      // The rounding of sums of 30 values of 1,000, in squares of 20^2: 1e-16 30 1000 / 20.
      ASSERT_NEAR(projected.GetVariance()[p], rss / (Frames - 1 - 3), 1e-11 * rss) << p;
    }
    else
    {
      ASSERT_EQ(projected.GetVariance()[p], 0.0);
    }
  }
}

TEST(SensorNoiseProjectedVariance, WhatTheBasisSpansIsRemovedExactly)
{
  const Eigen::MatrixXd  series = NormalSeries();
  Input                  input(series);
  const ProjectedSquares expected = input.Project();
  // Every pixel has another response, up to ten times its noise, to temporal components in the span of the basis.
  Eigen::MatrixXd responses(3, Pixels);
  for (Eigen::Index i = 0; i < responses.size(); ++i)
  {
    responses(i) = 1000.0 * std::sin(static_cast<double>(i));
  }
  Input                  waving(series + Basis().GetBasis() * responses);
  const ProjectedSquares projected = waving.Project();
  Input                  rounded(series + Wave(2.0, 0.3) * responses.row(0)); // known with 20 bits only
  const ProjectedSquares nearly = rounded.Project();
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    const double variance = expected.VarianceAt(0.0)[p];
    ASSERT_NEAR(projected.VarianceAt(0.0)[p], variance, 1e-8) << p; // rounding of squares of 1e7
    ASSERT_NEAR(nearly.VarianceAt(0.0)[p], variance, 1e-4 * variance) << p;
  }
}

TEST(SensorNoiseProjectedVariance, ExpectedVarianceOfFlickeringNoiseIsUnbiased)
{
  // A pixel with the signal level + sum_i S_i Q_ti has the variance V_t = V + g sum_i S_i Q_ti. The expectation of RSS
  // is sum_t V_t P_tt, with P the projection onto the residuals. Corrected by the second term it is V times the degrees
  // of freedom.
  const Eigen::MatrixXd & q = Basis().GetBasis();
  const Eigen::Vector3d   responses(30.0, -11.0, 7.0);
  constexpr double        gain = 2.0;
  constexpr double        variance = 500.0;
  double                  expectedRss = 0.0;
  for (Eigen::Index t = 0; t < q.rows(); ++t)
  {
    const double remaining = 1.0 - 1.0 / Frames - q.row(t).squaredNorm();
    expectedRss += (variance + gain * q.row(t).dot(responses)) * remaining;
  }
  // Noise with exactly this sum of squares, orthogonal to the basis and to the constant, plus the signal.
  Eigen::VectorXd noise = NormalSeries().col(0);
  noise.array() -= noise.mean();
  noise -= q * (q.transpose() * noise);
  noise *= std::sqrt(expectedRss) / noise.norm();
  Input                  input((noise + q * responses).replicate(1, Pixels));
  const ProjectedSquares projected = input.Project();
  EXPECT_NEAR(projected.VarianceAt(gain)[5 * Width + 7], variance, 1e-4);
}

TEST(SensorNoiseProjectedVariance, LeverageOfTheMotionCostsDegreesOfFreedom)
{
  Input input(NormalSeries());
  input.motion.stencils = { StencilX, StencilYY };
  input.motion.coefficients.setZero(Frames, 2);
  input.motion.inverseGram.resize(2, 2);
  input.motion.inverseGram << 2e-4, 5e-5, 5e-5, 3e-4;
  const ProjectedSquares  squares = input.Project();
  const ProjectedVariance projected(squares, 0.0);
  double                  largest = 0.0;
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    if (input.mask[p] != 0)
    {
      const Eigen::Vector2d d(ApplyStencil(MotionStencils()[StencilX], input.frame.mean.data(), Width, p),
                              ApplyStencil(MotionStencils()[StencilYY], input.frame.mean.data(), Width, p));
      const double          leverage =
        d.dot(input.motion.inverseGram * d) / input.model.NoiseVariance(input.frame.neighbourMean[p]);
      ASSERT_LT(leverage, 0.5);
      ASSERT_NEAR(projected.GetDof()[p], DofWithoutMotion() * (1.0 - leverage), 1e-5 * DofWithoutMotion()) << p;
      largest = std::max(largest, leverage);
    }
  }
  EXPECT_GT(largest, 1e-3);
}

TEST(SensorNoiseProjectedVariance, RougherClassesHaveRougherSurroundings)
{
  Input                   input(NormalSeries());
  const ProjectedSquares  squares = input.Project();
  const ProjectedVariance projected(squares, 0.0);
  std::vector<double>     energy(ProjectedVariance::Classes, 0.0);
  std::vector<double>     count(ProjectedVariance::Classes, 0.0);
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    if (input.mask[p] != 0)
    {
      ASSERT_LT(projected.ClassOf(p), ProjectedVariance::Classes);
      const double x = ApplyStencil(MotionStencils()[StencilX], input.frame.mean.data(), Width, p);
      const double y = ApplyStencil(MotionStencils()[StencilY], input.frame.mean.data(), Width, p);
      energy[projected.ClassOf(p)] += (x * x + y * y) / input.model.NoiseVariance(input.frame.neighbourMean[p]);
      count[projected.ClassOf(p)] += 1.0;
    }
  }
  const auto meanOf = [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    double pixels = 0.0;
    for (std::size_t c = first; c <= last; ++c)
    {
      sum += energy[c];
      pixels += count[c];
    }
    EXPECT_GT(pixels, 0.0);
    return sum / pixels;
  };
  EXPECT_LT(meanOf(0, 7), meanOf(8, 15));
  EXPECT_LT(meanOf(8, 15), meanOf(16, 23));
}

TEST(SensorNoiseProjectedVariance, ThreadsChangeNoBit)
{
  const Eigen::MatrixXd series = NormalSeries();
  Input                 input(series);
  Input                 other(series);
  ProjectedSquares      expected = input.Project();
  ProjectedSquares      projected = other.Project(Threads(3));
  EXPECT_TRUE(HaveSameBits(projected.GetDivisor(), expected.GetDivisor()));
  EXPECT_TRUE(HaveSameBits(std::move(projected).TakeVarianceAt(1.0).TakeDoubles(),
                           std::move(expected).TakeVarianceAt(1.0).TakeDoubles()));
}

TEST(SensorNoiseProjectedVariance, IsAFunctionOfTheGainAndOfTheRatios)
{
  Input                   input(NormalSeries());
  ProjectedSquares        squares = input.Project();
  const ProjectedVariance plain(squares, 0.0);
  VarianceLine            line;
  line.gain = 2.0;
  const ProjectedVariance corrected = plain.WithLine(line);
  const ProjectedVariance divided = corrected.WithRatios(std::vector<float>(Pixels, 4.0F));
  std::vector<double>     filled(Pixels);
  divided.GetVariance().Fill(0, Pixels, filled.data());
  double largest = 0.0;
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    const double rise = 2.0 * static_cast<double>(squares.GetPerGain()[p]);
    largest = std::max(largest, std::abs(rise));
    ASSERT_EQ(corrected.GetVariance()[p], plain.GetVariance()[p] + rise) << p;
    ASSERT_EQ(divided.GetVariance()[p], corrected.GetVariance()[p] / 4.0) << p;
    ASSERT_EQ(filled[p], divided.GetVariance()[p]) << p;
    ASSERT_EQ(corrected.WithLine({}).GetVariance()[p], plain.GetVariance()[p]) << p;
  }
  EXPECT_GT(largest, 0.1); // the correction is no rounding error
  EXPECT_FALSE(corrected.HasRatios());
  EXPECT_TRUE(divided.WithLine({}).HasRatios());
  const double              first = corrected.GetVariance()[5 * Width + 7];
  const std::vector<double> taken = std::move(squares).TakeVarianceAt(2.0).TakeDoubles();
  EXPECT_EQ(taken[5 * Width + 7], first);
}

TEST(SensorNoiseProjectedVariance, ReplacedSquaresHaveTheirOwnDegreesOfFreedom)
{
  Input                  input(NormalSeries());
  Input                  other(NormalSeries());
  const ProjectedSquares plain = input.Project();
  const std::size_t      p = 5 * Width + 7;
  const double           half = 0.5 * DofWithoutMotion();
  ResidualSquares        rest;
  PixelCoordinates       none;
  AppendResidualSquares(other.frame, Basis(), other.sums, SerialFor, rest, none);
  QuantisationNoise quantisation; // a remainder of 3 DN^2 at every level
  quantisation.remaindersDn2 = { 3.0, 3.0 };
  const ProjectedSquares replaced(other.frame,
                                  Basis(),
                                  other.motion,
                                  std::move(rest),
                                  other.model,
                                  other.mask,
                                  SerialFor,
                                  {},
                                  { { p }, { 400.0 * half }, half },
                                  quantisation);
  EXPECT_NEAR(replaced.GetDivisor()[p], half, 1e-5 * half);
  EXPECT_NEAR(replaced.VarianceAt(0.0)[p], 400.0 - 3.0, 1e-4);
  EXPECT_NEAR(replaced.GetPerGain()[p], 2.0 * plain.GetPerGain()[p], 1e-5 * std::abs(plain.GetPerGain()[p]));
  EXPECT_NEAR(replaced.VarianceAt(0.0)[p + 1], plain.VarianceAt(0.0)[p + 1] - 3.0, 1e-9);
  EXPECT_EQ(replaced.VarianceAt(0.0)[0], 0.0); // outside of the mask
}
