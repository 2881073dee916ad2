// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseResiduals.h"

#include "base/Eigen.h"
#include "correlation/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
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
NoiseResiduals::SubtractLines(LineAxis axis, const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor)
{
  const SampleTiles &                         tiles = this->GetTiles();
  const std::vector<std::vector<std::size_t>> groups = TilesInLine(tiles, axis);
  m_SubtractedLines = axis;
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

namespace
{
/** Returns cosine and sine of a wave at the pixels of a tile, made orthonormal with the weights \a w among each other
 * and to \a before: pixels x 2. A column is 0 where the pixels do not determine it, as the sine of a wave that
 * alternates from pixel to pixel. */
Eigen::ArrayX2d
OrthonormalWave(const WaveFrequency &              frequency,
                std::size_t                        side,
                const Eigen::ArrayXd &             w,
                const std::vector<const float *> & before)
{
  Eigen::ArrayX2d wave(w.size(), 2);
  for (Eigen::Index p = 0; p < w.size(); ++p)
  {
    const auto   place = static_cast<std::size_t>(p);
    const double angle = 2.0 * std::acos(-1.0) *
                         (frequency.cyclesPerColumn * static_cast<double>(place % side) +
                          frequency.cyclesPerRow * static_cast<double>(place / side));
    wave.row(p) << std::cos(angle), std::sin(angle);
  }
  const double least = InCorrelation.leastVarianceOfLine * w.sum();
  for (Eigen::Index k = 0; k < 2; ++k)
  {
    const auto remove = [&](const Eigen::ArrayXd & other) { wave.col(k) -= other * (w * other * wave.col(k)).sum(); };
    for (const float * const other : before)
    {
      remove(Eigen::Map<const Eigen::ArrayXf>(other, w.size()).cast<double>());
    }
    if (k > 0)
    {
      remove(wave.col(0));
    }
    const double square = (w * wave.col(k).square()).sum();
    wave.col(k) *= square > least ? 1.0 / std::sqrt(square) : 0.0;
  }
  return wave;
}
} // namespace

MeasuredNumber
MeanOfTiles(std::vector<double> numbers)
{
  numbers.erase(std::remove_if(numbers.begin(), numbers.end(), [](double number) { return std::isnan(number); }),
                numbers.end());
  const auto            count = static_cast<double>(numbers.size());
  const Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(count));
  if (numbers.size() < 2)
  {
    return {};
  }
  const double mean = values.mean();
  return { mean, std::sqrt((values.array() - mean).square().sum() / (count * (count - 1.0))) };
}

double
NoiseResiduals::SubtractWaveOfTile(std::size_t                    i,
                                   const WaveFrequency &          frequency,
                                   const std::array<float *, 2> & projections)
{
  const SampleTiles &  tiles = this->GetTiles();
  const auto           size = static_cast<Eigen::Index>(tiles.Pixels());
  const Eigen::ArrayXd w = Eigen::Map<const Eigen::ArrayXf>(this->WeightOf(i), size).cast<double>();
  if (static_cast<std::size_t>((w > 0.0).count()) < InCorrelation.leastPixelsOfWave)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const std::vector<const float *> before = this->WaveProjectionsOf(i);
  const Eigen::ArrayX2d            wave = OrthonormalWave(frequency, tiles.side, w, before);
  const Eigen::ArrayXd             rest = 1.0 - w * wave.square().rowwise().sum();
  const Eigen::ArrayXd             scale = (rest > InCorrelation.leastLeftOfLine).select(rest.max(1e-9).rsqrt(), 1.0);
  const Eigen::Vector2d            meanSquares = wave.square().colwise().mean().transpose();
  Eigen::Vector2d                  energies = Eigen::Vector2d::Zero();
  for (std::size_t t = 0; t < tiles.frames; ++t)
  {
    Eigen::Map<Eigen::ArrayXf> values(m_Sample.OfTile(i) + t * tiles.Pixels(), size);
    const Eigen::ArrayXd       own = values.cast<double>();
    const Eigen::Vector2d      amplitudes = wave.matrix().transpose() * (w * own).matrix();
    energies += amplitudes.cwiseAbs2();
    values = ((own - (wave.matrix() * amplitudes).array()) * scale).cast<float>();
  }
  for (Eigen::Index k = 0; k < 2; ++k)
  {
    Eigen::Map<Eigen::ArrayXf>(projections[static_cast<std::size_t>(k)], size) = (scale * wave.col(k)).cast<float>();
  }
  // The noise contributes 1 for each degree of freedom to the energy of each amplitude.
  return (energies / this->GetDof() - Eigen::Vector2d::Ones()).dot(meanSquares);
}

void
NoiseResiduals::SubtractWave(const WaveFrequency & frequency, const ParallelFor & parallelFor)
{
  const SampleTiles &               tiles = this->GetTiles();
  std::vector<double>               squares(tiles.origins.size());
  std::vector<std::uint8_t>         take(m_Weight.size());
  std::array<std::vector<float>, 2> projections{ std::vector<float>(m_Weight.size(), 0.0F),
                                                 std::vector<float>(m_Weight.size(), 0.0F) };
  parallelFor(tiles.origins.size(), [&](std::size_t i) {
    const std::size_t            first = i * tiles.Pixels();
    const std::array<float *, 2> ofTile{ projections[0].data() + first, projections[1].data() + first };
    squares[i] = this->SubtractWaveOfTile(i, frequency, ofTile);
    this->SumSquares(i);
  });
  std::transform(m_Weight.begin(), m_Weight.end(), take.begin(), [](float weight) { return weight > 0.0F ? 1 : 0; });
  this->Weigh(take);
  std::move(projections.begin(), projections.end(), std::back_inserter(m_WaveProjections));
  m_Interference.push_back({ frequency, MeanOfTiles(squares) });
}

} // namespace sensornoise
