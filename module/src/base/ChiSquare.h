// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_ChiSquare_h
#define sensornoise_base_ChiSquare_h

#include "SensorNoiseExport.h"

#include <algorithm>
#include <cmath>

/** \file
 * Chi-square, Student's and normal distributions, for any real number of degrees of freedom above 0.
 *
 * Each tail is computed directly, so that a small one keeps its digits. For 0.1 to 1e6 degrees of freedom the relative
 * error of probabilities is below 1e-10 down to 1e-300, and so is the error of quantiles within the range of a double.
 * Any thread may call these functions; std::lgamma is not used because it may write a global variable. */

namespace sensornoise
{

/** Probability that chi-square with `dof` degrees of freedom is at most x.
 * \throws std::invalid_argument if dof is not above 0. */
SensorNoise_EXPORT double
ChiSquareCdf(double x, double dof);

/** Probability that chi-square with `dof` degrees of freedom is above x.
 * \throws std::invalid_argument if dof is not above 0. */
SensorNoise_EXPORT double
ChiSquareUpper(double x, double dof);

/** Probability that Student's t with `dof` degrees of freedom is at most t.
 * \throws std::invalid_argument if dof is not above 0. */
SensorNoise_EXPORT double
StudentCdf(double t, double dof);

/** The z that a standard normal number exceeds with this probability; +-infinity for 0 and 1.
 * \throws std::invalid_argument if the probability is not from 0 to 1. */
SensorNoise_EXPORT double
NormalUpperQuantile(double probability);

/** The z that a standard normal number stays below with this probability; -+infinity for 0 and 1.
 * \throws std::invalid_argument if the probability is not from 0 to 1. */
SensorNoise_EXPORT double
NormalQuantile(double probability);

/** The x that chi-square with `dof` degrees of freedom stays below with this probability; 0 and infinity for 0 and 1.
 * \throws std::invalid_argument if dof is not above 0 or the probability not from 0 to 1. */
SensorNoise_EXPORT double
ChiSquareQuantile(double probability, double dof);

/** Returns the upper quantile of chi-square with `dof` degrees of freedom: the value that it exceeds with this
 * probability. Infinity and 0 for the probabilities 0 and 1.
 * \throws std::invalid_argument if dof is not above 0 or the probability not from 0 to 1. */
SensorNoise_EXPORT double
ChiSquareUpperQuantile(double probability, double dof);

/** Returns the quantile of Student's t with `dof` degrees of freedom for this probability; -+infinity for 0 and 1. The
 * two-sided 95 % interval reaches to +-StudentQuantile(0.975, dof).
 * \throws std::invalid_argument if dof is not above 0 or the probability not from 0 to 1. */
SensorNoise_EXPORT double
StudentQuantile(double probability, double dof);

/** Returns sqrt(a^2 + b^2 + c^2); infinite if one argument is infinite. In this case std::hypot() of three arguments
 * returns NaN in libstdc++, and an unknown error would be treated as no error. */
inline double
AddInQuadrature(double a, double b, double c)
{
  return std::hypot(std::hypot(a, b), c);
}

/** Variance of the logarithm of the variance of n normal values, truncated at 3 standard deviations, times n [1]: 2
 * without truncation. Closed form: 4 / (m4 - m2^2), of the moments of the truncated normal distribution. The variances
 * of the detail coefficients of a single image have this variance. */
inline constexpr double TruncatedVariance = 2.3085;

/** Returns the size of a difference beyond \a z standard deviations of its scatter: the root of difference^2 - z^2
 * variance, or 0 if this is negative. */
inline double
SizeBeyondChance(double difference, double variance, double z)
{
  return std::sqrt(std::max(0.0, difference * difference - z * z * variance));
}

} // namespace sensornoise

#endif
