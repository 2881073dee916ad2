// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_RequiredFlickerZ_h
#define sensornoise_base_RequiredFlickerZ_h

#include "sensornoise/base/Text.h"

#include <string>

namespace sensornoise
{

/** The flicker tells offset and read noise if its variance exceeds that of its sampling noise by more than this many
 * standard deviations of the latter: of v^* (published), or of the frames along the offset line (refined). */
inline constexpr double RequiredFlickerZ = 6.0;

/** That the flicker does not, as a sentence without its end. */
inline std::string
TextOfFaintFlicker(double flickerZ)
{
  return flickerZ > 0.0 ? "the flicker's variance exceeds that of its noise by " + Rounded(flickerZ) +
                            " standard deviations (expected more than " + Text(RequiredFlickerZ) + ")"
                        : "the flicker is lost in its noise";
}

} // namespace sensornoise

#endif
