// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/FrameEnergies.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

FrameEnergies::FrameEnergies(const NoiseResiduals &            residuals,
                             const std::vector<std::uint8_t> & take,
                             const ParallelFor &               parallelFor)
  : m_Basis(residuals.GetBasis())
{
  const SampleTiles & tiles = residuals.GetTiles();
  const std::size_t   count = tiles.origins.size();
  const auto          frames = static_cast<Eigen::Index>(tiles.frames);
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(frames, static_cast<Eigen::Index>(count)); // a column for each tile
  Eigen::VectorXd signal = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
  Eigen::VectorXd pixels = signal;
  parallelFor(count, [&](std::size_t i) {
    const auto     tile = static_cast<Eigen::Index>(i);
    const auto     size = static_cast<Eigen::Index>(tiles.Pixels());
    Eigen::ArrayXf taken(size); // 1: the pixel is used
    for (Eigen::Index p = 0; p < size; ++p)
    {
      const auto pixel = static_cast<std::size_t>(p);
      taken(p) = residuals.WeightOf(i)[pixel] > 0.0F && take[residuals.PixelOf(i, pixel)] != 0 ? 1.0F : 0.0F;
    }
    pixels(tile) = static_cast<double>(taken.sum());
    if (!(pixels(tile) > 0.0))
    {
      return;
    }
    using Values = Eigen::Map<const Eigen::ArrayXf>;
    signal(tile) = (Values(residuals.SignalOf(i), size) * taken).cast<double>().sum() / pixels(tile);
    for (Eigen::Index t = 0; t < frames; ++t)
    {
      const Values values(residuals.OfTile(i) + t * size, size);
      squares(t, tile) = (values.cast<double>().square() * taken.cast<double>()).sum() / pixels(tile);
    }
  });
  std::vector<Eigen::Index> filled;
  for (Eigen::Index tile = 0; tile < pixels.size(); ++tile)
  {
    if (pixels(tile) > 0.0)
    {
      filled.push_back(tile);
    }
  }
  const auto rows = static_cast<Eigen::Index>(filled.size());
  m_SquaresDn2.resize(rows, frames);
  m_SignalDn.resize(rows);
  m_Pixels.resize(rows);
  for (Eigen::Index row = 0; row < rows; ++row)
  {
    const Eigen::Index tile = filled[static_cast<std::size_t>(row)];
    m_SquaresDn2.row(row) = squares.col(tile).transpose();
    m_SignalDn(row) = signal(tile);
    m_Pixels(row) = pixels(tile);
  }
  this->FillRemainingFraction();
}

FrameEnergies::FrameEnergies(Eigen::MatrixXd squaresDn2,
                             Eigen::VectorXd signalDn,
                             Eigen::VectorXd pixels,
                             Eigen::MatrixXd basis)
  : m_SquaresDn2(std::move(squaresDn2))
  , m_SignalDn(std::move(signalDn))
  , m_Pixels(std::move(pixels))
  , m_Basis(std::move(basis))
{
  this->FillRemainingFraction();
}

void
FrameEnergies::FillRemainingFraction()
{
  m_RemainingFraction = 1.0 - m_Basis.rowwise().squaredNorm().array();
}

void
FrameEnergies::DivideBy(const Eigen::VectorXd & factors)
{
  m_SquaresDn2.array().rowwise() /= factors.transpose().array();
}

Eigen::VectorXd
FrameEnergies::ExpectedSquares(const Eigen::VectorXd & variances) const
{
  // Row t of (Q Q') o (Q Q') times V is q_t' (Q' V Q) q_t.
  const Eigen::MatrixXd inner = m_Basis.transpose() * variances.asDiagonal() * m_Basis;
  const Eigen::VectorXd shared = (m_Basis * inner).cwiseProduct(m_Basis).rowwise().sum();
  return (2.0 * m_RemainingFraction.array() - 1.0) * variances.array() + shared.array();
}

} // namespace sensornoise
