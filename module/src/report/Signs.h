// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_Signs_h
#define sensornoise_report_Signs_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <string>

namespace sensornoise
{

/** The text with the signs that people write (UTF-8) for those of ASCII that records have: "±", "e⁻", "²". */
SensorNoise_EXPORT std::string
WithSigns(std::string text);

/** Returns the text in ASCII, as far as this library writes it, for terminals that show nothing else. A sign may become
 * several letters. All but one of the blanks behind it may go, so that columns stay in line. */
SensorNoise_EXPORT std::string
WithoutSigns(const std::string & text);

/** Counts the characters of a text in UTF-8; a character may have several bytes. */
SensorNoise_EXPORT std::size_t
CharactersIn(const std::string & text);

/** Blanks behind the text up to \a width characters. */
SensorNoise_EXPORT std::string
PaddedRight(const std::string & text, std::size_t width);

/** Blanks before the text up to \a width characters. */
SensorNoise_EXPORT std::string
PaddedLeft(const std::string & text, std::size_t width);

} // namespace sensornoise

#endif
