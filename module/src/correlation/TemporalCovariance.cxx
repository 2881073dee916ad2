// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/TotalCovariance.h"

#include "base/Constants.h"
#include "correlation/AutocovarianceFit.h"
#include "correlation/Constants.h"
#include "correlation/ShapeFits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

namespace
{
/** Returns the coefficient of neighbouring frames in the brightest bin [1]. */
MeasuredNumber
CoefficientOfBrightPixels(const CorrelationSums & sums)
{
  const AutocovarianceFit fit(sums.GetResiduals().GetBasis(), sums.TimeLags().size());
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
  AutocovarianceFit       fit(basis, sums.TimeLags().size());
  double                  last = 1.0;
  for (std::size_t known = 0; last > InCorrelation.smallTimeCoefficient && sums.TimeLags().size() > known;)
  {
    known = sums.TimeLags().size();
    const AutocovarianceFit withoutTail(basis, known);
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
    if (last > InCorrelation.smallTimeCoefficient)
    {
      sums.AddTimeLags(std::min(static_cast<int>(known) + 2, InCorrelation.mostTimeLags));
    }
  }
  found.timeFactor.standardError = std::hypot(found.timeFactor.standardError, found.beyondTimeLags);
  FitTimeShapes(sums, fit, found);
}

} // namespace sensornoise
