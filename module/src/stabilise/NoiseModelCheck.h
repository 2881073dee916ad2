// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_stabilise_NoiseModelCheck_h
#define sensornoise_stabilise_NoiseModelCheck_h

#include "sensornoise/NoiseModel.h"

#include <functional>
#include <string>

/** \file
 * The check of a variance of any form on frames, and its result in words. */

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

} // namespace sensornoise

#endif
