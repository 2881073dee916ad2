// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_stabilise_NoiseModelCheck_h
#define sensornoise_stabilise_NoiseModelCheck_h

#include "sensornoise/NoiseModel.h"
#include "SensorNoiseExport.h"

#include <functional>
#include <string>

/** \file
 * The check of a variance of any form on frames, its result in words, and the law of stabilised pixels. */

namespace sensornoise
{

/** The variance of a pixel [DN^2] as a function of its level [DN]. A variance of 0 or less counts as none. */
using VarianceModel = std::function<double(double levelDn)>;

/** Compares the noise of frames with a variance of any form, as CheckNoiseModel() does with a line. A band fits if its
 * ratio is within the tolerance of 1, or within four standard errors. Band::transformVariance is null.
 * \param frames report of the refined method on the frames
 * \param model variance
 * \param tolerance deviation of the ratio from 1 that is accepted at a level, whatever its error [1] */
SensorNoise_EXPORT NoiseModelCheck
CheckVariance(const Report & frames, const VarianceModel & model, const std::function<double(double)> & tolerance);

/** Returns a level with as many digits as a reader needs, with commas: 3,000. */
std::string
LevelText(double levelDn);

/** Returns the result of a check in one sentence: the ranges of levels in which the variance agrees with the model, and
 * those in which it does not. Each range has its ratio, with the larger of the ratio's error and the scatter of its
 * bands. The warnings of \a frames give the reason if nothing was measured. */
std::string
MakeCheckSentence(const NoiseModelCheck & check, const Report & frames);

/** Moments of the stabilised values of one pixel, after the generalized Anscombe transform, by numerical integration:
 * the reference for its closed-form inverse and for measured variances.
 *
 * A value in electrons is z = N + sigma n, where N has a Poisson distribution of mean lambda and n is standard normal.
 * Its transform is f = 2 sqrt(max(0, z + 3/8 + sigma^2)). The errors of D and of the variance are below 1e-10. */
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

} // namespace sensornoise

#endif
