// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/CorrelationSums.h"

#include "correlation/MixtureKurtosis.h"
#include "correlation/UnequalFrames.h"

#include <algorithm>
#include <cstdlib>

namespace sensornoise
{

namespace
{
double
Ratio(double sum, double count)
{
  return count > 0.0 ? sum / count : 0.0;
}

/** Returns half of the spatial lags at a distance; the opposite lags have the same covariance. */
std::vector<Lag>
LagsOfRing(int distance)
{
  std::vector<Lag> lags;
  for (int y = 0; y <= distance; ++y)
  {
    for (int x = -distance; x <= distance; ++x)
    {
      if (std::max(std::abs(x), y) == distance && (y > 0 || x > 0))
      {
        lags.push_back({ x, y, 0 });
      }
    }
  }
  return lags;
}

template <typename TPredicate>
CorrelationSums::Lags
IndicesWhere(const std::vector<Lag> & lags, TPredicate predicate)
{
  CorrelationSums::Lags found;
  for (std::size_t k = 1; k < lags.size(); ++k)
  {
    if (predicate(lags[k]))
    {
      found.push_back(k);
    }
  }
  return found;
}
} // namespace

TileSums &
TileSums::operator+=(const TileSums & other)
{
  lags.resize(other.lags.size());
  for (std::size_t k = 0; k < lags.size(); ++k)
  {
    lags[k] += other.lags[k];
  }
  shared += other.shared;
  kurtosis += other.kurtosis;
  return *this;
}

CorrelationSums::CorrelationSums(const NoiseResiduals & residuals,
                                 double                 codesDn2,
                                 int                    rings,
                                 int                    timeLags,
                                 const ParallelFor &    parallelFor)
  : m_Residuals(residuals)
  , m_CodesDn2(codesDn2)
  , m_ParallelFor(parallelFor)
  , m_Tiles(residuals.GetTiles().origins.size())
  , m_Lags{ Lag{} }
  , m_OfUnequalFrames(
      residuals.GetUnequalFrames().GetGain() / residuals.GetDof() *
      residuals.GetUnequalFrames().Autocovariance(residuals.GetBasis(), residuals.GetTiles().frames / 3))
{
  for (int distance = 1; distance <= rings; ++distance)
  {
    const std::vector<Lag> ring = LagsOfRing(distance);
    m_Lags.insert(m_Lags.end(), ring.begin(), ring.end());
  }
  const std::vector<Lag> time = this->NextTimeLags(timeLags);
  m_Lags.insert(m_Lags.end(), time.begin(), time.end());
  const LagSummation    lags(residuals, m_Lags);
  const MixtureKurtosis kurtosis(residuals);
  parallelFor(m_Tiles.size(), [&](std::size_t i) {
    m_Tiles[i].shared = SumDistantCovariance(residuals, i);
    m_Tiles[i].kurtosis = KurtosisOfTile(residuals, i, kurtosis);
    m_Tiles[i].lags = lags.OfTile(i);
  });
}

void
CorrelationSums::AddLags(const std::vector<Lag> & lags)
{
  const auto sums = SumLags(m_Residuals, lags, m_ParallelFor);
  for (std::size_t i = 0; i < m_Tiles.size(); ++i)
  {
    m_Tiles[i].lags.insert(m_Tiles[i].lags.end(), sums[i].begin(), sums[i].end());
  }
  m_Lags.insert(m_Lags.end(), lags.begin(), lags.end());
}

void
CorrelationSums::AddRing(int distance)
{
  this->AddLags(LagsOfRing(distance));
}

void
CorrelationSums::AddTimeLags(int last)
{
  this->AddLags(this->NextTimeLags(last));
}

std::vector<Lag>
CorrelationSums::NextTimeLags(int last) const
{
  const int        frames = static_cast<int>(m_Residuals.GetTiles().frames);
  std::vector<Lag> lags;
  for (int t = static_cast<int>(this->TimeLags().size()) + 1; t <= std::min(last, frames / 3); ++t)
  {
    lags.push_back({ 0, 0, t });
  }
  return lags;
}

PairSums
CorrelationSums::WithoutUnequalFrames(PairSums sums, int frames) const
{
  const double offsetDn = m_Residuals.GetUnequalFrames().GetOffsetDn();
  sums.covariance -= m_OfUnequalFrames(frames) * (sums.light - offsetDn * sums.constant);
  return sums;
}

CorrelationSums::Lags
CorrelationSums::Ring(int first, int last) const
{
  return IndicesWhere(m_Lags, [=](const Lag & lag) {
    const int distance = std::max(std::abs(lag.x), std::abs(lag.y));
    return lag.t == 0 && distance >= first && distance <= last;
  });
}

CorrelationSums::Lags
CorrelationSums::Nearest() const
{
  return IndicesWhere(m_Lags, [](const Lag & lag) { return lag.t == 0 && std::abs(lag.x) + std::abs(lag.y) == 1; });
}

CorrelationSums::Lags
CorrelationSums::TimeLags() const
{
  return IndicesWhere(m_Lags, [](const Lag & lag) { return lag.t > 0; });
}

TileSums
CorrelationSums::Total() const
{
  TileSums total;
  for (const TileSums & tile : m_Tiles)
  {
    total += tile;
  }
  return total;
}

double
CorrelationSums::CoefficientOf(const TileSums & sums, const CommonNoise & common, std::size_t lag) const
{
  const PairSums total = common.TakeOff(sums.lags[lag], m_Lags[lag]).Total();
  return Ratio(total.covariance, total.pairs);
}

Eigen::VectorXd
CorrelationSums::CovarianceInBins(const TileSums & sums, const Lags & lags) const
{
  const CommonNoise common = FindCommonNoise(sums.shared);
  Eigen::VectorXd   shared = Eigen::VectorXd::Zero(NoiseResiduals::IntensityBins);
  for (const std::size_t k : lags)
  {
    const int     frames = m_Lags[k].t;
    const LagSums lag = frames == 0 ? common.TakeOff(sums.lags[k], m_Lags[k]) : sums.lags[k];
    for (std::size_t b = 0; b < lag.bins.size(); ++b)
    {
      const PairSums own = frames == 0 ? lag.bins[b] : this->WithoutUnequalFrames(lag.bins[b], frames);
      shared(static_cast<Eigen::Index>(b)) += 2.0 * Ratio(own.covariance, own.pairs);
    }
  }
  return shared;
}

Eigen::VectorXd
CorrelationSums::StandardErrorsInBins(const Lags & lags) const
{
  const JackknifeEstimate shared =
    Jackknife(m_Tiles, [&](const TileSums & sums) { return this->CovarianceInBins(sums, lags); });
  return shared.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
}

Eigen::VectorXd
CorrelationSums::Autocovariance(const TileSums & sums, const Eigen::MatrixXd & mixing) const
{
  Eigen::VectorXd found(mixing.rows());
  const Lags      lags = this->TimeLags();
  for (Eigen::Index j = 0; j < found.size(); ++j)
  {
    const PairSums total = sums.lags[j == 0 ? 0 : lags[static_cast<std::size_t>(j) - 1]].Total();
    const PairSums own = this->WithoutUnequalFrames(total, static_cast<int>(j));
    found(j) = Ratio(own.covariance, own.pairs);
  }
  if (!m_Residuals.GetUnequalFrames().AreEqual())
  {
    // The typical variance is the variance of the residuals, which depends differently on bright frames and on dark
    // ones.
    const PairSums same = sums.lags[0].Total();
    const PairSums own = this->WithoutUnequalFrames(same, 0);
    found /= 1.0 - Ratio(same.covariance - own.covariance, same.pairs);
  }
  return mixing.fullPivLu().solve(Eigen::VectorXd(m_Residuals.GetDof() * found));
}

} // namespace sensornoise
