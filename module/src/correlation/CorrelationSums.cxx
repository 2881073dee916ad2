// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/CorrelationSums.h"


#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace sensornoise
{

namespace
{
Eigen::Index
ColumnOf(CovarianceShape shape)
{
  return static_cast<Eigen::Index>(shape);
}

/** Returns the variance at a signal by a line through the bins [DN^2], which have the inverse of their squared variance
 * as weights. The result is clamped between 0 and the variance of the darkest bin. */
double
VarianceAt(double signalDn, const Eigen::MatrixXd & shapes)
{
  Eigen::MatrixXd line(shapes.rows(), 2);
  line << shapes.col(ColumnOf(CovarianceShape::Signal)), shapes.col(ColumnOf(CovarianceShape::Constant));
  const Eigen::VectorXd variance = shapes.col(ColumnOf(CovarianceShape::Variance));
  const Eigen::VectorXd fit = line.completeOrthogonalDecomposition().solve(variance);
  const double          inverse = line.col(1).maxCoeff();
  return inverse > 0.0 ? std::clamp(fit(0) * signalDn + fit(1), 0.0, 1.0 / inverse) : 0.0;
}
constexpr auto FirstPart = static_cast<std::size_t>(CovarianceShape::FirstPart);
} // namespace

CovarianceShapes::CovarianceShapes(const LagSums & own, double leastSignalDn, double unfilteredDn2)
  : m_InBins(Eigen::MatrixXd::Zero(NoiseResiduals::IntensityBins, NumberOfShapes))
{
  for (std::size_t b = 0; b < own.bins.size(); ++b)
  {
    const PairSums & bin = own.bins[b];
    if (bin.pairs > 0.0)
    {
      const auto row = static_cast<Eigen::Index>(b);
      m_InBins.row(row).head(4) << bin.pairs - unfilteredDn2 * bin.constant, bin.signal, bin.square, bin.constant;
      m_InBins.row(row) /= bin.pairs;
    }
  }
  m_DarkDn2 = VarianceAt(leastSignalDn, m_InBins);
  for (std::size_t k = FirstPart; k < NumberOfShapes; ++k)
  {
    m_InBins.col(static_cast<Eigen::Index>(k)) =
      m_InBins.col(ColumnOf(CovarianceShape::Variance)) -
      this->PartAfterFilter(k) * m_InBins.col(ColumnOf(CovarianceShape::Constant));
  }
}

double
CovarianceShapes::PartAfterFilter(std::size_t shape) const
{
  return m_DarkDn2 * static_cast<double>(shape + 1 - FirstPart) / static_cast<double>(PartsAfterFilter);
}

WeightedShape
CovarianceShapes::UnitOf(std::size_t shape) const
{
  WeightedShape unit;
  const bool    isPart = shape >= FirstPart;
  unit.ofVariance = isPart || shape == static_cast<std::size_t>(CovarianceShape::Variance) ? 1.0 : 0.0;
  unit.ofSignal = shape == static_cast<std::size_t>(CovarianceShape::Signal) ? 1.0 : 0.0;
  unit.ofSquare = shape == static_cast<std::size_t>(CovarianceShape::Square) ? 1.0 : 0.0;
  unit.constantDn2 = isPart ? -this->PartAfterFilter(shape) : 0.0;
  return unit;
}

std::array<FittedShape, NumberOfShapes>
FitShapes(const Eigen::MatrixXd & shapes, const Eigen::VectorXd & shared, const Eigen::VectorXd & errors)
{
  std::array<FittedShape, NumberOfShapes> fits;
  for (std::size_t k = 0; k < NumberOfShapes; ++k)
  {
    double product = 0.0;
    double square = 0.0;
    double own = 0.0;
    for (Eigen::Index b = 0; b < shared.size(); ++b)
    {
      const double shape = shapes(b, static_cast<Eigen::Index>(k));
      if (errors(b) > 0.0)
      {
        const double w = 1.0 / (errors(b) * errors(b));
        product += w * shape * shared(b);
        square += w * shape * shape;
        own += w * shared(b) * shared(b);
      }
    }
    if (square > 0.0)
    {
      fits[k].coefficient = product / square;
      fits[k].chi2 = own - product * product / square;
    }
  }
  return fits;
}

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
                                 double                 quantisationDn2,
                                 int                    rings,
                                 int                    timeLags,
                                 const ParallelFor &    parallelFor)
  : m_Residuals(residuals)
  , m_QuantisationDn2(quantisationDn2)
  , m_ParallelFor(parallelFor)
  , m_Tiles(residuals.GetTiles().origins.size())
  , m_Lags{ Lag{} }
  , m_OfUnequalFrames(residuals.GetUnequalFrames().GetGain() / residuals.GetDof() *
                      residuals.GetUnequalFrames().Autocovariance(residuals.GetBasis(),
                                                                  residuals.GetTiles().frames / 3,
                                                                  residuals.GetTimes()))
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
    m_Tiles[i].kurtosis = KurtosisOfTile(residuals, i, kurtosis, m_QuantisationDn2);
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
CorrelationSums::AddEchoes()
{
  for (const Lag & unit : { Lag{ 1, 0, 0 }, Lag{ 0, 1, 0 } })
  {
    const std::vector<Lag> echoes = FindEchoes(m_Residuals, m_Tiles, unit, m_ParallelFor);
    const std::size_t      first = m_Lags.size();
    this->AddLags(echoes);
    for (std::size_t k = first; k < m_Lags.size(); ++k)
    {
      m_Echoes.push_back(k);
    }
  }
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
  sums.covariance -= m_OfUnequalFrames(frames) * (sums.signal - offsetDn * sums.constant);
  return sums;
}

