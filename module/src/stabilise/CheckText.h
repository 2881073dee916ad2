// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_stabilise_CheckText_h
#define sensornoise_stabilise_CheckText_h

#include "sensornoise/NoiseModel.h"

#include <string>

namespace sensornoise
{

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
