// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_ReportTable_h
#define sensornoise_report_ReportTable_h

#include "SensorNoiseExport.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Report.h"

#include <cstddef>
#include <optional>
#include <string>

namespace sensornoise
{

/** The frames that were measured, or their files, with their hash: a line, with its end, for these and one for dark
 * ones;
 * "" where there is no \a input. */
std::string
DescribeInput(const std::optional<InputRecord> & input);

/** How well the line fits, how straight the response is, what the noise is taken for, and what the linearity error
 * rests on, each as a line without its end; "" where the report has nothing of it. */
std::string
DescribeFit(const Report & report);
std::string
DescribeResponse(const Report & report);
std::string
DescribeNoise(const Report & report);
std::string
DescribeLinearity(const Report & report);

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
