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

/** A code, and of how many pixels it is an extreme over time. */
struct SeenCode
{
  std::int32_t  code;
  std::uint32_t pixels;
};

/** Finds the steps of \a codes, all that occur, ascending. Only neighbours tell that are the extreme of at least 8
 * pixels each: between such, no code is missing by chance. Averages over 12 and more of them are compared, so that
 * rescaled data, whose steps are irregular but the same everywhere, have no table. */
SensorNoise_EXPORT CodeSteps
FindCodeSteps(const std::vector<SeenCode> & codes);

} // namespace sensornoise

#endif
