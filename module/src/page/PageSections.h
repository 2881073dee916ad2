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

/** Returns a heading as HTML, with a \a tag from "h1" to "h3". \a words are plain text. */
std::string
Heading(const char * tag, const std::string & words);

/** Returns the whole HTML page around its \a body, with the style of the page and the figures. \a title is plain text.
 * \a style: "report" for a page of two columns, "" for a page of one. */
std::string
Page(const std::string & title, const std::string & body, const std::string & style);

/** Returns an HTML section that the reader can open. Its line has the \a title and, in a few words, the result, both as
 * plain text; \a body is HTML. */
std::string
Details(const std::string & title, const std::string & summary, const std::string & body);

/** Returns camera, ISO speed, exposure time, frames and bit depth, as plain text. Unknown ones are left out. */
std::string
FrameWords(const Report & report);

/** Returns the fraction of used pixels and, from 1 % on, the fraction of clipped pixels, as plain text that follows
 * FrameWords(). "" for a report without pixels. */
std::string
PixelWords(const Report & report);

/** Returns the line below the title as HTML: \a words, the date of the files ("": not known), and the version. */
std::string
TitleLine(const std::string & words, const std::string & date);

/** Returns the levels by exposure and their deviations from the line as an HTML table; "" if no exposures were given.
 */
std::string
LinearityTable(const Report & report);

/** Returns the gain of each part of the frame or of the burst, by partition, as an HTML table. "" if the gain is
 * uniform or not identified. */
std::string
PartsTable(const Report & report);

/** Returns an HTML table of the measured frames: number and size of their files or pixels, and their hash. A sentence
 * says how to compute the hash by hand. "" if there is no \a input. */
std::string
InputTable(const std::optional<InputRecord> & input);

/** Returns version, method, bit depth, quantization step, clip levels, and all settings as used, as an HTML table. */
std::string
SettingsTable(const Report & report);

} // namespace sensornoise

#endif
