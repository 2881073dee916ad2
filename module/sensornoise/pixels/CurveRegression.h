// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_CurveRegression_h
#define sensornoise_pixels_CurveRegression_h

#include <array>
#include <cstddef>
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

/** \class CurveRegression
 * \brief The weighted regression of the excess of bins on \a VTerms functions of the level.
 *
 * The normal equations are solved in plain loops: Eigen's decompositions of matrices as small as these end in other
 * bits from version to version. */
template <std::size_t VTerms>
struct CurveRegression
{
  using Terms = std::array<double, VTerms>;

  bool                      isDetermined{ false };
  Terms                     coefficients{};
  std::array<Terms, VTerms> covariance{}; ///< as the weights have it
  double                    chi2{ 0.0 };  ///< about the fit
};

/** The regression of \a bins on termsAt(x), which returns CurveRegression<VTerms>::Terms. */
template <std::size_t VTerms, typename TTerms>
CurveRegression<VTerms>
RegressCurve(const std::vector<ExcessOfBin> & bins, TTerms termsAt)
{
  using Regression = CurveRegression<VTerms>;
  constexpr double           leastPivot = 1e-10; // relative to the term's own square sum: rounding
  Regression                 fit;
  auto &                     gram = fit.covariance; // which becomes its own inverse
  typename Regression::Terms right{};
  for (const ExcessOfBin & bin : bins)
  {
    const auto terms = termsAt(bin.x);
    for (std::size_t i = 0; i < VTerms; ++i)
    {
      right[i] += bin.weight * bin.excess * terms[i];
      for (std::size_t j = 0; j < VTerms; ++j)
      {
        gram[i][j] += bin.weight * terms[i] * terms[j];
      }
    }
  }
  typename Regression::Terms whole{};
  for (std::size_t k = 0; k < VTerms; ++k)
  {
    whole[k] = gram[k][k];
  }
  for (std::size_t k = 0; k < VTerms; ++k) // Gauss and Jordan, in place
  {
    const double pivot = gram[k][k];
    if (!(pivot > leastPivot * whole[k]) || !(whole[k] > 0.0))
    {
      return {};
    }
    gram[k][k] = 1.0;
    for (double & element : gram[k])
    {
      element /= pivot;
    }
    for (std::size_t i = 0; i < VTerms; ++i)
    {
      const double factor = i == k ? 0.0 : gram[i][k];
      if (i != k)
      {
        gram[i][k] = 0.0;
        for (std::size_t j = 0; j < VTerms; ++j)
        {
          gram[i][j] -= factor * gram[k][j];
        }
      }
    }
  }
  for (std::size_t i = 0; i < VTerms; ++i)
  {
    for (std::size_t j = 0; j < VTerms; ++j)
    {
      fit.coefficients[i] += gram[i][j] * right[j];
    }
  }
  for (const ExcessOfBin & bin : bins)
  {
    const auto terms = termsAt(bin.x);
    double     rest = bin.excess;
    for (std::size_t i = 0; i < VTerms; ++i)
    {
      rest -= fit.coefficients[i] * terms[i];
    }
    fit.chi2 += bin.weight * rest * rest;
  }
  fit.isDetermined = true;
  return fit;
}

} // namespace sensornoise

#endif
