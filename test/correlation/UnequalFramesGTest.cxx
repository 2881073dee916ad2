// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseResiduals.h"
#include "base/Eigen.h"
#include "correlation/ProcessingSigns.h"
#include "correlation/NoiseCorrelation.h"
#include "simulation/Random.h"
#include "helpers/CorrelationTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::correlation;

namespace
{
constexpr FrameGeometry Geometry{ 256, 256, 1 };
constexpr Eigen::Index  Frames = 20;
constexpr double        Gain = 0.5;
constexpr double        ReadNoiseDn2 = 9.0;

/** Returns gamma of an illumination that decreases exponentially to a tenth. */
Eigen::VectorXd
Decay()
{
  const Eigen::VectorXd factors =
    Eigen::VectorXd::NullaryExpr(Frames, [](Eigen::Index t) { return std::pow(0.1, static_cast<double>(t) / 19.0); });
  return factors.array() / factors.mean() - 1.0;
}

/** Returns gamma of an illumination that is on in one frame of five. */
Eigen::VectorXd
EveryFifthLit()
{
  return Eigen::VectorXd::NullaryExpr(Frames, [](Eigen::Index t) { return t % 5 == 0 ? 4.0 : -1.0; });
}

std::vector<double>
NumbersOf(const Eigen::VectorXd & series)
{
  return { series.data(), series.data() + series.size() };
}

Eigen::MatrixXd
BasisOf(const Eigen::VectorXd & gamma)
{
  Eigen::MatrixXd basis(Frames, 2);
  basis << Eigen::VectorXd::Constant(Frames, 1.0 / std::sqrt(static_cast<double>(Frames))), gamma.normalized();
  return basis;
}

Eigen::MatrixXd
ProjectorOf(const Eigen::MatrixXd & basis)
{
  return Eigen::MatrixXd::Identity(Frames, Frames) - basis * basis.transpose();
}

/** Returns noise that is white in space and time, with the variance of the signal at the illumination of each frame. */
NoiseResiduals
ShotNoise(const Eigen::VectorXd & gamma)
{
  const std::vector<double> signal = Ramp(Geometry, 100.0, 1000.0);
  const auto                frameOf = [=](std::size_t t) {
    DoubleFrame  frame = NormalFrame(Geometry.width, Geometry.height, 900 + t);
    const double factor = 1.0 + gamma(static_cast<Eigen::Index>(t));
    for (std::size_t p = 0; p < signal.size(); ++p)
    {
      frame.values[p] *= std::sqrt(ReadNoiseDn2 + Gain * factor * signal[p]);
    }
    return frame;
  };
  return ComputeResiduals(Geometry, static_cast<std::size_t>(Frames), signal, frameOf, gamma);
}

NoiseCorrelation
MeasureWith(const Eigen::VectorXd & gamma, bool isAllowedFor)
{
  NoiseResiduals residuals = ShotNoise(gamma);
  if (isAllowedFor)
  {
    residuals.SetUnequalFrames({ NumbersOf(gamma), Gain, 0.0 });
  }
  return MeasureNoiseCorrelation(residuals, 0.0, SerialFor);
}
} // namespace

TEST(SensorNoiseUnequalFrames, AutocovarianceIsTheSumAlongTheDiagonals)
{
  for (const Eigen::VectorXd & gamma : { Decay(), EveryFifthLit() })
  {
    const Eigen::MatrixXd basis = BasisOf(gamma);
    const Eigen::MatrixXd projector = ProjectorOf(basis);
    const Eigen::MatrixXd dense = projector * gamma.asDiagonal() * projector;
    const Eigen::VectorXd sums = UnequalFrames(NumbersOf(gamma), 1.0, 0.0).Autocovariance(basis, 6);
    ASSERT_EQ(sums.size(), 7);
    for (Eigen::Index d = 0; d <= 6; ++d)
    {
      EXPECT_NEAR(sums(d), dense.diagonal(d).sum(), 1e-12) << d;
    }
    // The sum over d in both directions is 1' P Gamma P 1, and P 1 = 0.
    const Eigen::VectorXd all = UnequalFrames(NumbersOf(gamma), 1.0, 0.0).Autocovariance(basis, Frames - 1);
    EXPECT_NEAR(2.0 * all.sum() - all(0), 0.0, 1e-12);
  }
  EXPECT_EQ(UnequalFrames().Autocovariance(BasisOf(Decay()), 3).norm(), 0.0);
}

