// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_FaintFlicker_h
#define sensornoise_base_FaintFlicker_h

#include "base/Significance.h"
#include "base/Text.h"

#include <string>

namespace sensornoise
{

/** That the flicker does not tell the offset, as a sentence without its end. \a flickerZ is by how many standard
 * deviations of its noise's variance the flicker's exceeds it. */
inline std::string
TextOfFaintFlicker(double flickerZ)
{
  return flickerZ > 0.0
           ? "the flicker is only " + RoundedApart(flickerZ, Significance.everyPixel) +
               " standard errors above its noise (more than " + Rounded(Significance.everyPixel) + " needed)"
           : "the flicker is below its noise";
}

} // namespace sensornoise

#endif
