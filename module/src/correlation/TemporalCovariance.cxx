// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/TotalCovariance.h"

#include "base/Constants.h"
#include "correlation/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sensornoise
{

namespace
{
/** Returns B_k times a matrix. */
Eigen::MatrixXd
ShiftBothWays(const Eigen::MatrixXd & matrix, Eigen::Index k)
{
  if (k == 0)
  {
    return matrix;
  }
  const Eigen::Index rows = matrix.rows() - k;
  Eigen::MatrixXd    shifted = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
  shifted.topRows(rows) += matrix.bottomRows(rows);
  shifted.bottomRows(rows) += matrix.topRows(rows);
  return shifted;
}

/** Returns sum_t a_t' b_(t+d) over the rows of two matrices. */
double
DiagonalOf(const Eigen::MatrixXd & a, const Eigen::MatrixXd & b, Eigen::Index d)
{
  const Eigen::Index rows = a.rows() - d;
  return a.topRows(rows).cwiseProduct(b.bottomRows(rows)).sum();
}

/** Returns the lag after which a tail of the largest ratio has less than 0.1 % of its sum left [frames]. */
std::size_t
LongestTail()
{
  return static_cast<std::size_t>(std::ceil(std::log(1e-3) / std::log(InCorrelation.largestTailRatio)));
}

/** Returns the sums of the autocovariances q^k of the lags k from \a first on; q is \a ratio. */
Eigen::VectorXd
SumsOfTail(const Eigen::MatrixXd & mixing, double ratio, Eigen::Index first)
{
  const Eigen::Index    lags = mixing.cols() - first;
  const Eigen::VectorXd powers =
    Eigen::VectorXd::NullaryExpr(lags, [=](Eigen::Index k) { return std::pow(ratio, static_cast<double>(first + k)); });
  return mixing.rightCols(lags) * powers;
}

/** Returns the sums of white noise, and of q^k, k = 1, 2, ..., as columns. */
Eigen::MatrixXd
ColumnsOf(const Eigen::MatrixXd & mixing, double ratio)
{
  Eigen::MatrixXd columns(mixing.rows(), 2);
  columns << mixing.col(0), SumsOfTail(mixing, ratio, 1);
  return columns;
}
} // namespace

Eigen::MatrixXd
TemporalMixing(const Eigen::MatrixXd & basis, std::size_t lags, std::size_t furthest, const FrameTimes & times)
{
  const auto            rows = static_cast<Eigen::Index>(lags) + 1;
  const auto            columns = static_cast<Eigen::Index>(furthest) + 1;
  const auto            frames = static_cast<std::size_t>(basis.rows());
  const Eigen::MatrixXd inTime = times.Expand(basis);
  const Eigen::VectorXd isMeasured = times.Expand(Eigen::VectorXd::Ones(basis.rows()));
  Eigen::MatrixXd       mixing(rows, columns);
  for (Eigen::Index k = 0; k < columns; ++k)
  {
    // P B P = B - Q (B Q)' - (B Q) Q' + Q (Q' B Q) Q'
    const Eigen::MatrixXd shifted = isMeasured.asDiagonal() * ShiftBothWays(inTime, k);
    const Eigen::MatrixXd both = inTime * (inTime.transpose() * shifted);
    for (Eigen::Index d = 0; d < rows; ++d)
    {
      const double own = d == k ? static_cast<double>(times.PairsAt(static_cast<std::size_t>(d), frames).size()) : 0.0;
      mixing(d, k) =
        own - DiagonalOf(inTime, shifted, d) - DiagonalOf(shifted, inTime, d) + DiagonalOf(both, inTime, d);
    }
  }
  return mixing;
}

AutocovarianceFit::AutocovarianceFit(const Eigen::MatrixXd & basis, std::size_t lags, FrameTimes times)
  : m_Basis(basis)
  , m_Times(std::move(times))
  , m_Mixing(TemporalMixing(basis, lags, lags, m_Times))
{
  this->Solve();
}

void
AutocovarianceFit::FindTail(const Eigen::VectorXd & sums)
{
  const auto frames = m_Times.Duration(static_cast<std::size_t>(m_Basis.rows()));
  const auto lags = static_cast<std::size_t>(m_Mixing.rows()) - 1;
  m_Mixing = TemporalMixing(m_Basis, lags, std::max(lags, std::min(frames - 1, lags + LongestTail())), m_Times);
  const Eigen::VectorXd white = m_Mixing.col(0);
  const double          ofWhite = (sums - white * (white.dot(sums) / white.squaredNorm())).squaredNorm();
  double                best = 0.0;
  double                least = ofWhite;
  const auto            search = [&](double low, double high, double step) {
    for (double ratio = std::max(step, low); ratio < std::min(high, InCorrelation.largestTailRatio); ratio += step)
    {
      const Eigen::MatrixXd columns = ColumnsOf(m_Mixing, ratio);
      const Eigen::VectorXd terms = columns.colPivHouseholderQr().solve(sums);
      const double          misfit = (sums - columns * terms).squaredNorm();
      if (terms(1) > 0.0 && misfit < least)
      {
        least = misfit;
        best = ratio;
      }
    }
  };
  constexpr double coarse = 0.02;
  search(coarse, 1.0, coarse);
  search(best - coarse, best + coarse, coarse / 20.0);
  m_Ratio = least < InCorrelation.largestTailMisfit * InCorrelation.largestTailMisfit * ofWhite ? best : 0.0;
  this->Solve();
}

/** Sets the matrices of the results, which are linear in the sums. */
void
AutocovarianceFit::Solve()
{
  const Eigen::Index size = m_Mixing.rows();
  m_Autocovariances = m_Mixing.leftCols(size).fullPivLu().inverse();
  m_Total = 2.0 * m_Autocovariances.colwise().sum() - m_Autocovariances.row(0);
  if (this->HasTail())
  {
    // The tail is A q^k, and the amplitude A is linear in the sums, too.
    const Eigen::MatrixXd    identity = Eigen::MatrixXd::Identity(size, size);
    const Eigen::RowVectorXd amplitude = ColumnsOf(m_Mixing, m_Ratio).colPivHouseholderQr().solve(identity).row(1);
    m_Autocovariances *= identity - SumsOfTail(m_Mixing, m_Ratio, size) * amplitude;
    const double beyond = std::pow(m_Ratio, static_cast<double>(size)) / (1.0 - m_Ratio);
    m_Total = 2.0 * (m_Autocovariances.colwise().sum() + beyond * amplitude) - m_Autocovariances.row(0);
  }
}

namespace
{
/** Returns the coefficient of neighbouring frames in the brightest bin [1]. */
MeasuredNumber
CoefficientOfBrightPixels(const CorrelationSums & sums)
{
  const NoiseResiduals &  residuals = sums.GetResiduals();
  const AutocovarianceFit fit(residuals.GetBasis(), sums.TimeLags().size(), residuals.GetTimes());
  return NumberAt(Jackknife(sums.GetTiles(),
                            [&](const TileSums & tiles) {
                              const Eigen::VectorXd covariance =
                                fit.Autocovariances(sums.ProductsOfFrames(tiles, NoiseResiduals::IntensityBins - 1));
                              return Eigen::VectorXd(Eigen::VectorXd::Constant(1, covariance(1) / covariance(0)));
                            }),
                  0);
}

/** Returns the covariance of a frame with all other frames, relative to the variance, in each intensity bin [1]. */
Eigen::VectorXd
TimeCovarianceInBins(const CorrelationSums & sums, const TileSums & tiles, const AutocovarianceFit & fit)
{
  Eigen::VectorXd shared(NoiseResiduals::IntensityBins);
  for (std::size_t b = 0; b < NoiseResiduals::IntensityBins; ++b)
  {
    // The sum over all lags, less the variance of the residuals. The projection has removed slow noise from the
    // residuals.
    shared(static_cast<Eigen::Index>(b)) = fit.Total(sums.ProductsOfFrames(tiles, b)) - 1.0;
  }
  return shared;
}

/** Fits the dependence of the temporal covariance on the signal. Read noise that is correlated by itself makes it a
 * constant, image lag proportional to the signal, and a filter after the read-out proportional to the variance. */
void
FitTimeShapes(const CorrelationSums & sums, const AutocovarianceFit & fit, NoiseCorrelation & found)
{
  const auto     inBins = [&](const TileSums & tiles) { return TimeCovarianceInBins(sums, tiles, fit); };
  const auto     errors = Jackknife(sums.GetTiles(), inBins).StandardErrors();
  const auto     fits = FitAllShapes(sums, inBins, errors, sums.GetQuantisationDn2());
  const TileSums all = sums.Total();
  found.isBySensitivity = IsProportionalToSquare(fits);
  found.timeShapes =
    WeighShapes(fits,
                ProbabilitiesOf(fits.value.tail(NumberOfShapes), false, sums.GetResiduals().IsBlackKnown()),
                sums.ShapesOf(all, sums.GetQuantisationDn2()));
}
} // namespace

bool
IsCorrelatedInTime(const CorrelationSums & sums, const std::vector<LagCoefficient> & coefficients)
{
  const auto isLarge = [](const MeasuredNumber & coefficient) {
    return coefficient.Exceeds(InCorrelation.leastTimeCoefficient, Significance.severalTests);
  };
  return std::any_of(coefficients.begin(),
                     coefficients.end(),
                     [&isLarge](const LagCoefficient & lag) { return isLarge(lag.coefficient); }) ||
         (!sums.TimeLags().empty() && isLarge(CoefficientOfBrightPixels(sums)));
}

Eigen::MatrixXd
ResidualProjection(const Eigen::MatrixXd & basis)
{
  return Eigen::MatrixXd::Identity(basis.rows(), basis.rows()) - basis * basis.transpose();
}

Eigen::MatrixXd
CorrelationOfFrames(const std::vector<LagCoefficient> & lags, Eigen::Index frames, const FrameTimes & times)
{
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(frames, frames);
  for (const LagCoefficient & lag : lags)
  {
    for (const auto & [first, second] :
         times.PairsAt(static_cast<std::size_t>(lag.lag.t), static_cast<std::size_t>(frames)))
    {
      const auto row = static_cast<Eigen::Index>(first);
      const auto column = static_cast<Eigen::Index>(second);
      correlation(row, column) = correlation(column, row) = lag.coefficient.value;
    }
  }
  return correlation;
}

Eigen::VectorXd
RemainingOfCorrelated(const Eigen::MatrixXd & basis, const Eigen::MatrixXd & correlation)
{
  const Eigen::MatrixXd projection = ResidualProjection(basis);
  const Eigen::VectorXd remaining = (projection * correlation).cwiseProduct(projection).rowwise().sum();
  return remaining.cwiseQuotient(projection.diagonal());
}

void
SumOverTime(CorrelationSums & sums, NoiseCorrelation & found)
{
  found.kind = NoiseKind::Temporal;
  const Eigen::MatrixXd & basis = sums.GetResiduals().GetBasis();
  const FrameTimes &      times = sums.GetResiduals().GetTimes();
  AutocovarianceFit       fit(basis, sums.TimeLags().size(), times);
  double                  last = 1.0;
  for (std::size_t known = 0; last > InCorrelation.leastTimeCoefficient && sums.TimeLags().size() > known;)
  {
    known = sums.TimeLags().size();
    const AutocovarianceFit withoutTail(basis, known, times);
    fit = withoutTail;
    fit.FindTail(sums.ProductsOfFrames(sums.Total()));
    const JackknifeEstimate estimate = Jackknife(sums.GetTiles(), [&](const TileSums & tiles) {
      const Eigen::VectorXd products = sums.ProductsOfFrames(tiles);
      const Eigen::VectorXd covariance = fit.Autocovariances(products);
      return Eigen::VectorXd(Eigen::Vector3d(fit.Total(products),
                                             covariance.tail(2).cwiseAbs().maxCoeff() / covariance(0),
                                             fit.Total(products) - withoutTail.Total(products)));
    });
    found.timeFactor = { estimate.value(0), estimate.StandardError(0) };
    last = estimate.value(1);
    // The error by the lags beyond: half of what the tail adds, or what lags that decrease as before would add.
    found.beyondTimeLags = fit.HasTail() ? 0.5 * std::abs(estimate.value(2)) : 2.0 * last;
    if (last > InCorrelation.leastTimeCoefficient)
    {
      sums.AddTimeLags(std::min(static_cast<int>(known) + 2, InCorrelation.mostTimeLags));
    }
  }
  found.timeFactor.standardError = std::hypot(found.timeFactor.standardError, found.beyondTimeLags);
  FitTimeShapes(sums, fit, found);
}

} // namespace sensornoise
