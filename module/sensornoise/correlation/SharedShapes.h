/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
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
