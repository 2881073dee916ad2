// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_NumberText_h
#define sensornoise_base_NumberText_h

#include "SensorNoiseExport.h"

#include <optional>
#include <string>

namespace sensornoise
{

/** Returns the shortest text that is read as this finite number again, with a point in every locale. */
SensorNoise_EXPORT std::string
ShortestText(double number);

/** Returns a finite number with \a decimals digits after the point, 0 to 20. */
SensorNoise_EXPORT std::string
FixedText(double number, int decimals);

/** Returns a finite number to \a digits digits, 1 to 17, with an exponent where it is large or small. */
SensorNoise_EXPORT std::string
GeneralText(double number, int digits);

/** Returns the number of a text, with a point in every locale; null for other texts, infinity and NaN. Blanks may stand
 * before the number, and nothing behind it. */
SensorNoise_EXPORT std::optional<double>
FiniteNumber(const std::string & text);

} // namespace sensornoise

#endif
