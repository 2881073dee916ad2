// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/ShapeFits.h"

#include "correlation/Constants.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sensornoise
{

namespace
{
/** Returns the evidence that is required for a shape, as a difference of chi-squares from the most probable shapes;
 * null: the shape is impossible. Charge coupling is weak and short. Stronger filters may lie before the read-out, or
 * between two parts of its noise. */
std::optional<double>
RequiredEvidence(CovarianceShape shape, bool mayBeCharge)
{
  switch (shape)
  {
    case CovarianceShape::Variance:
      return 0.0;
    case CovarianceShape::Signal:
    case CovarianceShape::Square:
      return mayBeCharge ? std::optional(0.0) : std::nullopt;
    case CovarianceShape::Constant:
      return InCorrelation.evidenceOfConstant;
    default:
      return mayBeCharge ? std::nullopt : std::optional(InCorrelation.evidenceOfPart);
  }
}
} // namespace

std::array<double, NumberOfShapes>
ProbabilitiesOf(const Eigen::VectorXd & chi2, bool mayBeCharge)
{
  std::array<double, NumberOfShapes> probabilities{};
  double                             sum = 0.0;
  for (std::size_t k = 0; k < NumberOfShapes; ++k)
  {
    if (const auto evidence = RequiredEvidence(static_cast<CovarianceShape>(k), mayBeCharge))
    {
      probabilities[k] = std::exp(-0.5 * (chi2(static_cast<Eigen::Index>(k)) + *evidence - chi2.minCoeff()));
      sum += probabilities[k];
    }
  }
  for (double & probability : probabilities)
  {
    probability /= std::max(1e-300, sum);
  }
  return probabilities;
}

std::array<WeightedShape, NumberOfShapes>
WeighShapes(const JackknifeEstimate &                  fits,
            const std::array<double, NumberOfShapes> & probabilities,
            const CovarianceShapes &                   predicted)
{
  std::array<WeightedShape, NumberOfShapes> shapes;
  for (std::size_t k = 0; k < NumberOfShapes; ++k)
  {
    shapes[k] = predicted.UnitOf(k);
    shapes[k].coefficient = NumberAt(fits, k);
    shapes[k].probability = probabilities[k];
  }
  return shapes;
}

} // namespace sensornoise
