// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/series/CellNoise.h"

#include "sensornoise/base/Quantiles.h"
#include "sensornoise/series/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{
namespace
{
/** Median of the square of a standard normal number. */
constexpr double MedianOfSquare = 0.4549;

/** Variance of the residual of frame t after an unweighted projection, over that at gamma = 0, is 1 + b slope(t): of
 * the covariance (1 - P) D (1 - P), D = diag(1 + b gamma), the diagonal. */
Eigen::VectorXd
SlopesOfVariance(const Eigen::MatrixXd & basis, const Eigen::VectorXd & gamma)
{
  const Eigen::Index frames = gamma.size();
  Eigen::MatrixXd    projection = basis * basis.transpose();
  projection.array() += 1.0 / static_cast<double>(frames);
  const Eigen::VectorXd leverage = projection.diagonal();
  const Eigen::VectorXd shared = projection.cwiseAbs2() * gamma;
  // A frame that the basis fits alone has no residual: a guard against division by 0.
  const Eigen::ArrayXd freedom = (1.0 - leverage.array()).max(1e-3);
  return ((1.0 - 2.0 * leverage.array()) * gamma.array() + shared.array()) / freedom;
}

double
VarianceAt(double fraction, double slope)
{
  return std::max(InSeries.leastFrameVariance, 1.0 + fraction * slope);
}

/** Twice the negative log-likelihood of a cell's residuals, up to a constant. */
double
DevianceOf(const Eigen::MatrixXd::ConstColXpr & rest, double fraction, const Eigen::VectorXd & slopes)
{
  std::vector<double> squares(static_cast<std::size_t>(rest.size()));
  double              deviance = 0.0;
  for (Eigen::Index t = 0; t < rest.size(); ++t)
  {
    const double variance = VarianceAt(fraction, slopes(t));
    squares[static_cast<std::size_t>(t)] = rest(t) * rest(t) / variance;
    deviance += std::log(variance);
  }
  std::vector<double> sorted = squares;
  const double        scale = std::max(1e-300, Quantile(sorted, 0.5) / MedianOfSquare);
  for (const double square : squares)
  {
    deviance += std::min(square / scale, 9.0);
  }
  return deviance + static_cast<double>(rest.size()) * std::log(scale);
}

Eigen::VectorXd
FractionsAt(double shotOverRead, const Eigen::VectorXd & signal)
{
  const Eigen::ArrayXd shot = shotOverRead * signal.array().max(0.0);
  return shot / (1.0 + shot);
}
} // namespace

Eigen::VectorXd
EstimateShotFractions(const Eigen::MatrixXd & rest,
                      const Eigen::MatrixXd & basis,
                      const Eigen::VectorXd & gamma,
                      const Eigen::VectorXd & signal)
{
  const double largest = signal.maxCoeff();
  if (!(largest > 0.0))
  {
    return Eigen::VectorXd::Zero(signal.size());
  }
  const Eigen::VectorXd slopes = SlopesOfVariance(basis, gamma);
  const Eigen::Index    step = std::max<Eigen::Index>(1, rest.cols() / InSeries.cellsOfShotFraction);
  double                best = 0.0;
  double                least = 0.0;
  for (int power = InSeries.leastShotPower; power <= InSeries.largestShotPower; ++power)
  {
    const double          shotOverRead = power == InSeries.leastShotPower ? 0.0 : std::ldexp(1.0, power) / largest;
    const Eigen::VectorXd fractions = FractionsAt(shotOverRead, signal);
    double                deviance = 0.0;
    for (Eigen::Index i = 0; i < rest.cols(); i += step)
    {
      deviance += DevianceOf(rest.col(i), fractions(i), slopes);
    }
    if (power == InSeries.leastShotPower || deviance < least)
    {
      least = deviance;
      best = shotOverRead;
    }
  }
  return FractionsAt(best, signal);
}

Eigen::MatrixXd
WhitenedResiduals(const Eigen::MatrixXd & whole,
                  const Eigen::MatrixXd & basis,
                  const Eigen::VectorXd & gamma,
                  const Eigen::VectorXd & fractions)
{
  Eigen::MatrixXd known(basis.rows(), basis.cols() + 1);
  known << Eigen::VectorXd::Ones(basis.rows()), basis;
  Eigen::MatrixXd rest(whole.rows(), whole.cols());
  for (Eigen::Index i = 0; i < whole.cols(); ++i)
  {
    const Eigen::VectorXd weight =
      gamma.unaryExpr([&](double each) { return 1.0 / std::sqrt(VarianceAt(fractions(i), each)); });
    const Eigen::HouseholderQR<Eigen::MatrixXd> decomposition(weight.asDiagonal() * known);
    Eigen::VectorXd rotated = decomposition.householderQ().adjoint() * weight.cwiseProduct(whole.col(i));
    rotated.head(known.cols()).setZero();
    rest.col(i) = decomposition.householderQ() * rotated;
  }
  return rest;
}

} // namespace sensornoise
