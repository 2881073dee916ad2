// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Text_h
#define sensornoise_base_Text_h

#include "SensorNoiseExport.h"
#include "base/Constants.h"

#include <string>

namespace sensornoise
{

/** Returns a number that was given, to six digits. */
SensorNoise_EXPORT std::string
Text(double number);

/** Returns a number that was found, to three digits, or to integers where there are more. */
SensorNoise_EXPORT std::string
Rounded(double number);

/** Returns a number that was compared with \a bound. \a bound is written by Rounded(); the number gets as many more
 * digits as are needed for both to differ. */
SensorNoise_EXPORT std::string
RoundedApart(double number, double bound);

/** Returns a fraction as "4.43 %". */
SensorNoise_EXPORT std::string
Percent(double fraction);

/** Returns a fraction that was compared with \a bound, which is written by Percent(): "12.003 %" beside "12 %". */
SensorNoise_EXPORT std::string
PercentApart(double fraction, double bound);

/** Returns "0.1660 +- 0.0038": both to two digits of the error. */
SensorNoise_EXPORT std::string
Measured(double value, double standardError);

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
