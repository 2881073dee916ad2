// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_CovarianceShapes_h
#define sensornoise_correlation_CovarianceShapes_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/LagSums.h"
#include "correlation/NoiseCorrelation.h"

#include <array>
#include <vector>

namespace sensornoise
{

/** \class CovarianceShapes
 * \brief Predicted dependence of the noise covariance on the signal, for each shape.
 *
 * \a own are the sums of the zero lag. \a leastSignalDn is the least possible signal, 0 where black is known [DN].
 * \a unfilteredDn2 is the variance that no filter has changed, of quantization and line noise [DN^2]. */
class SensorNoise_EXPORT CovarianceShapes
{
public:
  CovarianceShapes(const LagSums & own, double leastSignalDn, double unfilteredDn2);

  /** Returns the covariance that a coefficient of 1 of each shape makes, relative to the variance: bins x shapes. */
  const Eigen::MatrixXd &
  InBins() const
  {
    return m_InBins;
  }
  /** Returns a shape by its index, without coefficient and probability. */
  WeightedShape
  UnitOf(std::size_t shape) const;

private:
  /** Returns the variance that was added after the filter, according to a shape [DN^2]. */
  double
  PartAfterFilter(std::size_t shape) const;

  Eigen::MatrixXd m_InBins;
  double          m_DarkDn2{ 0.0 }; // variance at the least signal [DN^2]
};

/** Fit of one shape to the covariances in the bins. */
struct FittedShape
{
  double coefficient{ 0.0 };
  double chi2{ 0.0 };
};

/** Fits each shape alone to \a shared, the covariances of the bins relative to the variance, with their standard
 * errors. */
SensorNoise_EXPORT std::array<FittedShape, NumberOfShapes>
FitShapes(const Eigen::MatrixXd & shapes, const Eigen::VectorXd & shared, const Eigen::VectorXd & errors);

} // namespace sensornoise

#endif
