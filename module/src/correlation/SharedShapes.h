// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_SharedShapes_h
#define sensornoise_correlation_SharedShapes_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/LagSums.h"
#include "correlation/NoiseCorrelation.h"

#include <array>
#include <vector>

namespace sensornoise
{

/** What the shapes are made of: sums of the lag 0; the least light that there can be, of the black level where it is
 * known; and the part of the variance that no filter has seen, of the codes' steps. */
class SensorNoise_EXPORT ShapesOfShared
{
public:
  ShapesOfShared(const LagSums & own, double leastLightDn, double unfilteredDn2);

  /** What one unit of each shape makes of the covariance relative to the variance: bins of the light x shapes. */
  const Eigen::MatrixXd &
  InBins() const
  {
    return m_InBins;
  }
  /** A shape, by its index, without coefficient and probability. */
  SharedShape
  UnitOf(std::size_t shape) const;

private:
  /** Variance that may have come after the filter [DN^2]. */
  double
  PartAfterFilter(std::size_t shape) const;

  Eigen::MatrixXd m_InBins;
  double          m_DarkDn2{ 0.0 }; // variance at the least light
};

/** A shape that was fitted to what the bins share. */
struct FittedShape
{
  double coefficient{ 0.0 };
  double chi2{ 0.0 };
};

/** Fits each shape alone to \a shared, relative to the variance, of the bins, with their standard errors. */
SensorNoise_EXPORT std::array<FittedShape, NumberOfShapes>
FitShapes(const Eigen::MatrixXd & shapes, const Eigen::VectorXd & shared, const Eigen::VectorXd & errors);

} // namespace sensornoise

#endif
