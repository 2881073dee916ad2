// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/ProcessingSigns.h"

#include "base/Simd.h"
#include "correlation/Constants.h"
#include "correlation/TotalCovariance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Size of the alternating sum that makes a series [pixels]. */
struct KindOfSeries
{
  std::size_t columns;
  std::size_t rows;
};
constexpr std::array<KindOfSeries, KurtosisSums::Kinds> KindsOfSeries{
  { { 1, 1 }, { 2, 1 }, { 1, 2 }, { 2, 2 }, { 8, 1 }, { 1, 8 } }
};

/** Sums over time of the squares and fourth powers of each kind of series, for every pixel of a tile at which the
 * series begins. Where a series extends beyond the end of a row or of the tile, its sums have no meaning. */
struct PowerSums
{
  /** Unit of the squares, near the noise variance [DN^2]: single precision holds the fourth powers then. */
  double unitDn2{ 1.0 };
  /** One cache line longer than a tile: sums a power of two apart would compete for the same places in the cache. */
  using OfPixels = std::array<float, SampleTiles::Side * SampleTiles::Side + 16>;
  std::array<OfPixels, KurtosisSums::Kinds> squares{};
  std::array<OfPixels, KurtosisSums::Kinds> fourths{};
};

/** Returns the alternating sums of all kinds that begin at \a v, a pixel of a tile of \a VSide columns. */
template <std::size_t VSide>
std::array<float, KurtosisSums::Kinds>
AlternatingSums(const float * v)
{
  const float right = v[0] - v[1];
  const float below = v[0] - v[VSide];
  const float square = right - v[VSide] + v[VSide + 1];
  const float row = right + v[2] - v[3] + v[4] - v[5] + v[6] - v[7];
  const float column = below + v[2 * VSide] - v[3 * VSide] + v[4 * VSide] - v[5 * VSide] + v[6 * VSide] - v[7 * VSide];
  return { v[0], right, below, square, row, column };
}

template <std::size_t VSide>
void
SumPowers(const NoiseResiduals & residuals, std::size_t i, PowerSums & sums)
{
  constexpr std::size_t size = VSide * VSide;
  constexpr std::size_t padded = size + 8 * VSide; // a series may begin at the last pixel
  constexpr std::size_t together = 4;              // frames: the sums are loaded and stored a quarter as often
  const std::size_t     frames = residuals.GetTiles().frames;
  const float * const   weight = residuals.WeightOf(i);
  const float           largest = *std::max_element(weight, weight + size);
  const double          factor = largest > 0.0F ? std::exp2(std::round(0.5 * std::log2(largest))) : 1.0; // exact
  std::vector<float>    values(together * padded, 0.0F);
  CallWithAvx2([&, multiplier = static_cast<float>(factor)] {
    PowerSums own{}; // no pointer can point into it, so that the loop over pixels is vectorized
    for (std::size_t first = 0; first < frames; first += together)
    {
      const std::size_t count = std::min(together, frames - first);
      for (std::size_t k = 0; k < together; ++k)
      {
        const float * frame = residuals.OfTile(i) + (first + k) * size;
        float * const to = values.data() + k * padded;
        if (k < count)
        {
          std::transform(frame, frame + size, to, [multiplier](float value) { return multiplier * value; });
        }
        else
        {
          std::fill_n(to, size, 0.0F);
        }
      }
      const float * const begin = values.data();
      for (std::size_t p = 0; p < size; ++p)
      {
        for (std::size_t k = 0; k < together; ++k)
        {
          const auto series = AlternatingSums<VSide>(begin + k * padded + p);
          for (std::size_t kind = 0; kind < series.size(); ++kind)
          {
            const float square = series[kind] * series[kind];
            own.squares[kind][p] += square;
            own.fourths[kind][p] += square * square;
          }
        }
      }
    }
    sums = own;
  });
  sums.unitDn2 = 1.0 / (factor * factor);
}

/** Number of consecutive pixels with a weight, from each pixel of a tile on: along x and along y. */
struct TakenRuns
{
  std::vector<std::size_t> right;
  std::vector<std::size_t> down;

  TakenRuns(const float * weight, std::size_t side)
    : right(side * side, 0)
    , down(side * side, 0)
  {
    for (std::size_t p = side * side; p-- > 0;)
    {
      if (weight[p] > 0.0F)
      {
        right[p] = 1 + ((p + 1) % side != 0 ? right[p + 1] : 0);
        down[p] = 1 + (p + side < down.size() ? down[p + side] : 0);
      }
    }
  }

  /** Returns whether all pixels of a series that begins at pixel \a p have a weight. */
  bool
  Hold(std::size_t p, const KindOfSeries & kind, std::size_t side) const
  {
    bool all = down[p] >= kind.rows;
    for (std::size_t y = 0; all && y < kind.rows; ++y)
    {
      all = right[p + y * side] >= kind.columns;
    }
    return all;
  }
};

/** Returns the fraction of normal noise in the upper tail [1]. */
double
FractionInTail()
{
  return 0.5 * std::erfc(InCorrelation.tailBegins / std::sqrt(2.0));
}

