// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_DistributionTails_h
#define sensornoise_base_DistributionTails_h

#include "SensorNoiseExport.h"

/** \file
 * Incomplete gamma and beta functions, on which ChiSquare is based. */

namespace sensornoise
{

/** Least argument for which Stirling's series yields all digits. */
inline constexpr double StirlingLeast = 16.0;

/** Both tails of a distribution at one point. */
struct Tails
{
  double lower;
  double upper;
};

/** Returns x^a exp(-x) / Gamma(a + 1), for x > 0. For large a the huge factors are never computed. With x = a (1 + u)
 * their product is exp(-a (u - log(1 + u))) / sqrt(2 pi a), up to Stirling's remainder. */
SensorNoise_EXPORT double
GammaTerm(double a, double x);

/** Regularised incomplete gamma functions P(a, x) and Q(a, x): the series https://dlmf.nist.gov/8.11.E4 below the mean,
 * the continued fraction https://dlmf.nist.gov/8.9.E2 (contracted) above it. */
SensorNoise_EXPORT Tails
GammaTails(double a, double x);

/** Returns t times the density of Student's t, for t > 0. */
SensorNoise_EXPORT double
StudentTerm(double t, double dof);

/** Returns the probability that |t| is below (lower) and above (upper) a t > 0. These are the regularised incomplete
 * beta functions I_x(1/2, dof/2) and I_1-x(dof/2, 1/2) at x = t^2 / (dof + t^2), by https://dlmf.nist.gov/8.17.E22. */
SensorNoise_EXPORT Tails
StudentTails(double t, double dof);

} // namespace sensornoise

#endif
