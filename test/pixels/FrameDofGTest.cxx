// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceLine.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "pixels/ProjectedVariance.h"
#include "series/LocalIllumination.h"
#include "series/SceneSeries.h"
#include "simulation/Random.h"
#include "helpers/ProjectionTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr Eigen::Index Frames = 60;
constexpr double       Left = 58.0; // degrees of freedom beside the mean and gamma

/** Returns gamma, the relative deviations of the illumination \a factors from their mean [1]. */
Eigen::VectorXd
GammaOf(const Eigen::VectorXd & factors)
{
  return factors.array() / factors.mean() - 1.0;
}

Eigen::VectorXd
EveryFourthLit()
{
  return GammaOf(Eigen::VectorXd::NullaryExpr(Frames, [](Eigen::Index t) { return t % 4 == 0 ? 1.0 : 0.0; }));
}

Eigen::VectorXd
Exponential()
{
  return GammaOf(Eigen::VectorXd::NullaryExpr(
    Frames, [](Eigen::Index t) { return -std::log1p(-(static_cast<double>(t) + 0.5) / Frames); }));
}

Eigen::VectorXd
Sine(double sd)
{
  return Eigen::VectorXd::NullaryExpr(Frames, [sd](Eigen::Index t) {
    return sd * std::sqrt(2.0) * std::sin(6.283185307179586 * 7.0 * static_cast<double>(t) / Frames);
  });
}

std::vector<double>
NumbersOf(const Eigen::VectorXd & series)
{
  return { series.data(), series.data() + series.size() };
}

FrameDof
DofOf(const Eigen::VectorXd & gamma)
{
  return { gamma.normalized(), NumbersOf(gamma) };
}

/** Returns the projection P onto the complement of the constant and gamma. */
Eigen::MatrixXd
ProjectorOf(const Eigen::VectorXd & gamma)
{
  const Eigen::VectorXd unit = gamma.normalized();
  Eigen::MatrixXd       projector = Eigen::MatrixXd::Identity(Frames, Frames) - unit * unit.transpose();
  projector.array() -= 1.0 / static_cast<double>(Frames);
  return projector;
}

/** Returns (tr P)^2 / tr M^2, the degrees of freedom, with M the covariance of the residuals. */
double
DenseDof(const Eigen::VectorXd & gamma, double fraction)
{
  const Eigen::MatrixXd projector = ProjectorOf(gamma);
  const Eigen::VectorXd variance = 1.0 + fraction * gamma.array();
  const Eigen::MatrixXd covariance = projector * variance.asDiagonal() * projector;
  return projector.trace() * projector.trace() / covariance.squaredNorm();
}
} // namespace

TEST(SensorNoiseFrameDof, OfTwoLevelsHasAClosedForm)
{
  // The basis fits the means of the 15 lit frames, of variance 1 + 3 b, and of the 45 others, of variance 1 - b.
  const FrameDof dof = DofOf(EveryFourthLit());
  EXPECT_FALSE(dof.IsEqual());
  for (const double b : { 0.0, 0.3, 0.9, 0.9885, 1.0 })
  {
    const double lit = 1.0 + 3.0 * b;
    const double dark = 1.0 - b;
    EXPECT_NEAR(Left * dof.DofFractionAt(b), Left * Left / (14.0 * lit * lit + 44.0 * dark * dark), 1e-9) << b;
  }
  EXPECT_NEAR(Left * dof.DofFractionAt(0.9885), 15.28, 0.005);
  EXPECT_NEAR(Left * dof.DofFractionAt(1.0), Left * Left / 224.0, 1e-9);
}

TEST(SensorNoiseFrameDof, IsTheTraceOfTheResidualsCovariance)
{
  for (const Eigen::VectorXd & gamma : { EveryFourthLit(), Exponential(), Sine(0.02), Sine(0.6) })
  {
    for (const double b : { 0.2, 0.7, 1.0 })
    {
      EXPECT_NEAR(Left * DofOf(gamma).DofFractionAt(b), DenseDof(gamma, b), 1e-9);
    }
  }
  EXPECT_NEAR(Left * DofOf(Exponential()).DofFractionAt(1.0), 32.69, 0.005);
}

TEST(SensorNoiseFrameDof, OfASmallFlickerIsThatOfEqualFrames)
{
  const FrameDof dof = DofOf(Sine(0.02));
  EXPECT_NEAR(Left * dof.DofFractionAt(1.0), 57.98, 0.005); // 58 / (1 + 0.02^2)
  EXPECT_TRUE(dof.IsEqual());
  EXPECT_FALSE(DofOf(Sine(0.11)).IsEqual());
  EXPECT_TRUE(FrameDof().IsEqual());
  EXPECT_EQ(FrameDof().DofFractionAt(1.0), 1.0);
}

