// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_stabilise_CheckSentence_h
#define sensornoise_stabilise_CheckSentence_h

#include "sensornoise/NoiseModel.h"

#include <string>

namespace sensornoise
{

/** What a check found, in one sentence: the ranges of levels in which the variance is what the model says, and those in
 * which it is not, each with its ratio and the larger of its error and what its bands differ by. \a frames tells why
 * nothing was measured. */
std::string
MakeCheckSentence(const NoiseModelCheck & check, const Report & frames);

} // namespace sensornoise

#endif
