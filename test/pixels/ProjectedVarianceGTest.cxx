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
  ASSERT_EQ(Basis().NumberOfIlluminationFactors(), Light);
  const Eigen::MatrixXd series = NormalSeries();
  Input                 input(series);
  ProjectedVariance     projected = input.Project();
  projected.Compute(0.0);
  Eigen::MatrixXd design(Frames, 4);
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
  const Eigen::MatrixXd series = NormalSeries();
  Input                 input(series);
  ProjectedVariance     expected = input.Project();
  expected.Compute(0.0);
  // Every pixel has another response, up to ten times its noise, to temporal components in the span of the basis.
  Eigen::MatrixXd responses(3, Pixels);
  for (Eigen::Index i = 0; i < responses.size(); ++i)
  {
    responses(i) = 1000.0 * std::sin(static_cast<double>(i));
  }
  Input             waving(series + Basis().GetBasis() * responses);
  ProjectedVariance projected = waving.Project();
  projected.Compute(0.0);
  Input             rounded(series + Wave(2.0, 0.3) * responses.row(0)); // known with 20 bits only
  ProjectedVariance nearly = rounded.Project();
  nearly.Compute(0.0);
  for (std::size_t p = 0; p < Pixels; ++p)
  {
    const double variance = expected.GetVariance()[p];
    ASSERT_NEAR(projected.GetVariance()[p], variance, 1e-8) << p; // rounding of squares of 1e7
    ASSERT_NEAR(nearly.GetVariance()[p], variance, 1e-4 * variance) << p;
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
    const double share = 1.0 - 1.0 / Frames - q.row(t).squaredNorm();
    expectedRss += (variance + gain * q.row(t).dot(responses)) * share;
  }
  // Noise with exactly this sum of squares, orthogonal to the basis and to the constant, plus the signal.
  Eigen::VectorXd noise = NormalSeries().col(0);
  noise.array() -= noise.mean();
  noise -= q * (q.transpose() * noise);
  noise *= std::sqrt(expectedRss) / noise.norm();
  Input             input((noise + q * responses).replicate(1, Pixels));
  ProjectedVariance projected = input.Project();
  projected.Compute(gain);
  EXPECT_NEAR(projected.GetVariance()[5 * Width + 7], variance, 1e-4);
}

TEST(SensorNoiseProjectedVariance, LeverageOfTheMotionCostsDegreesOfFreedom)
{
  Input input(NormalSeries());
  input.motion.stencils = { StencilX, StencilYY };
  input.motion.coefficients.setZero(Frames, 2);
  input.motion.inverseGram.resize(2, 2);
  input.motion.inverseGram << 2e-4, 5e-5, 5e-5, 3e-4;
  const ProjectedVariance projected = input.Project();
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
  const ProjectedVariance projected = input.Project();
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
  ProjectedVariance     expected = input.Project();
  ProjectedVariance     projected = other.Project(Threads(3));
  expected.Compute(1.0);
  projected.Compute(1.0);
  EXPECT_TRUE(HaveSameBits(projected.GetVariance(), expected.GetVariance()));
  EXPECT_TRUE(HaveSameBits(projected.GetDof(), expected.GetDof()));
}
