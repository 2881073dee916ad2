// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseResiduals.h"

#include "base/Eigen.h"
#include "correlation/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

void
NoiseResiduals::RegressLines(LineAxis                         axis,
                             const std::vector<std::size_t> & tiles,
                             std::size_t                      line,
                             std::vector<float> &             left)
{
  const std::size_t side = this->GetTiles().side;
  const std::size_t pixels = tiles.size() * side;
  const auto        inTile = [&](std::size_t k) { return this->GetTiles().InTile(axis, line, k % side); };
  const auto        placeOf = [&](std::size_t k) { return tiles[k / side] * side * side + inTile(k); };
  const auto        valueOf = [&](std::size_t t, std::size_t k) -> float & {
    return m_Sample.OfTile(tiles[k / side])[t * side * side + inTile(k)];
  };
  Eigen::ArrayXd w(static_cast<Eigen::Index>(pixels));
  Eigen::ArrayXd z(w.size());
  for (std::size_t k = 0; k < pixels; ++k)
  {
    w(static_cast<Eigen::Index>(k)) = static_cast<double>(m_Weight[placeOf(k)]);
    z(static_cast<Eigen::Index>(k)) = static_cast<double>(m_Signal[placeOf(k)]);
  }
  const double weight = w.sum();
  if (!(weight > 0.0))
  {
    return; // no pixel of the line is used
  }
  const double square = (w * z.square()).sum();
  z -= (w * z).sum() / weight;
  const double spread = (w * z.square()).sum();
  const bool   hasSlope = spread > InCorrelation.leastVarianceOfLine * square;
  // Regressors that are orthonormal with the weights: the constant, and the signal.
  const double         constant = 1.0 / std::sqrt(weight);
  const Eigen::ArrayXd slope = hasSlope ? Eigen::ArrayXd(z / std::sqrt(spread)) : Eigen::ArrayXd::Zero(z.size());
  for (std::size_t k = 0; k < pixels; ++k)
  {
    const auto   i = static_cast<Eigen::Index>(k);
    const double rest = 1.0 - w(i) * (constant * constant + slope(i) * slope(i));
    const bool   counts = rest > InCorrelation.leastLeftOfLine;
    const double scale = counts ? 1.0 / std::sqrt(rest) : 0.0;
    left[placeOf(k)] = counts ? static_cast<float>(rest) : 0.0F;
    m_LineProjections[0][placeOf(k)] = static_cast<float>(scale * constant);
    m_LineProjections[1][placeOf(k)] = static_cast<float>(scale * slope(i));
  }
  Eigen::ArrayXd values(w.size());
  for (std::size_t t = 0; t < this->GetTiles().frames; ++t)
  {
    for (std::size_t k = 0; k < pixels; ++k)
    {
      values(static_cast<Eigen::Index>(k)) = static_cast<double>(valueOf(t, k));
    }
    const double shared = constant * (w * values).sum() * constant;
    const double inProportion = (w * slope * values).sum();
    for (std::size_t k = 0; k < pixels; ++k)
    {
      const auto i = static_cast<Eigen::Index>(k);
      valueOf(t, k) = static_cast<float>(values(i) - shared - inProportion * slope(i));
    }
  }
}

std::vector<float>
NoiseResiduals::TakeOffLines(LineAxis axis, const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor)
{
  const SampleTiles &                         tiles = this->GetTiles();
  const std::vector<std::vector<std::size_t>> groups = TilesInLine(tiles, axis);
  m_LinesTakenOff = axis;
  std::vector<float> left(m_Signal.size());
  for (std::vector<float> & projections : m_LineProjections)
  {
    projections.assign(m_Signal.size(), 0.0F);
  }
  // The second weights do not contain the line noise, and the second regression replaces the first.
  for (int twice = 0; twice < 2; ++twice)
  {
    std::fill(left.begin(), left.end(), 0.0F);
    parallelFor(groups.size() * tiles.side, [&](std::size_t line) {
      this->RegressLines(axis, groups[line / tiles.side], line % tiles.side, left);
    });
    parallelFor(tiles.origins.size(), [&](std::size_t i) {
      this->SumSquares(i);
      for (std::size_t p = i * tiles.Pixels(); p < (i + 1) * tiles.Pixels(); ++p)
      {
        m_Variance[p] = left[p] > 0.0F ? m_Variance[p] / left[p] : m_Variance[p];
      }
    });
    this->Take(take, parallelFor);
  }
  parallelFor(tiles.origins.size(), [&](std::size_t i) {
    for (std::size_t p = 0; p < tiles.Pixels(); ++p)
    {
      const float rest = left[i * tiles.Pixels() + p];
      const float scale = rest > 0.0F ? 1.0F / std::sqrt(rest) : 1.0F;
      for (std::size_t t = 0; t < tiles.frames; ++t)
      {
        m_Sample.OfTile(i)[t * tiles.Pixels() + p] *= scale;
      }
    }
  });
  return left;
}

} // namespace sensornoise