/** Adds the residuals of tile \a i in the upper tail to \a sums. \a powers are the sums over time of the squares of
 * each pixel. Normal noise is scaled by the tile's own variance, so that an error of the model does not look like a
 * tail. */
void
CountTail(const NoiseResiduals & residuals,
          std::size_t            i,
          const PowerSums &      powers,
          double                 quantisationDn2,
          KurtosisSums &         sums)
{
  const std::size_t  size = residuals.GetTiles().side * residuals.GetTiles().side;
  const float *      weight = residuals.WeightOf(i);
  const auto         least = static_cast<float>(InCorrelation.leastVarianceOfTail * quantisationDn2);
  std::vector<float> scale(size, 0.0F); // inverse standard deviation; 0: the pixel does not count
  double             pixels = 0.0;
  double             energy = 0.0;
  for (std::size_t p = 0; p < size; ++p)
  {
    if (weight[p] > 0.0F && weight[p] * least < 1.0F)
    {
      scale[p] = std::sqrt(weight[p]);
      pixels += 1.0;
      energy += static_cast<double>(powers.squares[0][p]) * powers.unitDn2 * weight[p];
    }
  }
  const Eigen::MatrixXd & basis = residuals.GetBasis();
  const double            variance = energy / (std::max(1.0, pixels) * residuals.GetDof());
  for (Eigen::Index t = 0; t < basis.rows(); ++t)
  {
    const double  kept = std::max(0.0, 1.0 - basis.row(t).squaredNorm());
    const auto    limit = static_cast<float>(InCorrelation.tailBegins * std::sqrt(kept * variance));
    const float * frame = residuals.OfTile(i) + static_cast<std::size_t>(t) * size;
    std::size_t   above = 0;
    for (std::size_t p = 0; p < size; ++p)
    {
      above += frame[p] * scale[p] > limit ? 1 : 0;
    }
    sums.inTail += static_cast<double>(above);
  }
  sums.values += pixels * static_cast<double>(basis.rows());
}
} // namespace

double
KurtosisSums::UpperTailExcess() const
{
  const double expected = values * FractionInTail();
  return expected > 0.0 ? inTail / expected - 1.0 : 0.0;
}

double
KurtosisSums::SignificanceOfDeficit() const
{
  const double expected = values * FractionInTail();
  if (inTail >= expected)
  {
    return 0.0;
  }
  const double likelihood = inTail > 0.0 ? inTail * std::log(inTail / expected) : 0.0;
  return std::sqrt(2.0 * std::max(0.0, expected - inTail + likelihood));
}

KurtosisSums &
KurtosisSums::operator+=(const KurtosisSums & other)
{
  for (std::size_t k = 0; k < Kinds; ++k)
  {
    series[k] += other.series[k];
    ratio[k] += other.ratio[k];
  }
  values += other.values;
  inTail += other.inTail;
  return *this;
}

double
NormalKurtosis(const NoiseResiduals & residuals)
{
  const double         dof = residuals.GetDof();
  const Eigen::ArrayXd kept = 1.0 - residuals.GetBasis().array().square().rowwise().sum();
  return 3.0 * kept.square().sum() / (dof * (dof + 2.0));
}

KurtosisSums
KurtosisOfTile(const NoiseResiduals & residuals, std::size_t i, const MixtureKurtosis & normal, double quantisationDn2)
{
  const std::size_t side = residuals.GetTiles().side;
  const float *     weight = residuals.WeightOf(i);
  const float *     signal = residuals.SignalOf(i);
  const auto        least = InCorrelation.leastNoise * static_cast<float>(residuals.GetDof());
  const TakenRuns   taken(weight, side);
  PowerSums         powers{};
  side == SampleTiles::Side ? SumPowers<SampleTiles::Side>(residuals, i, powers)
                                    : SumPowers<SampleTiles::SmallSide>(residuals, i, powers);
  KurtosisSums sums;
  CountTail(residuals, i, powers, quantisationDn2, sums);
  for (std::size_t kind = 0; kind < KurtosisSums::Kinds; ++kind)
  {
    for (std::size_t p = 0; p < side * side; ++p)
    {
      // Differences of pixels that are copies of each other contain rounding errors only.
      if (powers.squares[kind][p] * powers.unitDn2 * weight[p] > least && taken.Hold(p, KindsOfSeries[kind], side))
      {
        const double square = powers.squares[kind][p];
        sums.series[kind] += 1.0;
        sums.ratio[kind] += powers.fourths[kind][p] / (square * square * normal.At(signal[p], weight[p]));
      }
    }
  }
  return sums;
}

