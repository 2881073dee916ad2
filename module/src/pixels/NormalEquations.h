// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_NormalEquations_h
#define sensornoise_pixels_NormalEquations_h

#include "base/Eigen.h"

#include <vector>

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

/** Mean excess of the variance over a line, of one bin of a VarianceCurve. */
struct ExcessOfBin
{
  double x;      ///< level above the pivot of the line [DN]
  double excess; ///< mean excess of the variance over the line [DN^2]
  double weight; ///< weight of the mean excess [1/DN^4]
};

/** Result of a weighted regression of the excess of bins on \a VTerms functions of the level. */
template <int VTerms>
struct CurveRegression
{
  using Terms = Eigen::Matrix<double, VTerms, 1>;

  bool                                  isDetermined{ false };
  Terms                                 coefficients{ Terms::Zero() };
  Eigen::Matrix<double, VTerms, VTerms> covariance{
    Eigen::Matrix<double, VTerms, VTerms>::Zero()
  }; ///< inverse of the weighted normal equations
  double chi2{ 0.0 }; ///< weighted sum of squares about the fit [1]
};

/** Fits the excess of \a bins by a linear combination of the functions termsAt(x), which returns
 * CurveRegression<VTerms>::Terms. The result is not determined if the normal equations are singular. */
template <int VTerms, typename TTerms>
CurveRegression<VTerms>
RegressCurve(const std::vector<ExcessOfBin> & bins, TTerms termsAt)
{
  using Terms = typename CurveRegression<VTerms>::Terms;
  constexpr double        leastPivot = 1e-10; // relative to the diagonal element; below it is rounding
  CurveRegression<VTerms> fit;
  auto &                  gram = fit.covariance; // inverted in place
  Terms                   right = Terms::Zero();
  for (const ExcessOfBin & bin : bins)
  {
    const Terms terms = termsAt(bin.x);
    for (int i = 0; i < VTerms; ++i)
    {
      right(i) += bin.weight * bin.excess * terms(i);
      for (int j = 0; j < VTerms; ++j)
      {
        gram(i, j) += bin.weight * terms(i) * terms(j);
      }
    }
  }
  const Terms whole = gram.diagonal();
  fit.isDetermined = InvertNormalEquations(
    gram, [&](Eigen::Index k, double pivot) { return pivot > leastPivot * whole(k) && whole(k) > 0.0; });
  if (!fit.isDetermined)
  {
    return {};
  }
  fit.coefficients = ProductInLoops(gram, right);
  for (const ExcessOfBin & bin : bins)
  {
    const Terms terms = termsAt(bin.x);
    double      rest = bin.excess;
    for (int i = 0; i < VTerms; ++i)
    {
      rest -= fit.coefficients(i) * terms(i);
    }
    fit.chi2 += bin.weight * rest * rest;
  }
  return fit;
}

} // namespace sensornoise

#endif
