// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Eigen.h"
#include "correlation/TotalCovariance.h"
#include "simulation/Random.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

namespace
{
Eigen::MatrixXd
NormalMatrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed)
{
  CounterSeededRandom random(seed);
  Eigen::MatrixXd     matrix(rows, columns);
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
  {
    matrix(i) = random.Normal();
  }
  return matrix;
}

/** Returns a basis of the constant and \a series random components. */
Eigen::MatrixXd
BasisWithConstant(Eigen::Index frames, Eigen::Index series)
{
  Eigen::MatrixXd columns(frames, series + 1);
  columns << Eigen::VectorXd::Ones(frames), NormalMatrix(frames, series, 5);
  return Eigen::HouseholderQR<Eigen::MatrixXd>(columns).householderQ() * Eigen::MatrixXd::Identity(frames, series + 1);
}

Eigen::MatrixXd
ProjectorOf(const Eigen::MatrixXd & basis)
{
  return Eigen::MatrixXd::Identity(basis.rows(), basis.rows()) - basis * basis.transpose();
}

/** Returns the matrix of the shifts by k frames in both directions. */
Eigen::MatrixXd
BothWays(Eigen::Index frames, Eigen::Index k)
{
  return Eigen::MatrixXd::NullaryExpr(
    frames, frames, [k](Eigen::Index s, Eigen::Index t) { return std::abs(s - t) == k ? 1.0 : 0.0; });
}

/** Returns the sums of a matrix along its diagonals 0 ... lags. */
Eigen::VectorXd
DiagonalSums(const Eigen::MatrixXd & matrix, Eigen::Index lags)
{
  return Eigen::VectorXd::NullaryExpr(lags + 1, [&](Eigen::Index d) { return matrix.diagonal(d).sum(); });
}
} // namespace

TEST(SensorNoiseTemporalMixing, IsTheSumAlongTheDiagonalsOfTheProjectedShift)
{
  constexpr Eigen::Index lags = 7;
  const Eigen::MatrixXd  basis = BasisWithConstant(17, 3);
  const Eigen::MatrixXd  projector = ProjectorOf(basis);
  const Eigen::MatrixXd  mixing = TemporalMixing(basis, lags, lags);
  ASSERT_EQ(mixing.rows(), lags + 1);
  ASSERT_EQ(mixing.cols(), lags + 1);
  for (Eigen::Index k = 0; k <= lags; ++k)
  {
    const Eigen::VectorXd dense = DiagonalSums(projector * BothWays(17, k) * projector, lags);
    EXPECT_LT((mixing.col(k) - dense).norm(), 1e-12) << k;
  }
}

TEST(SensorNoiseTemporalMixing, WhiteNoiseMakesTheTracesOfTheProjector)
{
  const Eigen::MatrixXd basis = BasisWithConstant(20, 4);
  const Eigen::VectorXd column = TemporalMixing(basis, 6, 6).col(0);
  EXPECT_NEAR(column(0), 20.0 - 5.0, 1e-12);
  EXPECT_LT((column - DiagonalSums(ProjectorOf(basis), 6)).norm(), 1e-12);
}

TEST(SensorNoiseTemporalMixing, WithoutSeriesLagsDoNotMix)
{
  const Eigen::MatrixXd mixing = TemporalMixing(Eigen::MatrixXd(9, 0), 4, 4);
  for (Eigen::Index d = 0; d <= 4; ++d)
  {
    for (Eigen::Index k = 0; k <= 4; ++k)
    {
      EXPECT_EQ(mixing(d, k), d == k ? 9.0 - static_cast<double>(d) : 0.0);
    }
  }
}

TEST(SensorNoiseTemporalMixing, AutocovariancesOfAShortFilterAreRecoveredExactly)
{
  // The weights (3, 2, 1) give R = (14, 8, 3), and all lags are summed.
  const Eigen::MatrixXd basis = BasisWithConstant(24, 5);
  const Eigen::MatrixXd projector = ProjectorOf(basis);
  const Eigen::MatrixXd covariance = 14.0 * BothWays(24, 0) + 8.0 * BothWays(24, 1) + 3.0 * BothWays(24, 2);
  const Eigen::VectorXd found =
    TemporalMixing(basis, 4, 4).fullPivLu().solve(DiagonalSums(projector * covariance * projector, 4));
  const Eigen::VectorXd expected = (Eigen::VectorXd(5) << 14.0, 8.0, 3.0, 0.0, 0.0).finished();
  EXPECT_LT((found - expected).norm(), 1e-10);
}

