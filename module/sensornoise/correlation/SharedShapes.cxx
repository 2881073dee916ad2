// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
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
