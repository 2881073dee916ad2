// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_FaintFlicker_h
#define sensornoise_base_FaintFlicker_h

#include "base/Significance.h"
#include "base/Text.h"

#include <string>

namespace sensornoise
{

/** Returns a clause that says why the flicker does not determine the offset. \a flickerZ is the excess of the variance
 * of the flicker over its noise, in standard deviations [1]. */
inline std::string
DescribeInsignificantFlicker(double flickerZ)
{
  return flickerZ > 0.0
           ? "the flicker is only " + RoundedApart(flickerZ, Significance.everyPixel) +
               " standard errors above its noise (more than " + Rounded(Significance.everyPixel) + " needed)"
           : "the flicker is below its noise";
}

} // namespace sensornoise

#endif
