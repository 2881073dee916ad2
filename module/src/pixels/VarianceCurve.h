// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_VarianceCurve_h
#define sensornoise_pixels_VarianceCurve_h

#include "SensorNoiseExport.h"
#include "pixels/VarianceLine.h"
#include "base/Eigen.h"

#include <cstddef>
#include <optional>
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

/** Sums over the pixels of an intensity bin, with the weights of the fit. */
struct CurveBin
{
  /** Number of members. */
  static constexpr std::size_t Sums = 4;

  double pixels{ 0.0 }; ///< number of pixels
  double weight{ 0.0 }; ///< sum of the weights [1/DN^4]
  double x{ 0.0 };      ///< sum of weight times the mean above the line's pivot [1/DN^3]
  double excess{ 0.0 }; ///< sum of weight times the variance above the line [1/DN^2]

  CurveBin &
  operator+=(const CurveBin & other);
};

/** Excess of the slope in an interval of the levels over the line's gain. */
struct SlopeExcess
{
  double value{ 0.0 };     ///< excess of the slope [DN/e-]
  double variance{ 0.0 };  ///< sampling variance of the slope in the interval minus the slope of all levels [DN^2/e-^2]
  double levelsDn2{ 0.0 }; ///< weighted variance of the levels of the interval [DN^2]
};

/** \class VarianceCurve
 * \brief Deviation of the variance from a line as a function of the intensity, which shows whether the response is
 * linear.
 *
 * The size of a deviation is tested, not its significance alone. The contribution of sampling noise to it is
 * subtracted. */
struct SensorNoise_EXPORT VarianceCurve
{
  /** Largest number of bins. */
  static constexpr std::size_t Bins = 64;
  /** Number of groups of adjacent bins whose deviations are looked at together. */
  static constexpr std::size_t Groups = 16;

  VarianceLine          line;
  std::vector<CurveBin> bins; ///< bins of equal numbers of pixels, from dark to bright

  /** Returns the curve about \a line of \a sums, the members of CurveBin of all bins. Empty bins are left out. */
  static VarianceCurve
  Of(const VarianceLine & line, const double * sums);

  /** Returns the reduced chi-square of the bins' mean excesses: 1 if they are sampling noise about a line [1]. Where
   * neighbours have correlated noise, the mean of a bin has 1 to \a varianceInflation times the variance that it has
   * with white noise, as its pixels are neighbours or not. The factor in this range is taken that brings chi-square
   * nearest to 1.
   */
  double
  ReducedChi2(double varianceInflation = 1.0) const;

  /** Returns the non-linearity D: the largest deviation of the mean of a sixteenth of the bins, relative to the line,
   * less the deviation expected by chance [1]. \a dispersion is the variance of the excesses over the variance by their
   * weights, 1 or more [1]. */
  double
  Nonlinearity(double dispersion) const;

  /** Returns the mean level of a bin [DN]. */
  double
  LevelOf(const CurveBin & bin) const
  {
    return line.pivotDn + bin.x / bin.weight;
  }

  /** Returns the mean variance of a bin [DN^2]. */
  double
  VarianceOf(const CurveBin & bin) const
  {
    return line.intercept + line.gain * this->LevelOf(bin) + bin.excess / bin.weight;
  }

  /** Returns the signal of the darkest bin as a fraction of the signal of the brightest bin, both above \a blackDn [1];
   * 1 without bins. */
  double
  DarkestFraction(double blackDn) const;

  /** Returns the excesses of the slope in the darker and the brighter half of the levels, divided once by the number of
   * pixels and once by the information on the slope. A half of one level is left out. */
  std::vector<SlopeExcess>
  FitHalves() const;