TEST(SensorNoiseFrameDof, OneLitFrameLeavesEqualOnesThatAreNotLikeTheMean)
{
  const FrameDof dof =
    DofOf(Eigen::VectorXd::NullaryExpr(Frames, [](Eigen::Index t) { return t == 7 ? Frames - 1.0 : -1.0; }));
  for (const double b : { 0.0, 0.5, 0.99, 1.0 })
  {
    EXPECT_NEAR(dof.DofFractionAt(b), 1.0, 1e-9) << b;
  }
  EXPECT_FALSE(dof.IsEqual());
}

TEST(SensorNoiseFrameDof, FractionsOutsideOfTheirRangeAreTheNearest)
{
  const FrameDof dof = DofOf(EveryFourthLit());
  EXPECT_EQ(dof.DofFractionAt(-1.0), 1.0);
  EXPECT_EQ(dof.DofFractionAt(1.5), dof.DofFractionAt(1.0));
  EXPECT_EQ(dof.DofFractionAt(std::nan("")), 1.0);
}

TEST(SensorNoiseFrameDof, IsWhatSimulatedVariancesScatterBy)
{
  constexpr int       pixels = 20000;
  constexpr double    b = 0.9;
  CounterSeededRandom random(17);
  for (const Eigen::VectorXd & gamma : { EveryFourthLit(), Exponential() })
  {
    const Eigen::MatrixXd projector = ProjectorOf(gamma);
    const Eigen::VectorXd sd = (1.0 + b * gamma.array()).sqrt();
    double                sum = 0.0;
    double                squares = 0.0;
    for (int p = 0; p < pixels; ++p)
    {
      const Eigen::VectorXd noise =
        Eigen::VectorXd::NullaryExpr(Frames, [&](Eigen::Index t) { return sd(t) * random.Normal(); });
      const double rss = (projector * noise).squaredNorm();
      sum += rss;
      squares += rss * rss;
    }
    const double mean = sum / pixels;
    const double found = 2.0 * Left * Left / (squares / pixels - mean * mean);
    const double expected = Left * DofOf(gamma).DofFractionAt(b);
    // The variance of chi-square has the relative standard error sqrt((2 + 12/f) / pixels).
    EXPECT_NEAR(found / expected, 1.0, 4.0 * std::sqrt((2.0 + 12.0 / expected) / pixels));
  }
}

// Eight temporal components that are nonzero in the 15 lit frames only leave 6 residuals there, of variance 4 without
// read noise. They are 24 of the 50 in the divisor. The gain adds the remaining 26, which do not scatter.
TEST(SensorNoiseFrameDof, OfSeriesThatLiveInFewFramesCountsWhatTheGainPutsIn)
{
  const Eigen::VectorXd gamma = EveryFourthLit();
  Eigen::MatrixXd       columns(Frames, 9);
  columns.col(0) = gamma;
  CounterSeededRandom random(3);
  for (Eigen::Index j = 1; j < columns.cols(); ++j)
  {
    columns.col(j) =
      Eigen::VectorXd::NullaryExpr(Frames, [&](Eigen::Index t) { return gamma(t) > 0.0 ? random.Normal() : 0.0; });
  }
  const Eigen::MatrixXd basis = Orthonormalise(columns, Frames);
  EXPECT_NEAR(50.0 * FrameDof(basis, NumbersOf(gamma)).DofFractionAt(1.0), 50.0 * 50.0 / (6.0 * 16.0), 1e-9);
}

TEST(SensorNoiseFrameDof, ChangesHowPreciseAPixelIsAndNotItsVariance)
{
  projection::Input      input(projection::NormalSeries());
  projection::Input      other(projection::NormalSeries());
  const Eigen::Index     frames = projection::Frames;
  const Eigen::VectorXd  gamma = 0.3 * std::sqrt(static_cast<double>(frames)) * projection::Basis().GetBasis().col(0);
  const ProjectedSquares equal = input.Project();
  const ProjectedSquares unequal = other.Project(SerialFor, { NumbersOf(gamma), 100.0 });
  EXPECT_FALSE(equal.HasUnequalNoise());
  EXPECT_TRUE(unequal.HasUnequalNoise());
  const std::vector<float> & divisor = unequal.GetDivisor();
  EXPECT_EQ(divisor, equal.GetDivisor());
  EXPECT_EQ(ProjectedVariance(equal, 0.0).GetDof(), divisor);
  VarianceLine line;
  line.gain = 2.0;
  line.intercept = -150.0; // a variance of 50 DN^2 at the offset
  const ProjectedVariance projected = ProjectedVariance(unequal, 0.0).WithLine(line);
  const FrameDof          dof(projection::Basis().GetBasis(), NumbersOf(gamma));
  for (std::size_t p = 0; p < projection::Pixels; ++p)
  {
    if (input.mask[p] != 0)
    {
      const double shot = 2.0 * (input.frame.neighbourMean[p] - 100.0);
      ASSERT_NEAR(projected.GetDof()[p], divisor[p] * dof.DofFractionAt(shot / (shot + 50.0)), 1e-4) << p;
      ASSERT_EQ(projected.GetVariance()[p], equal.VarianceAt(2.0)[p]) << p;
    }
  }
}
