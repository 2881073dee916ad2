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

/** A share as "4.43 %". */
SensorNoise_EXPORT std::string
Percent(double share);

/** "0.1660 +- 0.0038": both to two digits of the error. */
SensorNoise_EXPORT std::string
Measured(double value, double standardError);

} // namespace sensornoise

#endif
