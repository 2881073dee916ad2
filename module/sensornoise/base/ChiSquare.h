/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_base_ChiSquare_h
#define sensornoise_base_ChiSquare_h

#include "sensornoise/base/DistributionTails.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

/** \file
 * Chi-square, Student's and normal distributions, for any real number of degrees of freedom above 0.
 *
 * Each tail is computed directly, so a small one keeps its digits: for 0.1 to 1e6 degrees of freedom probabilities are
 * good to 1e-10 relative down to 1e-300, and quantiles likewise as far as a double reaches. Any thread may call
 * these functions; std::lgamma is not used because it may write a global variable. */

namespace sensornoise
{

namespace detail
{
inline void
CheckDegreesOfFreedom(double dof)
{
  if (!(dof > 0.0) || !std::isfinite(dof))
  {
    throw std::invalid_argument("the degrees of freedom are " + std::to_string(dof) +
                                "; expected a finite number above 0");
  }
}

inline void
CheckProbability(double probability)
{
  if (!(probability >= 0.0 && probability <= 1.0))
  {
    throw std::invalid_argument("the probability is " + std::to_string(probability) + "; expected 0 to 1");
  }
}
} // namespace detail

/** Probability that chi-square with `dof` degrees of freedom is at most x.
 * \throws std::invalid_argument if dof is not above 0. */
inline double
ChiSquareCdf(double x, double dof)
{
  detail::CheckDegreesOfFreedom(dof);
  return detail::GammaTails(0.5 * dof, 0.5 * x).lower;
}

/** Probability that chi-square with `dof` degrees of freedom is above x.
 * \throws std::invalid_argument if dof is not above 0. */
inline double
ChiSquareUpper(double x, double dof)
{
  detail::CheckDegreesOfFreedom(dof);
  return detail::GammaTails(0.5 * dof, 0.5 * x).upper;
}

/** Probability that Student's t with `dof` degrees of freedom is at most t.
 * \throws std::invalid_argument if dof is not above 0. */
inline double
StudentCdf(double t, double dof)
{
  detail::CheckDegreesOfFreedom(dof);
  if (t == 0.0 || std::isnan(t))
  {
    return t == 0.0 ? 0.5 : t;
  }
  const double half = 0.5 * (std::isinf(t) ? 0.0 : detail::StudentTails(std::abs(t), dof).upper);
  return t < 0.0 ? half : 1.0 - half;
}

/** The z that a standard normal number exceeds with this probability; +-infinity for 0 and 1.
 * \throws std::invalid_argument if the probability is not from 0 to 1. */
inline double
NormalUpperQuantile(double probability)
{
  detail::CheckProbability(probability);
  if (probability > 0.5)
  {
    // 1 - probability is exact here.
    return -NormalUpperQuantile(1.0 - probability);
  }
  if (probability == 0.0)
  {
    return std::numeric_limits<double>::infinity();
  }
  // The tail is below exp(-z^2/2)/2 and its logarithm is concave: from here Newton's method comes down to the solution.
  constexpr double sqrtHalf = 0.70710678118654752440;
  constexpr double inverseSqrtTwoPi = 0.39894228040143267794;
  double           z = std::sqrt(-2.0 * std::log(2.0 * probability));
  for (int i = 0; i < 100; ++i)
  {
    const double tail = 0.5 * std::erfc(z * sqrtHalf);
    const double step = std::log(tail / probability) * tail / (inverseSqrtTwoPi * std::exp(-0.5 * z * z));
    if (!std::isfinite(step))
    {
      break;
    }
    z += step;
    if (std::abs(step) <= 1e-14 * (1.0 + z))
    {
      break;
    }
  }
  return z;
}

/** The z that a standard normal number stays below with this probability; -+infinity for 0 and 1.
 * \throws std::invalid_argument if the probability is not from 0 to 1. */
inline double
NormalQuantile(double probability)
{
  return -NormalUpperQuantile(probability);
}

namespace detail
{
/** The quantile of chi-square at which the smaller of its two tails is met. */
inline double
SolveChiSquare(double lower, double upper, double dof)
{
  CheckDegreesOfFreedom(dof);
  if (lower == 0.0 || upper == 0.0)
  {
    return lower == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
  }
  const bool isUpper = upper < lower;
  // Start: Wilson and Hilferty, PNAS 17(12), 1931, DOI 10.1073/pnas.17.12.684: (chi-square/dof)^(1/3) is nearly normal;
  // or where the first term of the series holds all of the lower tail, which is to the left of the solution.
  const double a = 0.5 * dof;
  const double variance = 2.0 / (9.0 * dof);
  const double z = isUpper ? NormalUpperQuantile(upper) : NormalQuantile(lower);
  const double root = std::max(0.0, 1.0 - variance + z * std::sqrt(variance));
  const double least = a < StirlingLeast ? 2.0 * std::exp((std::log(lower) + std::log(std::tgamma(a + 1.0))) / a) : 0.0;
  const double start = std::max(dof * root * root * root, least);
  if (start < std::numeric_limits<double>::min() && a < StirlingLeast)
  {
    return start;
  }
  return SolveTail(
    isUpper ? upper : lower,
    isUpper,
    start,
    [a](double x) { return GammaTails(a, 0.5 * x); },
    [a](double x) { return a * GammaTerm(a, 0.5 * x); });
}
} // namespace detail

/** The x that chi-square with `dof` degrees of freedom stays below with this probability; 0 and infinity for 0 and 1.
 * \throws std::invalid_argument if dof is not above 0 or the probability not from 0 to 1. */
inline double
ChiSquareQuantile(double probability, double dof)
{
  detail::CheckProbability(probability);
  return detail::SolveChiSquare(probability, 1.0 - probability, dof);
}

/** The x that chi-square with `dof` degrees of freedom exceeds with this probability; infinity and 0 for 0 and 1.
 * \throws std::invalid_argument if dof is not above 0 or the probability not from 0 to 1. */
inline double
ChiSquareUpperQuantile(double probability, double dof)
{
  detail::CheckProbability(probability);
  return detail::SolveChiSquare(1.0 - probability, probability, dof);
}

/** The t that Student's t with `dof` degrees of freedom stays below with this probability; -+infinity for 0 and 1. The
 * two-sided 95 % interval reaches to +-StudentQuantile(0.975, dof).
 * \throws std::invalid_argument if dof is not above 0 or the probability not from 0 to 1. */
inline double
StudentQuantile(double probability, double dof)
{
  detail::CheckDegreesOfFreedom(dof);
  detail::CheckProbability(probability);
  const double upper = 2.0 * std::min(probability, 1.0 - probability);
  const double sign = probability < 0.5 ? -1.0 : 1.0;
  if (upper == 0.0 || upper == 1.0)
  {
    return upper == 0.0 ? sign * std::numeric_limits<double>::infinity() : 0.0;
  }
  const double lower = 1.0 - upper;
  const bool   isUpper = upper < lower;
  return sign * detail::SolveTail(
                  isUpper ? upper : lower,
                  isUpper,
                  NormalUpperQuantile(0.5 * upper),
                  [dof](double t) { return detail::StudentTails(t, dof); },
                  [dof](double t) { return 2.0 * detail::StudentTerm(t, dof); });
}

} // namespace sensornoise

#endif