TEST(SensorNoiseTemporalMixing, AutocovariancesOfARecursiveFilterAreRecoveredFromItsSeries)
{
  constexpr double       a = 0.5;
  constexpr Eigen::Index frames = 40;
  constexpr Eigen::Index lags = 12; // 0.5^13 = 1e-4 of the variance is left beyond
  constexpr Eigen::Index batches = 40;
  const Eigen::MatrixXd  basis = BasisWithConstant(frames, 3);
  const auto             mixing = TemporalMixing(basis, lags, lags).fullPivLu();
  Eigen::MatrixXd        found(4, batches);
  for (Eigen::Index batch = 0; batch < batches; ++batch)
  {
    constexpr Eigen::Index count = 400;
    Eigen::MatrixXd        series = NormalMatrix(frames, count, 100 + static_cast<std::uint64_t>(batch));
    for (Eigen::Index t = 1; t < frames; ++t) // stationary from the first frame on, with the variance 1
    {
      series.row(t) = a * series.row(t - 1) + std::sqrt(1.0 - a * a) * series.row(t);
    }
    const Eigen::MatrixXd left = series - basis * (basis.transpose() * series);
    const Eigen::MatrixXd products = left * left.transpose() / static_cast<double>(count);
    found.col(batch) = mixing.solve(DiagonalSums(products, lags)).head(4);
  }
  for (Eigen::Index k = 0; k < 4; ++k)
  {
    const double mean = found.row(k).mean();
    const double error = std::sqrt((found.row(k).array() - mean).square().sum() / (batches * (batches - 1.0)));
    EXPECT_NEAR(mean, std::pow(a, k), 4.5 * error + 1e-3) << k;
    EXPECT_LT(error, 0.01) << k;
  }
}

namespace
{
/** Returns the sums along the diagonals of the projected covariance with these autocovariances. */
Eigen::VectorXd
ProjectedSums(const Eigen::MatrixXd & basis, const Eigen::VectorXd & autocovariances, Eigen::Index lags)
{
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::NullaryExpr(
    basis.rows(), basis.rows(), [&](Eigen::Index s, Eigen::Index t) { return autocovariances(std::abs(s - t)); });
  const Eigen::MatrixXd projector = ProjectorOf(basis);
  return DiagonalSums(projector * covariance * projector, lags);
}
} // namespace

TEST(SensorNoiseAutocovarianceFit, TotalOfARecursiveFilterAndWhiteNoiseIsExactInAShortBurst)
{
  constexpr double       q = 0.7;
  constexpr double       white = 0.5;
  constexpr Eigen::Index frames = 24;
  constexpr Eigen::Index lags = 8;
  const Eigen::MatrixXd  basis = BasisWithConstant(frames, 2);
  Eigen::VectorXd        autocovariances = Eigen::VectorXd::NullaryExpr(
    frames, [](Eigen::Index k) { return std::pow(q, static_cast<double>(k)) + (k == 0 ? white : 0.0); });
  const Eigen::VectorXd sums = ProjectedSums(basis, autocovariances, lags);
  AutocovarianceFit     fit(basis, lags);
  const double          truth = (1.0 + q) / (1.0 - q) + white;
  EXPECT_LT(fit.Total(sums), 0.95 * truth); // the projection has removed slow noise
  fit.FindTail(sums);
  ASSERT_TRUE(fit.HasTail());
  EXPECT_NEAR(fit.Total(sums), truth, 1e-9);
  EXPECT_LT((fit.Autocovariances(sums) - autocovariances.head(lags + 1)).norm(), 1e-9);
}

TEST(SensorNoiseAutocovarianceFit, MeansOverFramesHaveNoTail)
{
  const Eigen::MatrixXd basis = BasisWithConstant(40, 2);
  const Eigen::VectorXd autocovariances =
    Eigen::VectorXd::NullaryExpr(40, [](Eigen::Index k) { return std::max(0.0, 5.0 - static_cast<double>(k)); });
  const Eigen::VectorXd sums = ProjectedSums(basis, autocovariances, 7);
  AutocovarianceFit     fit(basis, 7);
  fit.FindTail(sums);
  EXPECT_FALSE(fit.HasTail());
  EXPECT_NEAR(fit.Total(sums), 25.0, 1e-9);
}

TEST(SensorNoiseRemainingOfCorrelated, IsTheDiagonalOfTheProjectedCorrelation)
{
  const Eigen::MatrixXd             basis = BasisWithConstant(17, 3);
  const Eigen::VectorXd             left = ProjectorOf(basis).diagonal();
  const std::vector<LagCoefficient> lags{ { { 0, 0, 1 }, { 0.5, 0.0 } }, { { 0, 0, 2 }, { 0.2, 0.0 } } };
  EXPECT_LT((RemainingOfCorrelated(basis, CorrelationOfFrames({}, 17)) - Eigen::VectorXd::Ones(17)).norm(), 1e-12);

  const Eigen::VectorXd remaining = RemainingOfCorrelated(basis, CorrelationOfFrames(lags, 17));
  const Eigen::MatrixXd mixing = TemporalMixing(basis, 2, 2);
  EXPECT_NEAR(remaining.dot(left), mixing.row(0).dot(Eigen::RowVector3d(1.0, 0.5, 0.2)), 1e-12);
  EXPECT_GT((remaining.array() - remaining.mean()).abs().maxCoeff(), 0.1); // differs between frames
}
