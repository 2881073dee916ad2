// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_CurveRegression_h
#define sensornoise_pixels_CurveRegression_h

#include "base/Eigen.h"
#include "pixels/NormalEquations.h"

#include <vector>

namespace sensornoise
{

/** The mean excess of the bins of a VarianceCurve, each with its weight, at a level above the pivot. */
struct ExcessOfBin
{
  double x;      ///< level above the pivot [DN]
  double excess; ///< mean of the variance above the line [DN^2]
  double weight; ///< [1/DN^4]
};

/** The weighted regression of the excess of bins on \a VTerms functions of the level. */
template <int VTerms>
struct CurveRegression
{
  using Terms = Eigen::Matrix<double, VTerms, 1>;

  bool                                  isDetermined{ false };
  Terms                                 coefficients{ Terms::Zero() };
  Eigen::Matrix<double, VTerms, VTerms> covariance{
    Eigen::Matrix<double, VTerms, VTerms>::Zero()
  }; ///< as the weights have it
  double chi2{ 0.0 }; ///< about the fit
};

/** The regression of \a bins on termsAt(x), which returns CurveRegression<VTerms>::Terms. */
template <int VTerms, typename TTerms>
CurveRegression<VTerms>
RegressCurve(const std::vector<ExcessOfBin> & bins, TTerms termsAt)
{
  using Terms = typename CurveRegression<VTerms>::Terms;
  constexpr double        leastPivot = 1e-10; // relative to the term's own square sum: rounding
  CurveRegression<VTerms> fit;
  auto &                  gram = fit.covariance; // which becomes its own inverse
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
