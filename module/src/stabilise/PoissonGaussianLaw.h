// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_stabilise_PoissonGaussianLaw_h
#define sensornoise_stabilise_PoissonGaussianLaw_h

#include "SensorNoiseExport.h"

namespace sensornoise
{

/** \file
 * Moments of a pixel after the generalized Anscombe transform, by numerical integration: the reference for its
 * closed-form inverse and for measured variances.
 *
 * A value in electrons is z = N + sigma n, where N has a Poisson distribution of mean lambda and n is standard normal.
 * Its transform is f = 2 sqrt(max(0, z + 3/8 + sigma^2)). The errors of D and of the variance are below 1e-10. */

/** Moments of the stabilised values of one pixel. */
struct StabilisedMoments
{
  double mean;                ///< D = E f
  double variance;            ///< var f; 1 for a perfect transform
  double negativeProbability; ///< probability that the argument of the root is negative, so that f = 0 [1]
};

/** Returns the moments for a pixel with a mean of \a electrons, 0 to 1e6 [e-], and a read noise of
 * \a readNoiseElectrons, 0 to 1000 [e-]. Throws std::invalid_argument outside of these ranges. */
SensorNoise_EXPORT StabilisedMoments
MomentsOfStabilised(double electrons, double readNoiseElectrons);

/** Returns the exact unbiased inverse: lambda for a mean D [e-]; 0 if D is not above its value without signal.
 * \a readNoiseElectrons is 0 to 1000 [e-]. */
SensorNoise_EXPORT double
ExactUnbiasedInverse(double stabilisedMean, double readNoiseElectrons);

} // namespace sensornoise

#endif
