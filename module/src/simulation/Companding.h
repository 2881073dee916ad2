// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_Companding_h
#define sensornoise_simulation_Companding_h

#include "SensorNoiseExport.h"

#include <cstddef>

namespace sensornoise
{

/** Square-root companding, as automotive sensors and compressed raw formats do to save bits: codes from 0 to the
 * converter's top are stored as round(sqrt(code / top) (2^bits - 1)) and expanded again. The step of the expanded codes
 * grows with the root of the level, as shot noise does: near level v it is 2 sqrt(v top) / (2^bits - 1). */
struct CompandingSettings
{
  /** Bits of the stored codes, 2 to 16; 0: no companding. */
  unsigned int bits{ 0 };

  bool
  IsOn() const
  {
    return bits > 0;
  }
};

/** \throws std::invalid_argument if the setting cannot be used with a converter of \a bitDepth bits. */
SensorNoise_EXPORT void
CheckSettings(const CompandingSettings & settings, unsigned int bitDepth);

/** Companded and expanded again, in place [DN]. \param codesDn cut to 0 and 2^bitDepth - 1 first */
SensorNoise_EXPORT void
Compand(double * codesDn, std::size_t count, const CompandingSettings & settings, unsigned int bitDepth);

} // namespace sensornoise

#endif
