// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_PageSections_h
#define sensornoise_page_PageSections_h

#include "sensornoise/report/Report.h"

#include <string>
#include <vector>

namespace sensornoise
{

/** Sections of the page of a report, as HTML. */

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

/** Every setting as it was used, and the version of the program. */
std::string
SettingsTable(const Report & report);

} // namespace sensornoise

#endif