  /** Returns the variance of the slope by the jackknife over groups of adjacent bins, of about equal information on the
   * slope [DN^2/e-^2]. It contains deviations that neighbouring levels share. 0 if a group has all the information. */
  double
  SlopeVarianceByGroups() const;

private:
  /** Returns the sum of the bins [first, last). */
  CurveBin
  SumOf(std::size_t first, std::size_t last) const;
  /** Slope of the excess over some bins, about their mean level. */
  struct Slope
  {
    double information; ///< weighted sum of the squared deviations
    double weight;      ///< sum of the weights
    double excess;      ///< slope of the excess [DN/e-]
  };
  Slope
  SlopeOf(std::size_t first, std::size_t last) const;
};

/** Mean over the pixels of the local gain d(mean DN)/d(electron) of a non-linear response. */
struct MeanGain
{
  double value{ 0.0 };    ///< mean local gain [DN/e-]
  double variance{ 0.0 }; ///< sampling variance of its difference from the line's gain [DN^2/e-^2]
};

/** Computes the mean local gain if the variance V follows a polynomial of \a degree instead of a line.
 *
 * With x electrons, response y(x), local gain G = dy/dx and the square s of the read noise in electrons,
 * V = G^2 (x + s). So Z = sqrt(x + s) grows by dZ = dy / (2 sqrt(V)), as in a variance-stabilising transform, and
 *
 *     G(y) = sqrt(V(y)) / Z(y),   Z(y) = Z(y0) + integral from y0 to y of dy / (2 sqrt(V)).
 *
 * If the signal at the darkest level y0 of the scene is small, V' = G there, and Z(y0) = sqrt(V(y0)) / V'(y0). If V is
 * a line, G is its slope. The slope of V is not the local gain: it contains twice the change of G.
 *
 * The other extreme is V(y0) that is all shot noise, as with a tone curve. Then V falls to 0 at the offset mu as the
 * power q = V' (y0 - mu) / V of the signal, and Z(y0) = (y0 - mu) / ((2 - q) sqrt(V)). \a offsetDn selects this case
 * and is mu [DN].
 *
 * Null if the polynomial does not rise at the darkest level, is not positive, or is not determined by the levels. */
SensorNoise_EXPORT std::optional<MeanGain>
FindMeanGain(const VarianceCurve & curve, int degree, const std::optional<double> & offsetDn = std::nullopt);

/** \class VarianceStep
 * \brief Two parallel lines of the variance, one below and one above a level, as for pixels with two amplifiers that
 * each serve a range of levels. Estimator.md, 3.16. */
struct SensorNoise_EXPORT VarianceStep
{
  double levelDn{ 0.0 };     ///< level of the step [DN]
  double halfWidthDn{ 0.0 }; ///< half width of the interval about it in which pixels may be of either amplifier [DN]
  /** Variance by the line above the step minus variance by the line below, at one level [DN^2]. */
  double sizeDn2{ 0.0 };
  double errorDn2{ 0.0 }; ///< standard error of sizeDn2 [DN^2]
  /** The line below the step. Its slope is common to both lines; its covariance is for (gain, intercept). */
  VarianceLine line;
  /** Excess over the common slope below the step and above it [DN/e-], estimated from the levels and
   * InSteps.priorOfGains together, and the larger of their standard errors [DN/e-]. */
  double slopeBelow{ 0.0 };
  double slopeAbove{ 0.0 };
  double errorOfSlopes{ 0.0 };
  bool   isCertain{ false }; ///< whether the step describes the variance better than any smooth curve does

  /** Returns the deviations of \a curve, in which the step was found, from the two lines, without the levels about the
   * step. */
  VarianceCurve
  RestOf(const VarianceCurve & curve) const;
};

/** Finds a step of the variance, up or down, that describes the variance better than a line does, and about as well as
 * a smooth curve or a broken line of as many parameters. It is certain if it describes the variance better than any of
 * them. Null if there is none, or if it is small. */
SensorNoise_EXPORT std::optional<VarianceStep>
FindVarianceStep(const VarianceCurve & curve);

} // namespace sensornoise

#endif
