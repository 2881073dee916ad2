// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_ShapeFits_h
#define sensornoise_correlation_ShapeFits_h

#include "base/Eigen.h"
#include "correlation/CorrelationSums.h"
#include "correlation/Jackknife.h"
#include "correlation/NoiseCorrelation.h"

#include <array>
#include <cstddef>

namespace sensornoise
{

/** Returns an estimated value with its standard error. */
inline MeasuredNumber
NumberAt(const JackknifeEstimate & estimate, std::size_t k)
{
  const auto index = static_cast<Eigen::Index>(k);
  return { estimate.value(index), estimate.StandardError(index) };
}

/** Returns the coefficients of all shapes, and then their chi-squares. \a covarianceInBins(tiles) is the covariance in
 * the bins, relative to the variance, with its standard \a errors. \a unfilteredDn2 is the variance of quantization and
 * line noise [DN^2]. */
template <typename TFunction>
JackknifeEstimate
FitAllShapes(const CorrelationSums & sums,
             TFunction               covarianceInBins,
             const Eigen::VectorXd & errors,
             double                  unfilteredDn2)
{
  return Jackknife(sums.GetTiles(), [&](const TileSums & tiles) {
    const CovarianceShapes predicted = sums.ShapesOf(tiles, unfilteredDn2);
    const auto             shapes = FitShapes(predicted.InBins(), covarianceInBins(tiles), errors);
    Eigen::VectorXd        figures(2 * NumberOfShapes);
    for (std::size_t k = 0; k < NumberOfShapes; ++k)
    {
      figures(static_cast<Eigen::Index>(k)) = shapes[k].coefficient;
      figures(static_cast<Eigen::Index>(NumberOfShapes + k)) = shapes[k].chi2;
    }
    return figures;
  });
}

/** Returns the probabilities of the shapes from their chi-squares. \a mayBeCharge: the covariance is weak and short, so
 * that coupled charge may cause it. */
std::array<double, NumberOfShapes>
ProbabilitiesOf(const Eigen::VectorXd & chi2, bool mayBeCharge);

/** Returns the shapes with the coefficients of \a fits and their probabilities. */
std::array<WeightedShape, NumberOfShapes>
WeighShapes(const JackknifeEstimate &                  fits,
            const std::array<double, NumberOfShapes> & probabilities,
            const CovarianceShapes &                   predicted);

} // namespace sensornoise

#endif
