// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_PageSections_h
#define sensornoise_page_PageSections_h

#include "sensornoise/Report.h"

#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Sections of the page of a report, as HTML. */

/** A heading, \a tag "h1" to "h3". */
std::string
Heading(const char * tag, const std::string & words);

/** The whole page around its \a body, with the style of page and figures. */
std::string
Page(const std::string & title, const std::string & body);

/** How many frames of which size, codes and levels; method and pixels used. */
std::string
StackSentence(const Report & report);

std::string
QuantityTable(const Report & report);

/** Each with its severity, the numbers found, and what it means and what helps, errors first. "" where there are none.
 */
std::string
WarningList(const std::vector<Warning> & warnings);

std::string
EmvaTable(const Report & report);

/** The levels by exposure and their deviations from the line; "" where no exposures were given. */
std::string
LinearityTable(const Report & report);

/** The gain of each part of the frame or of the burst, by partition; "" where the gain is uniform. */
std::string
PartsTable(const Report & report);

/** The frames that were measured: their files' number, size and hash, and how it is computed by hand. "" where there is
 * no \a input. */
std::string
InputTable(const std::optional<InputRecord> & input);

/** Every setting as it was used, and the version of the program. */
std::string
SettingsTable(const Report & report);

} // namespace sensornoise

#endif