TEST(SensorNoiseUnequalFrames, WhiteNoiseUnderADecayIsNotCorrelatedInTime)
{
  const NoiseCorrelation found = MeasureWith(Decay(), true);
  EXPECT_EQ(found.kind, NoiseKind::White);
  for (const LagCoefficient & lag : found.time)
  {
    EXPECT_NEAR(lag.coefficient.value, 0.0, 4.5 * lag.coefficient.standardError) << lag.lag.t;
  }
  // Without the correction the effect is many standard errors.
  const NoiseCorrelation otherwise = MeasureWith(Decay(), false);
  const MeasuredNumber   first = otherwise.time.front().coefficient;
  EXPECT_GT(std::abs(first.value), 6.0 * first.standardError);
}

TEST(SensorNoiseUnequalFrames, WhiteNoiseOfLitFramesHasNoExcessKurtosis)
{
  const NoiseCorrelation found = MeasureWith(EveryFifthLit(), true);
  for (const MeasuredNumber & kurtosis : found.kurtosis)
  {
    EXPECT_NEAR(kurtosis.value, 0.0, 4.5 * kurtosis.standardError + 0.02); // half of the limit of linear noise
  }
  EXPECT_GT(MeasureWith(EveryFifthLit(), false).kurtosis.front().value, 1.0);
}

TEST(SensorNoiseMixtureKurtosis, OfEqualFramesIsTheClosedForm)
{
  for (const Eigen::VectorXd & gamma : { Decay(), EveryFifthLit() })
  {
    const Eigen::MatrixXd projector = ProjectorOf(BasisOf(gamma));
    const double          n = projector.trace();
    const double          expected = 3.0 * projector.diagonal().squaredNorm() / (n * (n + 2.0));
    EXPECT_NEAR(KurtosisOfNormal(projector), expected, 1e-8 * expected);
    EXPECT_NEAR(KurtosisOfNormal(7.0 * projector), expected, 1e-8 * expected);
  }
}

TEST(SensorNoiseMixtureKurtosis, IsTheMeanOfSimulatedNumbers)
{
  constexpr int         draws = 40000;
  const Eigen::VectorXd gamma = EveryFifthLit();
  const Eigen::MatrixXd projector = ProjectorOf(BasisOf(gamma));
  const Eigen::VectorXd variance = 1.0 + 0.8 * gamma.array();
  CounterSeededRandom   random(23);
  double                sum = 0.0;
  double                squares = 0.0;
  for (int i = 0; i < draws; ++i)
  {
    const Eigen::ArrayXd rest = projector * Eigen::VectorXd::NullaryExpr(Frames, [&](Eigen::Index t) {
                                  return std::sqrt(variance(t)) * random.Normal();
                                });
    const double         ratio = rest.square().square().sum() / (rest.square().sum() * rest.square().sum());
    sum += ratio;
    squares += ratio * ratio;
  }
  const double mean = sum / draws;
  const double error = std::sqrt((squares / draws - mean * mean) / draws);
  EXPECT_NEAR(KurtosisOfNormal(projector * variance.asDiagonal() * projector), mean, 4.0 * error);
}

TEST(SensorNoiseMixtureKurtosis, BetweenItsPointsItIsExactToAThousandth)
{
  const Eigen::VectorXd gamma = EveryFifthLit();
  NoiseResiduals        residuals = ShotNoise(gamma);
  EXPECT_EQ(MixtureKurtosis(residuals).AtFraction(0.7), NormalKurtosis(residuals));
  residuals.SetUnequalFrames({ NumbersOf(gamma), Gain, 0.0 });
  const MixtureKurtosis kurtosis(residuals);
  const Eigen::MatrixXd projector = ProjectorOf(BasisOf(gamma));
  for (const double b : { 0.0, 0.1, 0.35, 0.6, 0.85, 0.97, 1.0 })
  {
    const Eigen::VectorXd variance = 1.0 + b * gamma.array();
    const double          exact = KurtosisOfNormal(projector * variance.asDiagonal() * projector);
    EXPECT_NEAR(kurtosis.AtFraction(b) / exact, 1.0, 1e-3) << b;
  }
}
