// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_Companding_h
#define sensornoise_simulation_Companding_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"

#include <cstddef>

namespace sensornoise
{

/** \throws std::invalid_argument if the setting cannot be used with a converter of \a bitDepth bits. */
SensorNoise_EXPORT void
CheckSettings(const CompandingSettings & settings, unsigned int bitDepth);

/** Compands the codes and expands them again, in place [DN].
 * \param codesDn codes, which are clamped to 0 and 2^bitDepth - 1 first */
SensorNoise_EXPORT void
Compand(double * codesDn, std::size_t count, const CompandingSettings & settings, unsigned int bitDepth);

} // namespace sensornoise

#endif
