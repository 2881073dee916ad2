// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Text_h
#define sensornoise_base_Text_h

#include "SensorNoiseExport.h"

#include <string>

namespace sensornoise
{

/** A number that was given, to six digits. */
SensorNoise_EXPORT std::string
Text(double number);

/** A number that was found, to three digits, or to whole ones where there are more. */
SensorNoise_EXPORT std::string
Rounded(double number);

/** A number that was found to be beside \a bound, which is written by Rounded(): to as many more digits as the two need
 * to read differently. */
SensorNoise_EXPORT std::string
RoundedApart(double number, double bound);

/** A share as "4.43 %". */
SensorNoise_EXPORT std::string
Percent(double share);

/** A share that was found to be beside \a bound, which is written by Percent(): "12.003 %" beside "12 %". */
SensorNoise_EXPORT std::string
PercentApart(double share, double bound);

/** "0.1660 +- 0.0038": both to two digits of the error. */
SensorNoise_EXPORT std::string
Measured(double value, double standardError);

} // namespace sensornoise

#endif
