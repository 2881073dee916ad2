// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_TextSigns_h
#define sensornoise_report_TextSigns_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <string>

namespace sensornoise
{

/** Returns the text with signs in UTF-8 ("±", "e⁻", "²") instead of their ASCII form in records ("+-", "e-", "^2"). */
SensorNoise_EXPORT std::string
WithSigns(std::string text);

/** Returns the text in ASCII, for terminals that show nothing else. It replaces the signs that this library writes. A
 * sign may become several letters; as many of the next repeated blanks are removed, so that columns stay aligned. */
SensorNoise_EXPORT std::string
WithoutSigns(const std::string & text);

/** Returns the number of characters of a text in UTF-8. A character may have several bytes. */
SensorNoise_EXPORT std::size_t
CharactersIn(const std::string & text);

/** Returns the text, followed by blanks up to \a width characters. */
SensorNoise_EXPORT std::string
PaddedRight(const std::string & text, std::size_t width);

/** Returns the text, preceded by blanks up to \a width characters. */
SensorNoise_EXPORT std::string
PaddedLeft(const std::string & text, std::size_t width);

} // namespace sensornoise

#endif
