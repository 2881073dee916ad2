// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/TemporalMixing.h"

#include <cstddef>

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
} // namespace

Eigen::MatrixXd
TemporalMixing(const Eigen::MatrixXd & basis, std::size_t lags)
{
  const auto      size = static_cast<Eigen::Index>(lags) + 1;
  Eigen::MatrixXd mixing(size, size);
  for (Eigen::Index k = 0; k < size; ++k)
  {
    // P B P = B - Q (B Q)' - (B Q) Q' + Q (Q' B Q) Q'
    const Eigen::MatrixXd shifted = ShiftBothWays(basis, k);
    const Eigen::MatrixXd both = basis * (basis.transpose() * shifted);
    for (Eigen::Index d = 0; d < size; ++d)
    {
      const double own = d == k ? static_cast<double>(basis.rows() - d) : 0.0;
      mixing(d, k) = own - DiagonalOf(basis, shifted, d) - DiagonalOf(shifted, basis, d) + DiagonalOf(both, basis, d);
    }
  }
  return mixing;
}

} // namespace sensornoise
