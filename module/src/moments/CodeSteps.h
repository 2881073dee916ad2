// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_CodeSteps_h
#define sensornoise_moments_CodeSteps_h

#include "sensornoise/StepResults.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** A digital number [DN], and the number of pixels that have it as an extreme over time. */
struct SeenCode
{
  std::int32_t  code;
  std::uint32_t pixels;
};

/** Finds the local quantization steps of \a codes: all digital numbers that occur, ascending.
 *
 * Only neighbouring codes that are the extreme of at least 8 pixels each are used: between them no code is missing by
 * chance. Means of at least 12 distances are compared. Rescaled data, whose steps are irregular but the same
 * everywhere, therefore have no table. */
SensorNoise_EXPORT CodeSteps
FindCodeSteps(const std::vector<SeenCode> & codes);

} // namespace sensornoise

#endif