double
KurtosisOfNormal(const Eigen::MatrixXd & covariance)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  const double                                         trace = covariance.trace();
  const Eigen::ArrayXd  scales = solver.eigenvalues().array().max(0.0) / trace; // K does not depend on the scale
  const Eigen::MatrixXd squares = solver.eigenvectors().cwiseAbs2();
  // Trapezoidal rule in y = ln s, whose error decreases exponentially. The integrand s^2 (...) is s^2 near 0 and
  // decreases as s^(-n/2) for n degrees of freedom. Checked against the closed form for equal frames: 1e-9.
  constexpr double first = -12.0;
  constexpr double last = 24.0;
  constexpr double step = 0.125;
  double           sum = 0.0;
  for (double y = first; y < last; y += step)
  {
    const double          s = std::exp(y);
    const Eigen::ArrayXd  rest = 1.0 + 2.0 * s * scales;
    const Eigen::VectorXd left = scales / rest;
    sum += s * s * std::exp(-0.5 * rest.log().sum()) * (squares * left).squaredNorm();
  }
  return 3.0 * step * sum;
}

MeasuredNumber
KurtosisOfFrameDifferences(const NoiseResiduals &  residuals,
                           const Eigen::MatrixXd & frames,
                           const ParallelFor &     parallelFor)
{
  const SampleTiles &   tiles = residuals.GetTiles();
  const std::size_t     size = tiles.Pixels();
  const Eigen::Index    count = frames.rows() - 1;
  const Eigen::MatrixXd projection = ResidualProjection(residuals.GetBasis());
  const Eigen::MatrixXd step = projection.bottomRows(count) - projection.topRows(count);
  const double          normal = KurtosisOfNormal(step * frames * step.transpose());
  const auto            least = InCorrelation.leastNoise * static_cast<float>(residuals.GetDof());
  std::vector<double>   excess(tiles.origins.size(), std::numeric_limits<double>::quiet_NaN());
  parallelFor(tiles.origins.size(), [&](std::size_t i) {
    const float * weight = residuals.WeightOf(i);
    double        sum = 0.0;
    double        pixels = 0.0;
    for (std::size_t p = 0; p < size; ++p)
    {
      double squares = 0.0;
      double fourths = 0.0;
      for (Eigen::Index t = 0; t < count && weight[p] > 0.0F; ++t)
      {
        const float * value = residuals.OfTile(i) + static_cast<std::size_t>(t) * size + p;
        const double  square = static_cast<double>(value[size] - value[0]) * (value[size] - value[0]);
        squares += square;
        fourths += square * square;
      }
      if (squares * weight[p] > least)
      {
        sum += fourths / (squares * squares);
        pixels += 1.0;
      }
    }
    if (pixels > 0.0)
    {
      excess[i] = 3.0 * (sum / (pixels * normal) - 1.0);
    }
  });
  return MeanOfTiles(std::move(excess));
}

double
KurtosisRatioOfRecursion(double coefficient)
{
  const double b = std::clamp(coefficient, 0.0, InCorrelation.largestRecursion);
  const double square = b * b;
  const double ofValues = (1.0 - square) / (1.0 + square);
  const double ofDifferences = 0.25 * (1.0 + b) * (1.0 + b) * (1.0 + std::pow(1.0 - b, 4) / (1.0 - square * square));
  return ofDifferences / ofValues;
}

MixtureKurtosis::MixtureKurtosis(const NoiseResiduals & residuals)
  : m_Equal(NormalKurtosis(residuals))
{
  const UnequalFrames & frames = residuals.GetUnequalFrames();
  if (frames.AreEqual())
  {
    return;
  }
  m_IsEqual = false;
  m_Gain = frames.GetGain();
  m_OffsetDn = frames.GetOffsetDn();
  const Eigen::MatrixXd & basis = residuals.GetBasis();
  m_Mean = frames.Autocovariance(basis, 0)(0) / residuals.GetDof();
  const Eigen::MatrixXd projection = ResidualProjection(basis);
  constexpr auto        size = static_cast<Eigen::Index>(Points);
  Eigen::MatrixXd       powers(size, size);
  Eigen::VectorXd       values(size);
  for (Eigen::Index k = 0; k < size; ++k)
  {
    const double x = std::cos(3.14159265358979323846 * (static_cast<double>(k) + 0.5) / static_cast<double>(Points));
    const double root = 0.5 * (1.0 + x);
    const Eigen::VectorXd variance = 1.0 + (1.0 - root * root) * frames.GetGamma().array();
    values(k) = KurtosisOfNormal(projection * variance.asDiagonal() * projection);
    for (Eigen::Index j = 0; j < size; ++j)
    {
      powers(k, j) = std::pow(x, static_cast<double>(j));
    }
  }
  Eigen::Map<Eigen::VectorXd>(m_Polynomial.data(), size) = powers.fullPivLu().solve(values);
}

double
MixtureKurtosis::AtFraction(double shotFraction) const
{
  if (m_IsEqual)
  {
    return m_Equal;
  }
  const double x = 2.0 * std::sqrt(1.0 - std::min(1.0, std::max(0.0, shotFraction))) - 1.0;
  double       sum = 0.0;
  for (std::size_t j = Points; j-- > 0;)
  {
    sum = sum * x + m_Polynomial[j];
  }
  return sum;
}

double
MixtureKurtosis::ShotFraction(double signalDn, double weight) const
{
  const double shot = m_Gain * (signalDn - m_OffsetDn) * weight;
  return shot / (1.0 - m_Mean * shot);
}

} // namespace sensornoise
