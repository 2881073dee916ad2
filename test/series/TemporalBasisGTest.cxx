// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/SceneSeries.h"
#include "base/Eigen.h"
#include "series/FrameEquations.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr Eigen::Index Frames = 40;

Eigen::MatrixXd
Normal(Eigen::Index rows, Eigen::Index columns, unsigned int seed)
{
  std::mt19937               random(seed);
  std::normal_distribution<> normal;
  Eigen::MatrixXd            matrix(rows, columns);
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
  {
    matrix(i) = normal(random);
  }
  return matrix;
}

std::vector<double>
Vector(const Eigen::VectorXd & series)
{
  return { series.data(), series.data() + series.size() };
}

/** Returns a basis of a flicker, \a illumination further components of the illumination, and \a motion components of
 * motion.
 */
TemporalBasis
BasisOf(const Eigen::MatrixXd & series, Eigen::Index illumination)
{
  return { Vector(series.col(0)),
           series.middleCols(1, illumination),
           series.rightCols(series.cols() - 1 - illumination) };
}

Eigen::MatrixXd
RoundedOf(const TemporalBasis & basis)
{
  Eigen::MatrixXd rounded(Frames, static_cast<Eigen::Index>(basis.Size()));
  for (Eigen::Index i = 0; i < rounded.size(); ++i)
  {
    rounded(i) = basis.Rounded(static_cast<std::size_t>(i % Frames), static_cast<std::size_t>(i / Frames));
  }
  return rounded;
}

/** Returns the residual sum of squares about the constant and the columns, by an orthogonal decomposition. */
double
ExplicitRss(const Eigen::MatrixXd & columns, const Eigen::VectorXd & y)
{
  Eigen::MatrixXd design(columns.rows(), columns.cols() + 1);
  design << Eigen::VectorXd::Ones(columns.rows()), columns;
  return (y - design * design.householderQr().solve(y)).squaredNorm();
}

/** Returns the coordinates of the values of a pixel from the sums of the third pass. */
Eigen::VectorXd
CoordinatesOf(const TemporalBasis & basis, const Eigen::VectorXd & y)
{
  Eigen::VectorXd sums = RoundedOf(basis).transpose() * y;
  const double    mean = y.mean();
  basis.ToCoordinates(sums.data(), 1, &mean, 1);
  return sums;
}
} // namespace

