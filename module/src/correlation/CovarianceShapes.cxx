// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/CovarianceShapes.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

namespace
{
Eigen::Index
ColumnOf(CovarianceShape shape)
{
  return static_cast<Eigen::Index>(shape);
}

/** Returns the variance at a signal by a line through the bins [DN^2], which have the inverse of their squared variance
 * as weights. The result is clamped between 0 and the variance of the darkest bin. */
double
VarianceAt(double lightDn, const Eigen::MatrixXd & shapes)
{
  Eigen::MatrixXd line(shapes.rows(), 2);
  line << shapes.col(ColumnOf(CovarianceShape::Light)), shapes.col(ColumnOf(CovarianceShape::Constant));
  const Eigen::VectorXd variance = shapes.col(ColumnOf(CovarianceShape::Variance));
  const Eigen::VectorXd fit = line.completeOrthogonalDecomposition().solve(variance);
  const double          inverse = line.col(1).maxCoeff();
  return inverse > 0.0 ? std::clamp(fit(0) * lightDn + fit(1), 0.0, 1.0 / inverse) : 0.0;
}
constexpr auto FirstPart = static_cast<std::size_t>(CovarianceShape::FirstPart);
} // namespace

CovarianceShapes::CovarianceShapes(const LagSums & own, double leastSignalDn, double unfilteredDn2)
  : m_InBins(Eigen::MatrixXd::Zero(NoiseResiduals::IntensityBins, NumberOfShapes))
{
  for (std::size_t b = 0; b < own.bins.size(); ++b)
  {
    const PairSums & bin = own.bins[b];
    if (bin.pairs > 0.0)
    {
      const auto row = static_cast<Eigen::Index>(b);
      m_InBins.row(row).head(4) << bin.pairs - unfilteredDn2 * bin.constant, bin.light, bin.square, bin.constant;
      m_InBins.row(row) /= bin.pairs;
    }
  }
  m_DarkDn2 = VarianceAt(leastSignalDn, m_InBins);
  for (std::size_t k = FirstPart; k < NumberOfShapes; ++k)
  {
    m_InBins.col(static_cast<Eigen::Index>(k)) =
      m_InBins.col(ColumnOf(CovarianceShape::Variance)) -
      this->PartAfterFilter(k) * m_InBins.col(ColumnOf(CovarianceShape::Constant));
  }
}

double
CovarianceShapes::PartAfterFilter(std::size_t shape) const
{
  return m_DarkDn2 * static_cast<double>(shape + 1 - FirstPart) / static_cast<double>(PartsAfterFilter);
}

WeightedShape
CovarianceShapes::UnitOf(std::size_t shape) const
{
  WeightedShape unit;
  const bool    isPart = shape >= FirstPart;
  unit.ofVariance = isPart || shape == static_cast<std::size_t>(CovarianceShape::Variance) ? 1.0 : 0.0;
  unit.ofLight = shape == static_cast<std::size_t>(CovarianceShape::Light) ? 1.0 : 0.0;
  unit.ofSquare = shape == static_cast<std::size_t>(CovarianceShape::Square) ? 1.0 : 0.0;
  unit.constantDn2 = isPart ? -this->PartAfterFilter(shape) : 0.0;
  return unit;
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
