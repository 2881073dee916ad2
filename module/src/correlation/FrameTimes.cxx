// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/FrameTimes.h"

#include "base/Constants.h"
#include "base/Jackknife.h"
#include "correlation/NoiseResiduals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sensornoise
{

FrameTimes::FrameTimes(std::vector<std::size_t> times)
  : m_Times(std::move(times))
{
  if (!m_Times.empty() && m_Times.back() - m_Times.front() + 1 == m_Times.size())
  {
    m_Times.clear();
  }
}

std::vector<std::pair<std::size_t, std::size_t>>
FrameTimes::PairsAt(std::size_t lag, std::size_t frames) const
{
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t first = 0, second = 0; second < frames; ++second)
  {
    while (this->TimeOf(first) + lag < this->TimeOf(second))
    {
      ++first;
    }
    if (this->TimeOf(first) + lag == this->TimeOf(second))
    {
      pairs.emplace_back(first, second);
    }
  }
  return pairs;
}

Eigen::MatrixXd
FrameTimes::Expand(const Eigen::MatrixXd & rows) const
{
  if (this->AreConsecutive())
  {
    return rows;
  }
  const auto      frames = static_cast<std::size_t>(rows.rows());
  Eigen::MatrixXd expanded = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(this->Duration(frames)), rows.cols());
  for (std::size_t t = 0; t < frames; ++t)
  {
    expanded.row(static_cast<Eigen::Index>(this->TimeOf(t))) = rows.row(static_cast<Eigen::Index>(t));
  }
  return expanded;
}

void
FrameTimes::DropFirst(std::size_t frames)
{
  if (!this->AreConsecutive())
  {
    *this = FrameTimes({ m_Times.begin() + static_cast<std::ptrdiff_t>(frames), m_Times.end() });
  }
}

namespace
{
/** Kinds of pairs of frames that FindFrameTimes() compares. */
enum PairKind : std::uint8_t
{
  Successive,    ///< recorded one after the other
  AcrossRepeat,  ///< with a repeated frame between them
  AcrossMeasured ///< with a measured frame between them
};
constexpr std::size_t PairKinds = 3;

using FramePairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::array<FramePairs, PairKinds>
PairsOf(const std::vector<std::size_t> & numbers)
{
  std::array<FramePairs, PairKinds> pairs;
  for (std::size_t t = 0; t + 1 < numbers.size(); ++t)
  {
    const std::size_t distance = numbers[t + 1] - numbers[t];
    if (distance <= 2)
    {
      pairs[distance == 1 ? Successive : AcrossRepeat].emplace_back(t, t + 1);
    }
    if (t + 2 < numbers.size() && numbers[t + 2] - numbers[t] == 2)
    {
      pairs[AcrossMeasured].emplace_back(t, t + 2);
    }
  }
  return pairs;
}

/** Sums of a tile: mean products of the pairs of each kind, and the variance, each over the typical variance [1]. */
struct PairProducts
{
  Eigen::Array3d products = Eigen::Array3d::Zero();
  double         variance{ 0.0 };

  PairProducts &
  operator+=(const PairProducts & other)
  {
    products += other.products;
    variance += other.variance;
    return *this;
  }
};

PairProducts
SumPairs(const NoiseResiduals & residuals, std::size_t tile, const std::array<FramePairs, PairKinds> & pairs)
{
  const auto size = static_cast<Eigen::Index>(residuals.GetTiles().Pixels());
  using Values = Eigen::Map<const Eigen::ArrayXf>;
  const Eigen::ArrayXd weight = Values(residuals.WeightOf(tile), size).cast<double>();
  const auto           frame = [&](std::size_t t) {
    return Values(residuals.OfTile(tile) + t * residuals.GetTiles().Pixels(), size);
  };
  PairProducts sums;
  for (std::size_t kind = 0; kind < PairKinds; ++kind)
  {
    for (const auto & [first, second] : pairs[kind])
    {
      sums.products(static_cast<Eigen::Index>(kind)) +=
        (weight * frame(first).cast<double>() * frame(second).cast<double>()).sum();
    }
    sums.products(static_cast<Eigen::Index>(kind)) /= static_cast<double>(pairs[kind].size());
  }
  sums.variance = (weight * Values(residuals.SquaresOf(tile), size).cast<double>()).sum() / residuals.GetDof();
  return sums;
}
} // namespace

FrameTimes
FindFrameTimes(const NoiseResiduals & residuals, std::vector<std::size_t> numbers, const ParallelFor & parallelFor)
{
  numbers.resize(std::min(numbers.size(), residuals.GetTiles().frames));
  const FrameTimes times(numbers);
  const auto       pairs = PairsOf(numbers);
  const bool       hasAll = std::none_of(pairs.begin(), pairs.end(), [](const auto & kind) { return kind.empty(); });
  if (times.AreConsecutive() || !hasAll || !residuals.HasEnoughPixels())
  {
    return {};
  }
  Eigen::Array3d          ofWhite = Eigen::Array3d::Zero(); // mean of (Q Q')_tt' over the pairs
  const Eigen::MatrixXd & basis = residuals.GetBasis();
  for (std::size_t kind = 0; kind < PairKinds; ++kind)
  {
    for (const auto & [first, second] : pairs[kind])
    {
      ofWhite(static_cast<Eigen::Index>(kind)) +=
        basis.row(static_cast<Eigen::Index>(first)).dot(basis.row(static_cast<Eigen::Index>(second))) /
        static_cast<double>(pairs[kind].size());
    }
  }
  std::vector<PairProducts> tiles(residuals.GetTiles().origins.size());
  parallelFor(tiles.size(), [&](std::size_t i) { tiles[i] = SumPairs(residuals, i, pairs); });
  const JackknifeEstimate estimate = Jackknife(tiles, [&](const PairProducts & sums) {
    const Eigen::Array3d own = sums.products / std::max(smallestDivisor, sums.variance) + ofWhite;
    return Eigen::VectorXd(
      Eigen::Vector2d(own(AcrossRepeat) - own(Successive), own(AcrossRepeat) - own(AcrossMeasured)));
  });
  const bool isUnlikeSuccessive = std::abs(estimate.value(0)) > Significance.oneTest * estimate.StandardError(0);
  return isUnlikeSuccessive && std::abs(estimate.value(1)) < std::abs(estimate.value(0)) ? times : FrameTimes();
}

} // namespace sensornoise
