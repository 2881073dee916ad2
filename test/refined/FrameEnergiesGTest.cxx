// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/FramePhotonTransfer.h"
#include "helpers/CorrelationTestHelper.h"
#include "helpers/StackTestHelper.h"
#include "simulation/Random.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr FrameGeometry Geometry{ 96, 64, 1 };
constexpr Eigen::Index  Frames = 12;

/** Returns an orthonormal basis of the constant and a ramp. */
Eigen::MatrixXd
Basis()
{
  Eigen::MatrixXd basis(Frames, 2);
  for (Eigen::Index t = 0; t < Frames; ++t)
  {
    basis.row(t) << 1.0, static_cast<double>(t) - 0.5 * static_cast<double>(Frames - 1);
  }
  basis.col(0).normalize();
  basis.col(1).normalize();
  return basis;
}

FrameEnergies
EnergiesWithBasis(const Eigen::MatrixXd & basis)
{
  return { Eigen::MatrixXd::Ones(1, basis.rows()), Eigen::VectorXd::Ones(1), Eigen::VectorXd::Ones(1), basis };
}
} // namespace

TEST(SensorNoiseFrameEnergies, ExpectedSquaresAreTheDiagonalOfTheProjectedCovariance)
{
  const Eigen::MatrixXd basis = Basis();
  Eigen::VectorXd       variances(Frames);
  for (Eigen::Index t = 0; t < Frames; ++t)
  {
    variances(t) = 1.0 + static_cast<double>(t * t);
  }
  const Eigen::MatrixXd projector = Eigen::MatrixXd::Identity(Frames, Frames) - basis * basis.transpose();
  const Eigen::MatrixXd expected = projector * variances.asDiagonal() * projector;
  const FrameEnergies   energies = EnergiesWithBasis(basis);
  EXPECT_TRUE(energies.ExpectedSquares(variances).isApprox(expected.diagonal(), 1e-12));
  EXPECT_TRUE(energies.ExpectedSquares(Eigen::VectorXd::Ones(Frames)).isApprox(energies.RemainingFraction(), 1e-12));
  EXPECT_TRUE(energies.RemainingFraction().isApprox(projector.diagonal(), 1e-12));
}

TEST(SensorNoiseFrameEnergies, AreTheMeanSquaresOfTheTakenPixelsOfEachTile)
{
  CounterSeededRandom random(3, 1, 0);
  std::vector<float>  stack;
  for (std::size_t i = 0; i < Geometry.Pixels() * static_cast<std::size_t>(Frames); ++i)
  {
    stack.push_back(static_cast<float>(100.0 + 5.0 * random.Normal()));
  }
  std::vector<double>       mean(Geometry.Pixels(), 100.0);
  std::vector<std::uint8_t> take(Geometry.Pixels(), 1);
  std::vector<std::uint8_t> also(Geometry.Pixels(), 1);
  for (std::size_t p = 0; p < take.size(); ++p)
  {
    take[p] = p % Geometry.width < 40 || p % 3 == 0 ? 0 : 1; // one column of tiles has no pixel
    also[p] = p % 5 == 0 ? 0 : 1;
  }
  FrameSample sample = FrameSample::Of<float>(Geometry, static_cast<std::size_t>(Frames));
  sample.AddFrames(stack.data(), 0, static_cast<std::size_t>(Frames), mean);
  const NoiseResiduals residuals(std::move(sample), Basis().rightCols<1>(), { mean, take, 90.0 }, SerialFor);
  const FrameEnergies  energies(residuals, also, Threads(3));
  const SampleTiles &  tiles = residuals.GetTiles();
  ASSERT_LT(energies.Tiles(), static_cast<Eigen::Index>(tiles.origins.size()));
  ASSERT_GT(energies.Tiles(), 3);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < tiles.origins.size(); ++i)
  {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(Frames);
    double          pixels = 0.0;
    for (std::size_t p = 0; p < tiles.Pixels(); ++p)
    {
      const std::size_t pixel = tiles.PixelOf(i, p, Geometry.width);
      if (take[pixel] != 0 && also[pixel] != 0)
      {
        pixels += 1.0;
        for (Eigen::Index t = 0; t < Frames; ++t)
        {
          const double value = residuals.OfTile(i)[static_cast<std::size_t>(t) * tiles.Pixels() + p];
          sums(t) += value * value;
        }
      }
    }
    if (pixels > 0.0)
    {
      EXPECT_EQ(energies.Pixels()(row), pixels);
      EXPECT_NEAR(energies.SignalDn()(row), 10.0, 1e-9);
      EXPECT_TRUE(energies.SquaresDn2().row(row).transpose().isApprox(sums / pixels, 1e-12)) << i;
      ++row;
    }
  }
  EXPECT_EQ(row, energies.Tiles());
}

TEST(SensorNoiseFrameEnergies, AreDividedByTheFactorsOfTheFrames)
{
  FrameEnergies         energies = EnergiesWithBasis(Basis());
  const Eigen::VectorXd factors = Eigen::VectorXd::LinSpaced(Frames, 1.0, 4.0);
  energies.DivideBy(factors);
  EXPECT_TRUE(energies.SquaresDn2().row(0).transpose().cwiseProduct(factors).isOnes(1e-15));
}
