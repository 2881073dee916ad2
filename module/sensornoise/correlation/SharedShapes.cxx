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
#include "sensornoise/correlation/SharedShapes.h"

#include <cstddef>

namespace sensornoise
{

Eigen::MatrixXd
PredictShapes(const LagSums & own, double unfilteredDn2)
{
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(NoiseResiduals::LightBins, NumberOfShapes);
  for (std::size_t b = 0; b < own.bins.size(); ++b)
  {
    const PairSums & bin = own.bins[b];
    if (bin.pairs > 0.0)
    {
      const auto row = static_cast<Eigen::Index>(b);
      shapes.row(row) << bin.pairs - unfilteredDn2 * bin.constant, bin.light, bin.square, bin.constant;
      shapes.row(row) /= bin.pairs;
    }
  }
  return shapes;
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

} // namespace sensornoise
