// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_stabilise_VarianceCheck_h
#define sensornoise_stabilise_VarianceCheck_h

#include "sensornoise/NoiseModel.h"

#include <functional>

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

} // namespace sensornoise

#endif