TEST(SensorNoiseTemporalBasis, IsOrthonormalAndOrthogonalToTheConstant)
{
  const TemporalBasis basis = BasisOf(Normal(Frames, 9, 1), 2);
  ASSERT_EQ(basis.Size(), 9u);
  EXPECT_EQ(basis.NumberOfIlluminationFactors(), 3u);
  const Eigen::MatrixXd & q = basis.GetBasis();
  EXPECT_LT((q.transpose() * q - Eigen::MatrixXd::Identity(9, 9)).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT(q.colwise().sum().cwiseAbs().maxCoeff(), 1e-14);
}

TEST(SensorNoiseTemporalBasis, SeriesAreIntegersOfTwentyBitsThatSpanTheBasis)
{
  const TemporalBasis   basis = BasisOf(Normal(Frames, 9, 1), 2);
  const Eigen::MatrixXd rounded = RoundedOf(basis);
  EXPECT_EQ((rounded.array() - rounded.array().round()).abs().maxCoeff(), 0.0);
  EXPECT_LE(rounded.cwiseAbs().maxCoeff(), TemporalBasis::Unit);
  const Eigen::MatrixXd centred = rounded.rowwise() - rounded.colwise().mean();
  const Eigen::MatrixXd rest = centred - basis.GetBasis() * (basis.GetBasis().transpose() * centred);
  EXPECT_LT(rest.cwiseAbs().maxCoeff(), 1e-14 * TemporalBasis::Unit);
}

TEST(SensorNoiseTemporalBasis, HoldsTheSeriesThatItWasMadeOf)
{
  const Eigen::MatrixXd series = Normal(Frames, 7, 2);
  const TemporalBasis   basis = BasisOf(series, 1);
  const auto &          q = basis.GetBasis();
  for (Eigen::Index j = 0; j < series.cols(); ++j)
  {
    const Eigen::VectorXd centred = series.col(j).array() - series.col(j).mean();
    const double          rest = (centred - q * (q.transpose() * centred)).norm();
    // Each of 7 columns is rounded by at most half a unit in each of 40 frames.
    EXPECT_LT(rest, 7.0 * 0.5 / TemporalBasis::Unit * std::sqrt(40.0) * centred.norm()) << j;
  }
  const Eigen::VectorXd first = series.col(0).array() - series.col(0).mean();
  EXPECT_NEAR(std::abs(q.col(0).dot(first)), first.norm(), 1e-9 * first.norm()); // the first direction is the flicker
}

TEST(SensorNoiseTemporalBasis, ToCoordinatesIsTheProjection)
{
  const TemporalBasis basis = BasisOf(Normal(Frames, 9, 3), 0);
  for (const double level : { 0.0, 3000.0 })
  {
    const Eigen::VectorXd y = 30.0 * Normal(Frames, 1, 4).array() + level;
    const Eigen::VectorXd expected = basis.GetBasis().transpose() * y;
    EXPECT_LT((CoordinatesOf(basis, y) - expected).norm(), 1e-12 * y.norm());
  }
}

TEST(SensorNoiseTemporalBasis, IlluminationPartKeepsTheCoordinates)
{
  const TemporalBasis basis = BasisOf(Normal(Frames, 9, 3), 2);
  const TemporalBasis illumination = basis.OfIllumination();
  ASSERT_EQ(illumination.Size(), 3u);
  EXPECT_EQ(illumination.NumberOfIlluminationFactors(), 3u);
  EXPECT_EQ(illumination.GetBasis(), basis.GetBasis().leftCols(3));
  const Eigen::VectorXd y = 30.0 * Normal(Frames, 1, 4).array() + 3000.0;
  EXPECT_EQ(CoordinatesOf(illumination, y.eval()), CoordinatesOf(basis, y.eval()).head(3).eval());
}

TEST(SensorNoiseTemporalBasis, ResidualSquaresFromSumsAreThoseOfTheExplicitResiduals)
{
  // RSS = M2 - C' P^-1 C, estimator.md 6.
  const TemporalBasis   basis = BasisOf(Normal(Frames, 12, 5), 3);
  const Eigen::VectorXd y = 100.0 * Normal(Frames, 1, 6).array() + 500.0;
  const double          squares = (y.array() - y.mean()).square().sum();
  const double          rss = squares - CoordinatesOf(basis, y).squaredNorm();
  const double          expected = ExplicitRss(RoundedOf(basis), y);
  EXPECT_NEAR(rss, expected, 1e-12 * squares);
  EXPECT_LT(expected, 0.95 * squares);
}

TEST(SensorNoiseTemporalBasis, AffineChangeOfTheSeriesLeavesTheResiduals)
{
  const Eigen::MatrixXd series = Normal(Frames, 6, 7);
  const TemporalBasis   basis = BasisOf(series, 2);
  // Each component has another unit, another level and parts of the previous components: the directions and their order
  // are the same.
  Eigen::MatrixXd mixing = Normal(6, 6, 8).triangularView<Eigen::Upper>();
  mixing.diagonal() = Eigen::VectorXd::LinSpaced(6, 1e-3, 50.0);
  const Eigen::MatrixXd changed = (series * mixing).rowwise() + Normal(1, 6, 9).row(0);
  const Eigen::VectorXd y = Normal(Frames, 1, 10);
  const double          squares = (y.array() - y.mean()).square().sum();
  const double          rss = squares - CoordinatesOf(basis, y).squaredNorm();
  EXPECT_NEAR(squares - CoordinatesOf(BasisOf(changed, 2), y).squaredNorm(), rss, 1e-12 * squares);
  // After any mixing the directions differ, and so does their rounding: 3e-6 of the squares.
  const Eigen::MatrixXd mixed = (series * Normal(6, 6, 11)).rowwise() + Normal(1, 6, 12).row(0);
  EXPECT_NEAR(squares - CoordinatesOf(BasisOf(mixed, 2), y).squaredNorm(), rss, 3e-6 * squares);
}

TEST(SensorNoiseTemporalBasis, SeriesThatAddNothingAreLeftOut)
{
  Eigen::MatrixXd series = Normal(Frames, 6, 13);
  series.col(1) = 3.0 * series.col(0).array() + 1.0; // a multiple of the flicker
  series.col(4).setConstant(2.0);
  series.col(5) = series.col(2) - series.col(3);
  const TemporalBasis basis = BasisOf(series, 1);
  EXPECT_EQ(basis.Size(), 3u);
  EXPECT_EQ(basis.NumberOfIlluminationFactors(), 1u);
  EXPECT_EQ(TemporalBasis().Size(), 0u);
}

TEST(SensorNoiseTemporalBasis, ShortBurstKeepsTheIlluminationAndEnoughDof)
{
  const Eigen::MatrixXd series = Normal(Frames, 30, 14);
  const TemporalBasis   basis = BasisOf(series, 2);
  EXPECT_GE(basis.Size(), 3u);
  EXPECT_LE(static_cast<double>(basis.Size()), 0.6 * static_cast<double>(Frames - 2));
  EXPECT_EQ(basis.NumberOfIlluminationFactors(), 3u);
}

TEST(SensorNoiseTemporalBasis, MotionColumnsAreTheCoefficientsAndTheirProducts)
{
  MotionSeries motion;
  motion.stencils = { StencilX, StencilY, StencilXX };
  motion.coefficients = Normal(Frames, 3, 15);
  const Eigen::VectorXd flicker = 0.1 * Normal(Frames, 1, 16);
  const Eigen::MatrixXd columns = MotionColumns(motion, Vector(flicker));
  ASSERT_EQ(columns.cols(), 5); // the products x y and xx y, without products with yy
  const auto      x = motion.coefficients.col(0).array();
  const auto      y = motion.coefficients.col(1).array();
  const auto      xx = motion.coefficients.col(2).array();
  Eigen::MatrixXd expected(Frames, 5);
  expected << motion.coefficients, x * y / (1.0 + flicker.array()), xx * y / (1.0 + flicker.array());
  for (Eigen::Index j = 0; j < 5; ++j) // in any order
  {
    const double nearest = (columns.colwise() - expected.col(j)).colwise().norm().minCoeff();
    EXPECT_LT(nearest, 1e-14 * expected.col(j).norm()) << j;
  }
  motion.stencils.clear();
  motion.coefficients.resize(Frames, 0);
  EXPECT_EQ(MotionColumns(motion, Vector(flicker)).cols(), 0);
}
