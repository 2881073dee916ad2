// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_stabilise_PoissonGaussianLaw_h
#define sensornoise_stabilise_PoissonGaussianLaw_h

#include "SensorNoiseExport.h"

namespace sensornoise
{

/** \file
 * What the generalized Anscombe transform makes of a pixel's law, by numerical integration: the yardstick for its
 * closed-form inverse and for measured variances.
 *
 * The law, in electrons, is z = N + sigma n with N of Poisson's law with mean lambda, and n standard normal;
 * f = 2 sqrt(max(0, z + 3/8 + sigma^2)). Errors below 1e-10 of D and of the variance. */

/** Of one pixel's stabilised values. */
struct StabilisedMoments
{
  double mean;          ///< D = E f
  double variance;      ///< var f; 1 were the transform perfect
  double negativeShare; ///< probability that the argument of the root is negative, and f 0
};

/** Moments of the stabilised values of a pixel with a mean of \a electrons, 0 to 1e6, and a read noise of
 * \a readNoiseElectrons, 0 to 1000. Throws std::invalid_argument outside. */
SensorNoise_EXPORT StabilisedMoments
MomentsOfStabilised(double electrons, double readNoiseElectrons);

/** The exact unbiased inverse: lambda [e-] of a mean D; 0 where D is not above that of no light. */
SensorNoise_EXPORT double
ExactUnbiasedInverse(double stabilisedMean, double readNoiseElectrons);

} // namespace sensornoise

#endif
