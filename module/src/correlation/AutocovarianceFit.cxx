// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/AutocovarianceFit.h"

#include "correlation/Constants.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

namespace
{
/** Returns B_k times a matrix. */
Eigen::MatrixXd
ShiftBothWays(const Eigen::MatrixXd & matrix, Eigen::Index k)
{
  if (k == 0)
  {
    return matrix;
  }
  const Eigen::Index rows = matrix.rows() - k;
  Eigen::MatrixXd    shifted = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
  shifted.topRows(rows) += matrix.bottomRows(rows);
  shifted.bottomRows(rows) += matrix.topRows(rows);
  return shifted;
}

/** Returns sum_t a_t' b_(t+d) over the rows of two matrices. */
double
DiagonalOf(const Eigen::MatrixXd & a, const Eigen::MatrixXd & b, Eigen::Index d)
{
  const Eigen::Index rows = a.rows() - d;
  return a.topRows(rows).cwiseProduct(b.bottomRows(rows)).sum();
}

/** Returns the lag after which a tail of the largest ratio has less than 0.1 % of its sum left [frames]. */
std::size_t
LongestTail()
{
  return static_cast<std::size_t>(std::ceil(std::log(1e-3) / std::log(InCorrelation.largestTailRatio)));
}
} // namespace

Eigen::MatrixXd
TemporalMixing(const Eigen::MatrixXd & basis, std::size_t lags, std::size_t furthest)
{
  const auto      rows = static_cast<Eigen::Index>(lags) + 1;
  const auto      columns = static_cast<Eigen::Index>(furthest) + 1;
  Eigen::MatrixXd mixing(rows, columns);
  for (Eigen::Index k = 0; k < columns; ++k)
  {
    // P B P = B - Q (B Q)' - (B Q) Q' + Q (Q' B Q) Q'
    const Eigen::MatrixXd shifted = ShiftBothWays(basis, k);
    const Eigen::MatrixXd both = basis * (basis.transpose() * shifted);
    for (Eigen::Index d = 0; d < rows; ++d)
    {
      const double own = d == k ? static_cast<double>(basis.rows() - d) : 0.0;
      mixing(d, k) = own - DiagonalOf(basis, shifted, d) - DiagonalOf(shifted, basis, d) + DiagonalOf(both, basis, d);
    }
  }
  return mixing;
}

AutocovarianceFit::AutocovarianceFit(const Eigen::MatrixXd & basis, std::size_t lags)
  : m_Basis(basis)
  , m_Mixing(TemporalMixing(basis, lags, lags))
  , m_Lags(lags)
{}

Eigen::VectorXd
AutocovarianceFit::SumsOfTail(double ratio, std::size_t first) const
{
  const Eigen::Index    lags = std::max<Eigen::Index>(0, m_Mixing.cols() - static_cast<Eigen::Index>(first));
  const Eigen::VectorXd powers = Eigen::VectorXd::NullaryExpr(
    lags, [=](Eigen::Index k) { return std::pow(ratio, static_cast<double>(first) + static_cast<double>(k)); });
  return m_Mixing.rightCols(lags) * powers;
}

Eigen::MatrixXd
AutocovarianceFit::ColumnsOf(double ratio) const
{
  Eigen::MatrixXd columns(m_Mixing.rows(), 2);
  columns << m_Mixing.col(0), this->SumsOfTail(ratio, 1);
  return columns;
}

double
AutocovarianceFit::AmplitudeOf(const Eigen::VectorXd & sums) const
{
  return this->HasTail() ? this->ColumnsOf(m_Ratio).colPivHouseholderQr().solve(sums)(1) : 0.0;
}

void
AutocovarianceFit::FindTail(const Eigen::VectorXd & sums)
{
  const auto frames = static_cast<std::size_t>(m_Basis.rows());
  m_Mixing = TemporalMixing(m_Basis, m_Lags, std::max(m_Lags, std::min(frames - 1, m_Lags + LongestTail())));
  const Eigen::VectorXd white = m_Mixing.col(0);
  const double          ofWhite = (sums - white * (white.dot(sums) / white.squaredNorm())).squaredNorm();
  double                best = 0.0;
  double                least = ofWhite;
  const auto            search = [&](double low, double high, double step) {
    for (double ratio = std::max(step, low); ratio < std::min(high, InCorrelation.largestTailRatio); ratio += step)
    {
      const Eigen::MatrixXd columns = this->ColumnsOf(ratio);
      const Eigen::VectorXd terms = columns.colPivHouseholderQr().solve(sums);
      const double          misfit = (sums - columns * terms).squaredNorm();
      if (terms(1) > 0.0 && misfit < least)
      {
        least = misfit;
        best = ratio;
      }
    }
  };
  const double coarse = 0.02;
  search(coarse, 1.0, coarse);
  search(best - coarse, best + coarse, coarse / 20.0);
  m_Ratio = least < InCorrelation.largestTailMisfit * InCorrelation.largestTailMisfit * ofWhite ? best : 0.0;
}

Eigen::VectorXd
AutocovarianceFit::Autocovariances(const Eigen::VectorXd & sums) const
{
  Eigen::VectorXd left = sums;
  if (this->HasTail())
  {
    left -= this->AmplitudeOf(sums) * this->SumsOfTail(m_Ratio, m_Lags + 1);
  }
  return m_Mixing.leftCols(m_Mixing.rows()).fullPivLu().solve(left);
}

double
AutocovarianceFit::Total(const Eigen::VectorXd & sums) const
{
  const Eigen::VectorXd own = this->Autocovariances(sums);
  const double          beyond = std::pow(m_Ratio, static_cast<double>(m_Lags) + 1.0) / (1.0 - m_Ratio);
  return 2.0 * (own.sum() + this->AmplitudeOf(sums) * beyond) - own(0);
}

} // namespace sensornoise
