// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_SharedShapes_h
#define sensornoise_correlation_SharedShapes_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/correlation/LagSums.h"
#include "sensornoise/correlation/NoiseCorrelation.h"

#include <array>
#include <vector>

namespace sensornoise
{

/** How what is shared may depend on the light. */
enum class ShapeOfShared : std::uint8_t
{
  Variance,
  Light,
  Square,
  Constant
};
inline constexpr std::size_t NumberOfShapes = 4;

/** What one unit of a shape makes of the covariance relative to the variance, in each bin of the light;
 * \a unfilteredDn2 is the part of the variance that no filter has seen, of the codes' steps. */
SensorNoise_EXPORT Eigen::MatrixXd
PredictShapes(const LagSums & own, double unfilteredDn2);

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