CorrelationSums::Lags
CorrelationSums::Ring(int first, int last) const
{
  Lags       ring = IndicesWhere(m_Lags, [=](const Lag & lag) {
    const int distance = std::max(std::abs(lag.x), std::abs(lag.y));
    return lag.t == 0 && distance >= first && distance <= last;
  });
  const auto isEcho = [&](std::size_t k) { return std::find(m_Echoes.begin(), m_Echoes.end(), k) != m_Echoes.end(); };
  ring.erase(std::remove_if(ring.begin(), ring.end(), isEcho), ring.end());
  return ring;
}

CorrelationSums::Lags
CorrelationSums::Within(int reach) const
{
  Lags within = this->Ring(1, reach);
  for (const std::size_t k : m_Echoes)
  {
    const auto isSame = [&](std::size_t other) {
      return m_Lags[other].x == m_Lags[k].x && m_Lags[other].y == m_Lags[k].y;
    };
    if (std::none_of(within.begin(), within.end(), isSame))
    {
      within.push_back(k);
    }
  }
  return within;
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
  const PairSums total = common.Subtract(sums.lags[lag], m_Lags[lag]).Total();
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
    const LagSums lag = frames == 0 ? common.Subtract(sums.lags[k], m_Lags[k]) : sums.lags[k];
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
  return Jackknife(m_Tiles, [&](const TileSums & sums) { return this->CovarianceInBins(sums, lags); }).StandardErrors();
}

Eigen::VectorXd
CorrelationSums::ProductsOfFrames(const TileSums & sums, std::optional<std::size_t> bin) const
{
  const auto      sumsOf = [&](std::size_t lag) { return bin ? sums.lags[lag].bins.at(*bin) : sums.lags[lag].Total(); };
  const Lags      lags = this->TimeLags();
  Eigen::VectorXd found(static_cast<Eigen::Index>(lags.size()) + 1);
  for (Eigen::Index j = 0; j < found.size(); ++j)
  {
    const PairSums total = sumsOf(j == 0 ? 0 : lags[static_cast<std::size_t>(j) - 1]);
    const PairSums own = this->WithoutUnequalFrames(total, static_cast<int>(j));
    found(j) = Ratio(own.covariance, own.pairs);
  }
  if (!m_Residuals.GetUnequalFrames().AreEqual())
  {
    // The typical variance is the variance of the residuals, which depends differently on bright frames and on dark
    // ones.
    const PairSums same = sumsOf(0);
    const PairSums own = this->WithoutUnequalFrames(same, 0);
    found /= 1.0 - Ratio(same.covariance - own.covariance, same.pairs);
  }
  return m_Residuals.GetDof() * found;
}

namespace
{
/** Returns the slope of the covariance along the signal, and its value at zero signal. Both are divided by the variance
 * in the sums, so that the bins have equal weight. */
Eigen::Vector2d
FitLine(const LagSums & sums)
{
  constexpr auto  bins = static_cast<Eigen::Index>(NoiseResiduals::IntensityBins);
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(bins, 2);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(bins);
  for (Eigen::Index b = 0; b < bins; ++b)
  {
    const PairSums & bin = sums.bins[static_cast<std::size_t>(b)];
    if (bin.pairs > 0.0)
    {
      const double scale = 1.0 / std::sqrt(bin.pairs);
      design.row(b) << scale * bin.signal, scale * bin.constant;
      values(b) = scale * bin.covariance;
    }
  }
  return design.completeOrthogonalDecomposition().solve(values);
}
} // namespace

std::vector<CovarianceLine>
FitCovarianceLines(const CorrelationSums & sums, const CorrelationSums::Lags & lags)
{
  CorrelationSums::Lags all{ 0 };
  all.insert(all.end(), lags.begin(), lags.end());
  const double                blackDn = sums.GetResiduals().GetBlackDn();
  const JackknifeEstimate     lines = Jackknife(sums.GetTiles(), [&](const TileSums & tiles) {
    const CommonNoise common = FindCommonNoise(tiles.shared);
    Eigen::VectorXd   numbers(2 * static_cast<Eigen::Index>(all.size()));
    Eigen::Index      k = 0;
    for (const std::size_t lag : all)
    {
      const Eigen::Vector2d line =
        FitLine(lag == 0 ? tiles.lags[0] : common.Subtract(tiles.lags[lag], sums.GetLag(lag)));
      numbers.segment<2>(k) << line(0), line(1) - line(0) * blackDn;
      k += 2;
    }
    return numbers;
  });
  std::vector<CovarianceLine> found;
  for (Eigen::Index k = 0; k < lines.value.size(); k += 2)
  {
    found.push_back({ sums.GetLag(all[static_cast<std::size_t>(k / 2)]),
                      { lines.value(k), lines.StandardError(k) },
                      { lines.value(k + 1), lines.StandardError(k + 1) } });
  }
  return found;
}

} // namespace sensornoise
