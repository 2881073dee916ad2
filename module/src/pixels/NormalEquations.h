// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_NormalEquations_h
#define sensornoise_pixels_NormalEquations_h

#include "base/Eigen.h"

namespace sensornoise
{

/** Inverts a symmetric matrix of normal equations in place; false, with the matrix half way, where isPivot(k, pivot) is
 * false of the pivot of a row k: they do not determine that term.
 *
 * In plain loops (Gauss and Jordan), because Eigen's decompositions and products of matrices as small as these end in
 * other bits from version to version. */
template <typename TMatrix, typename TIsPivot>
bool
InvertNormalEquations(TMatrix & matrix, TIsPivot isPivot)
{
  const Eigen::Index terms = matrix.rows();
  for (Eigen::Index k = 0; k < terms; ++k)
  {
    const double pivot = matrix(k, k);
    if (!isPivot(k, pivot))
    {
      return false;
    }
    for (Eigen::Index j = 0; j < terms; ++j)
    {
      matrix(k, j) = (j == k ? 1.0 : matrix(k, j)) / pivot;
    }
    for (Eigen::Index i = 0; i < terms; ++i)
    {
      const double factor = i == k ? 0.0 : matrix(i, k);
      for (Eigen::Index j = 0; j < terms && i != k; ++j)
      {
        matrix(i, j) = (j == k ? 0.0 : matrix(i, j)) - factor * matrix(k, j);
      }
    }
  }
  return true;
}

/** Matrix times vector, in plain loops as well. */
template <typename TMatrix, typename TVector>
TVector
ProductInLoops(const TMatrix & matrix, const TVector & vector)
{
  TVector product = TVector::Zero(matrix.rows());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
  {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    {
      product(i) += matrix(i, j) * vector(j);
    }
  }
  return product;
}

} // namespace sensornoise

#endif
