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

/** The whole page around its \a body, with the style of page and figures. \a style: "report" for a page of two
 * columns, "" for a page of one. */
std::string
Page(const std::string & title, const std::string & body, const std::string & style);

/** A part of the page that the reader opens. Its line has the \a title and, in a few words, the result. */
std::string
Details(const std::string & title, const std::string & summary, const std::string & body);

/** Camera, frames and bits, as plain text. */
std::string
FrameWords(const Report & report);

/** The fraction of the pixels that is used, and the fraction that is clipped from 1 % on, to follow FrameWords(). "" of
 * a report without pixels. */
std::string
PixelWords(const Report & report);

/** The line below the title: \a words, the date of the files ("": not known), and the version. */
std::string
TitleLine(const std::string & words, const std::string & date);

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

/** Version, method, properties of the digital numbers, and every setting as it was used. */
std::string
SettingsTable(const Report & report);

} // namespace sensornoise

#endif
