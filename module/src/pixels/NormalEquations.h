// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_NormalEquations_h
#define sensornoise_pixels_NormalEquations_h

#include "base/Eigen.h"

namespace sensornoise
{

/** Inverts a symmetric matrix of normal equations in place. Returns false, and leaves the matrix incomplete, if
 * isPivot(k, pivot) is false for the pivot of a row k: then the equations do not determine this term.
 *
 * Plain Gauss-Jordan loops are used because the last bits of Eigen's decompositions and products of small matrices
 * differ between its versions. */
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

/** Returns matrix times vector, computed in plain loops for the same reason. */
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
