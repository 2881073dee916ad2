// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/LocalIllumination.h"

#include "series/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{
namespace
{
/** Returns the ratio of the variance of a frame of relative illumination 1 + \a gamma to the variance at the mean
 * illumination [1]. The illumination is not below 0: where the estimated gamma_t of a dark frame is below -1, the
 * excess is noise. */
double
VarianceAt(double fraction, double gamma)
{
  return std::max(InSeries.leastFrameVariance, 1.0 - fraction + fraction * std::max(0.0, 1.0 + gamma));
}

/** Series of a cell divided by its noise, in coordinates whose first ones are the coordinates of the columns. */
struct WhitenedCell
{
  Eigen::VectorXd                       weight; ///< 1 / standard deviation of every frame
  Eigen::HouseholderQR<Eigen::MatrixXd> decomposition;
  Eigen::VectorXd                       rotated;

  WhitenedCell(const Eigen::MatrixXd & columns,
               const Eigen::VectorXd & gamma,
               double                  fraction,
               const Eigen::VectorXd & series)
    : weight(gamma.unaryExpr([&](double each) { return 1.0 / std::sqrt(VarianceAt(fraction, each)); }))
    , decomposition(weight.asDiagonal() * columns)
    , rotated(decomposition.householderQ().adjoint() * weight.cwiseProduct(series))
  {}
};

Eigen::MatrixXd
WithConstant(const Eigen::MatrixXd & basis)
{
  Eigen::MatrixXd columns(basis.rows(), basis.cols() + 1);
  columns << Eigen::VectorXd::Ones(basis.rows()), basis;
  return columns;
}

/** Returns twice the negative restricted log-likelihood of the series of a cell, up to a constant. The noise is normal,
 * with the scale of the greatest likelihood; the coefficients of the columns are free. */
double
DevianceOf(const WhitenedCell & cell, Eigen::Index columns)
{
  const Eigen::Index dof = cell.rotated.size() - columns;
  const double       squares = std::max(1e-300, cell.rotated.tail(dof).squaredNorm());
  const double ofColumns = cell.decomposition.matrixQR().diagonal().head(columns).array().abs().max(1e-300).log().sum();
  return static_cast<double>(dof) * std::log(squares) - 2.0 * cell.weight.array().log().sum() + 2.0 * ofColumns;
}

Eigen::VectorXd
FractionsAt(double shotOverRead, const Eigen::VectorXd & signal)
{
  const Eigen::ArrayXd shot = shotOverRead * signal.array().max(0.0);
  return shot / (1.0 + shot);
}

/** Deviance of the cells as a function of the ratio of shot variance to read variance in the brightest cell. The
 * arguments are powers of 2 of this ratio; the least one stands for a ratio of 0. */
class DevianceByPower
{
public:
  DevianceByPower(const Eigen::MatrixXd & whole,
                  const Eigen::MatrixXd & columns,
                  const Eigen::VectorXd & gamma,
                  const Eigen::VectorXd & signal)
    : m_Whole(whole)
    , m_Columns(columns)
    , m_Gamma(gamma)
    , m_Signal(signal)
    , m_Step(std::max<Eigen::Index>(
        1,
        whole.cols() / std::max(InSeries.cellsOfShotFraction, InSeries.valuesOfShotFraction / whole.rows())))
    , m_Known(InSeries.largestShotPower - InSeries.leastShotPower + 1)
  {}

  double
  At(int power)
  {
    std::optional<double> & known = m_Known[static_cast<std::size_t>(power - InSeries.leastShotPower)];
    if (!known)
    {
      const Eigen::VectorXd fractions = FractionsAt(this->ShotOverRead(power), m_Signal);
      double                deviance = 0.0;
      for (Eigen::Index i = 0; i < m_Whole.cols(); i += m_Step)
      {
        deviance += DevianceOf(WhitenedCell(m_Columns, m_Gamma, fractions(i), m_Whole.col(i)), m_Columns.cols());
      }
      known = deviance;
    }
    return *known;
  }

  /** Returns the power of the least deviance: every second one is tried, then the neighbours of the best. */
  int
  Best()
  {
    int best = InSeries.leastShotPower;
    for (const int step : { 2, 1 })
    {
      const int first = step == 2 ? InSeries.leastShotPower : std::max(best - 1, InSeries.leastShotPower);
      const int last = step == 2 ? InSeries.largestShotPower : std::min(best + 1, InSeries.largestShotPower);
      for (int power = first; power <= last; power += step)
      {
        best = this->At(power) < this->At(best) ? power : best;
      }
    }
    return best;
  }

  /** Returns k = g / sigma^2: the inverse of the signal at which the shot variance equals the read variance. */
  double
  ShotOverRead(double power) const
  {
    return power <= InSeries.leastShotPower ? 0.0 : std::exp2(power) / m_Signal.maxCoeff();
  }

private:
  const Eigen::MatrixXd &            m_Whole;
  const Eigen::MatrixXd &            m_Columns;
  const Eigen::VectorXd &            m_Gamma;
  const Eigen::VectorXd &            m_Signal;
  Eigen::Index                       m_Step;
  std::vector<std::optional<double>> m_Known;
};
} // namespace

Eigen::VectorXd
EstimateShotFractions(const Eigen::MatrixXd & whole,
                      const Eigen::MatrixXd & basis,
                      const Eigen::VectorXd & gamma,
                      const Eigen::VectorXd & signal)
{
  if (!(signal.maxCoeff() > 0.0))
  {
    return Eigen::VectorXd::Zero(signal.size());
  }
  const Eigen::MatrixXd columns = WithConstant(basis);
  DevianceByPower       deviance(whole, columns, gamma, signal);
  const int             best = deviance.Best();
  double                power = best;
  if (best > InSeries.leastShotPower + 1 && best < InSeries.largestShotPower)
  {
    const double below = deviance.At(best - 1) - deviance.At(best);
    const double above = deviance.At(best + 1) - deviance.At(best);
    power += below + above > 0.0 ? 0.5 * (below - above) / (below + above) : 0.0; // vertex of a parabola
  }
  return FractionsAt(deviance.ShotOverRead(power), signal);
}

Eigen::MatrixXd
WhitenedResiduals(const Eigen::MatrixXd & whole,
                  const Eigen::MatrixXd & basis,
                  const Eigen::VectorXd & gamma,
                  const Eigen::VectorXd & fractions)
{
  const Eigen::MatrixXd columns = WithConstant(basis);
  Eigen::MatrixXd       rest(whole.rows(), whole.cols());
  for (Eigen::Index i = 0; i < whole.cols(); ++i)
  {
    WhitenedCell cell(columns, gamma, fractions(i), whole.col(i));
    cell.rotated.head(columns.cols()).setZero();
    rest.col(i) = cell.decomposition.householderQ() * cell.rotated;
  }
  return rest;
}

} // namespace sensornoise
