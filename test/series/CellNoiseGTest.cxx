// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/LocalIllumination.h"
#include "base/Eigen.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace sensornoise;

namespace
{
constexpr Eigen::Index Frames = 60;
constexpr Eigen::Index Cells = 400;

/** Tiles with signals from 10 to 1000, a read variance of 9 and a gain of 0.5, in frames of any illumination. */
struct SimulatedCells
{
  Eigen::VectorXd gamma;
  Eigen::VectorXd signal;
  Eigen::VectorXd fractions; ///< true shot fractions [1]
  Eigen::MatrixXd whole;     ///< values in units of the noise at gamma = 0 [1]
  Eigen::MatrixXd basis;
  Eigen::MatrixXd rest; ///< residuals of an unweighted projection [1]

  explicit SimulatedCells(const Eigen::VectorXd & illumination, double gain = 0.5, unsigned int seed = 3)
    : gamma(illumination.array() / illumination.mean() - 1.0)
    , signal(Eigen::VectorXd::LinSpaced(Cells, 10.0, 1000.0))
    , fractions((gain * signal.array()) / (gain * signal.array() + 9.0))
    , whole(Frames, Cells)
    , basis(Orthonormalise(gamma, Frames))
  {
    std::mt19937               random(seed);
    std::normal_distribution<> normal;
    for (Eigen::Index i = 0; i < Cells; ++i)
    {
      for (Eigen::Index t = 0; t < Frames; ++t)
      {
        whole(t, i) = std::sqrt(1.0 + fractions(i) * gamma(t)) * normal(random);
      }
    }
    rest = whole.rowwise() - whole.colwise().mean();
    rest -= basis * (basis.transpose() * rest);
  }
};

/** Returns an illumination of 1 in every fourth frame, else `low`. */
Eigen::VectorXd
Pulses(double low)
{
  Eigen::VectorXd illumination = Eigen::VectorXd::Constant(Frames, low);
  for (Eigen::Index t = 3; t < Frames; t += 4)
  {
    illumination(t) = 1.0;
  }
  return illumination;
}
} // namespace

// The ratio of shot to read noise is searched in steps of a factor of 2. The fractions b(k) then deviate from the truth
// by at most max |b(2 k) - b(k)| = 0.17.
TEST(SensorNoiseCellNoise, ShotFractionsAreFound)
{
  for (const double low : { 0.0, 0.1, 0.3 })
  {
    const SimulatedCells  cells(Pulses(low));
    const Eigen::VectorXd found = EstimateShotFractions(cells.whole, cells.basis, cells.gamma, cells.signal);
    EXPECT_LT((found - cells.fractions).cwiseAbs().maxCoeff(), 0.17) << low;
  }
  const SimulatedCells read(Pulses(0.0), 0.0);
  EXPECT_LT(EstimateShotFractions(read.whole, read.basis, read.gamma, read.signal).maxCoeff(), 0.03);
  const SimulatedCells shot(Pulses(0.3), 1e6);
  EXPECT_GT(EstimateShotFractions(shot.whole, shot.basis, shot.gamma, shot.signal).maxCoeff(), 0.99);
}

// Eight temporal components that are large in the 15 bright frames, as the components of motion, leave few and small
// residuals there.
TEST(SensorNoiseCellNoise, ShotFractionsOfDarkFramesAreUnbiased)
{
  for (const unsigned int seed : { 3u, 4u, 5u })
  {
    const SimulatedCells       cells(Pulses(0.0), 0.5, seed);
    Eigen::MatrixXd            columns(Frames, 9);
    std::mt19937               random(seed);
    std::normal_distribution<> normal;
    columns.col(0) = cells.gamma;
    for (Eigen::Index i = Frames; i < columns.size(); ++i)
    {
      columns(i) = (cells.gamma(i % Frames) > 0.0 ? 1.0 : 0.01) * normal(random);
    }
    const Eigen::MatrixXd basis = Orthonormalise(columns, Frames);
    const Eigen::VectorXd found = EstimateShotFractions(cells.whole, basis, cells.gamma, cells.signal);
    // 1 - b is the variance of a dark frame. By the second derivative of the likelihood the relative error of k is 4 %.
    const Eigen::VectorXd ratio = (1.0 - found.array()) / (1.0 - cells.fractions.array());
    EXPECT_GT(ratio.minCoeff(), 0.85) << seed;
    EXPECT_LT(ratio.maxCoeff(), 1.15) << seed;
  }
}

// The whitened residuals have the mean variance 1 over their degrees of freedom, and no direction above the edge of
// Marchenko and Pastur. The unweighted residuals have such directions.
TEST(SensorNoiseCellNoise, WhitenedResidualsAreWhite)
{
  const auto largestOverEdge = [](const Eigen::MatrixXd & rest) {
    const double          dof = static_cast<double>(Frames) - 2.0;
    const double          variance = rest.squaredNorm() / (dof * static_cast<double>(Cells));
    const double          edge = variance * std::pow(std::sqrt(dof) + std::sqrt(static_cast<double>(Cells)), 2);
    const Eigen::MatrixXd gram = rest * rest.transpose();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff() / edge;
  };
  for (const double low : { 0.0, 0.3 })
  {
    const SimulatedCells  cells(Pulses(low));
    const Eigen::MatrixXd white = WhitenedResiduals(cells.whole, cells.basis, cells.gamma, cells.fractions);
    const double          numbers = (static_cast<double>(Frames) - 2.0) * static_cast<double>(Cells);
    EXPECT_NEAR(white.squaredNorm() / numbers, 1.0, 5.0 * std::sqrt(2.0 / numbers));
    EXPECT_LT(largestOverEdge(white), 1.1) << low;
    EXPECT_GT(largestOverEdge(cells.rest), 1.3) << low;
  }
}

TEST(SensorNoiseCellNoise, WithoutShotNoiseOrChangeTheProjectionIsUnweighted)
{
  const SimulatedCells  cells(Pulses(0.3));
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(Cells);
  const Eigen::VectorXd steady = Eigen::VectorXd::Zero(Frames);
  EXPECT_LT((WhitenedResiduals(cells.whole, cells.basis, cells.gamma, none) - cells.rest).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((WhitenedResiduals(cells.whole, cells.basis, steady, cells.fractions) - cells.rest).cwiseAbs().maxCoeff(),
            1e-12);
}
