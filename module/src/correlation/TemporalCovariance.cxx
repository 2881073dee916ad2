// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/TotalCovariance.h"

#include "base/Constants.h"
#include "correlation/Constants.h"
#include "correlation/ShapeFits.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

namespace
{
/** Returns the coefficient of neighbouring frames in the brightest bin [1]. */
MeasuredNumber
CoefficientOfBrightPixels(const CorrelationSums & sums)
{
  const Eigen::MatrixXd mixing = TemporalMixing(sums.GetResiduals().GetBasis(), sums.TimeLags().size());
  return NumberAt(Jackknife(sums.GetTiles(),
                            [&](const TileSums & tiles) {
                              const Eigen::VectorXd covariance =
                                sums.Autocovariance(tiles, mixing, NoiseResiduals::IntensityBins - 1);
                              return Eigen::VectorXd(Eigen::VectorXd::Constant(1, covariance(1) / covariance(0)));
                            }),
                  0);
}

/** Returns the covariance of a frame with all other frames, relative to the variance, in each intensity bin [1]. */
Eigen::VectorXd
TimeCovarianceInBins(const CorrelationSums & sums, const TileSums & tiles, const Eigen::MatrixXd & mixing)
{
  Eigen::VectorXd shared(NoiseResiduals::IntensityBins);
  for (std::size_t b = 0; b < NoiseResiduals::IntensityBins; ++b)
  {
    // The sum over all lags, less the variance of the residuals. The projection has removed slow noise from the
    // residuals.
    const Eigen::VectorXd covariance = sums.Autocovariance(tiles, mixing, b);
    shared(static_cast<Eigen::Index>(b)) = 2.0 * covariance.sum() - covariance(0) - 1.0;
  }
  return shared;
}

/** Fits the dependence of the temporal covariance on the signal. Read noise that is correlated by itself makes it a
 * constant, image lag proportional to the signal, and a filter after the read-out proportional to the variance. */
void
FitTimeShapes(const CorrelationSums & sums, const Eigen::MatrixXd & mixing, NoiseCorrelation & found)
{
  const auto     inBins = [&](const TileSums & tiles) { return TimeCovarianceInBins(sums, tiles, mixing); };
  const auto     errors = Jackknife(sums.GetTiles(), inBins).StandardErrors();
  const auto     fits = FitAllShapes(sums, inBins, errors, sums.GetCodesDn2());
  const TileSums all = sums.Total();
  found.timeShapes =
    WeighShapes(fits, ProbabilitiesOf(fits.value.tail(NumberOfShapes), false), sums.ShapesOf(all, sums.GetCodesDn2()));
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

void
SumOverTime(CorrelationSums & sums, NoiseCorrelation & found)
{
  found.kind = NoiseKind::Temporal;
  const Eigen::MatrixXd & basis = sums.GetResiduals().GetBasis();
  Eigen::MatrixXd         mixing;
  double                  last = 1.0;
  for (std::size_t known = 0; last > InCorrelation.smallTimeCoefficient && sums.TimeLags().size() > known;)
  {
    known = sums.TimeLags().size();
    mixing = TemporalMixing(basis, known);
    const JackknifeEstimate estimate = Jackknife(sums.GetTiles(), [&](const TileSums & tiles) {
      const Eigen::VectorXd covariance = sums.Autocovariance(tiles, mixing);
      return Eigen::VectorXd(Eigen::Vector2d(2.0 * covariance.sum() - covariance(0),
                                             covariance.tail(2).cwiseAbs().maxCoeff() / covariance(0)));
    });
    found.timeFactor = { estimate.value(0), estimate.StandardError(0) };
    last = estimate.value(1);
    if (last > InCorrelation.smallTimeCoefficient)
    {
      sums.AddTimeLags(std::min(static_cast<int>(known) + 2, InCorrelation.mostTimeLags));
    }
  }
  // The error includes the lags beyond, for a tail that continues to decrease as before.
  found.beyondTimeLags = 2.0 * last;
  found.timeFactor.standardError = std::hypot(found.timeFactor.standardError, found.beyondTimeLags);
  FitTimeShapes(sums, mixing, found);
}

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
} // namespace

Eigen::MatrixXd
TemporalMixing(const Eigen::MatrixXd & basis, std::size_t lags)
{
  const auto      size = static_cast<Eigen::Index>(lags) + 1;
  Eigen::MatrixXd mixing(size, size);
  for (Eigen::Index k = 0; k < size; ++k)
  {
    // P B P = B - Q (B Q)' - (B Q) Q' + Q (Q' B Q) Q'
    const Eigen::MatrixXd shifted = ShiftBothWays(basis, k);
    const Eigen::MatrixXd both = basis * (basis.transpose() * shifted);
    for (Eigen::Index d = 0; d < size; ++d)
    {
      const double own = d == k ? static_cast<double>(basis.rows() - d) : 0.0;
      mixing(d, k) = own - DiagonalOf(basis, shifted, d) - DiagonalOf(shifted, basis, d) + DiagonalOf(both, basis, d);
    }
  }
  return mixing;
}

} // namespace sensornoise
