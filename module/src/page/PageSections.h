// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_PageSections_h
#define sensornoise_page_PageSections_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/ReportPage.h"

#include <optional>
#include <string>
#include <vector>

/** \file
 * Texts and sections of a page as HTML: the verdict and the warnings, tables, and pictures of the maps. */

namespace sensornoise
{

/** Returns \a text for HTML and SVG: &, <, > and quotes are escaped, and control characters are replaced by spaces,
 * because XML forbids most of them. */
std::string
Escaped(const std::string & text);

/** Returns \a text escaped, with `names` as code. */
std::string
WithCode(const std::string & text);

/** Returns \a text escaped, with indices: "mu_y.dark" is mu with the index y.dark. An index has letters, digits and
 * full stops. */
std::string
WithIndices(const std::string & text);

/** Returns a figure with its \a caption, which is HTML; "": without a caption. */
std::string
FigureElement(const std::string & svg, const std::string & caption);

/** Returns HTML in which no line ends behind a "±". */
std::string
Unbroken(std::string html);

/** Returns a unit of QuantityList() for people: "DN²", "DN/e⁻", and "" for "1". */
std::string
UnitText(const std::string & unit);

/** Returns a label of QuantityList() for people: "offset μ", "intercept σ² − g μ". */
std::string
LabelText(const std::string & label);

/** Returns the message of a warning as a sentence: with a capital, a full stop, and signs for " +- ", "chi2", "^2" and
 * "/e-". */
std::string
SentenceText(const std::string & message);

/** Returns the value, for example "5.0004 ± 0.0026", rounded to two digits of the error. An upper limit is "< 1.3", and
 * "–" replaces an unknown value. */
std::string
ValueText(const Quantity & quantity);

/** Returns the 95 % interval, or the bounds if there is none, for example "4.9953 to 5.0056", "at most 1.3" or "at
 * least 2". It is rounded to the second digit of the error. "" if neither is known. */
std::string
RangeText(const Quantity & quantity);

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

/** Result of a measurement or of a comparison. */
struct Verdict
{
  Severity    severity; ///< Error: no result; Warning: a warning or a change; Note: neither
  std::string sentence; ///< the result, as plain text
};

/** Returns the gain and, if it is known, the read noise of a report as a sentence. Without a gain the sentence has the
 * message of the first error, and the severity is an error. */
Verdict
VerdictOf(const Report & report);

/** Returns the worst severity of the channels: an error if a channel has no gain. The warnings about all channels count
 * as warnings at most. */
Severity
SeverityOf(const ChannelReports & reports);

/** Message of a warning in two parts, as sentences of plain text. */
struct WarningParts
{
  std::string finding; ///< observation, and why it matters
  std::string action;  ///< command to the user
};

/** Divides the message of a warning. The action is its last sentences that begin with a command, or a command behind
 * its last colon. Without one, the warning gets the action of WarningTable. */
SensorNoise_EXPORT WarningParts
SplitWarning(const Warning & warning);

/** Returns one HTML box for each code, errors first: its name, the findings, and the action. The code is the address of
 * the box, for example "#few-frames". "" if there are no \a warnings. */
SensorNoise_EXPORT std::string
WarningBoxes(const std::vector<Warning> & warnings);

/** Returns the verdict in one sentence as HTML, with links to the warnings of its severity. */
SensorNoise_EXPORT std::string
VerdictBox(const Report & report);
std::string
VerdictBox(const ChannelReports & reports);

/** Returns a quantity as a row of a table in HTML, with its value, error and unit, and its 95 % interval or status.
 * \a label is plain text; \a meaning, in small letters below it, is HTML. \a unit: as in QuantityList(). */
std::string
QuantityRow(const std::string & label,
            const std::string & meaning,
            const Quantity &    quantity,
            const std::string & unit);

/** Returns rows of a table of quantities below a \a title, which is plain text. "" if there are no \a rows. */
std::string
QuantityGroupRows(const std::string & title, const std::string & rows);

/** Returns the table of quantities around its \a groups of rows. */
std::string
TableOfGroups(const std::string & groups);

/** Returns a quantity as a card in HTML, with its value, error and unit, and below it the 95 % interval or the status.
 * \a name and \a besides, words behind the interval, are plain text. \a unit: as in QuantityList(). */
std::string
KeyCard(const std::string & name,
        const Quantity &    quantity,
        const std::string & unit,
        const std::string & besides = "");

/** Returns whether any quantity of the report has a value or an upper limit. */
bool
HasValues(const Report & report);

/** Returns gain, read noise and offset as three cards in HTML. Each has the value with its error and unit, and its 95 %
 * interval or its status. "" if no quantity has a value. */
std::string
KeyNumbers(const Report & report);

/** Returns the quantities as an HTML table in three groups: sensor, illumination and motion, noise model for a
 * denoiser. Each has its value, error and unit, and its 95 % interval or status. */
std::string
QuantityTable(const Report & report);

/** Returns the quantities of EMVA 1288 as an HTML table. Values that are computed by the linear model are marked by
 * "≈". */
std::string
EmvaTable(const Report & report);

/** Returns the mean image as an HTML figure of at most 256 x 256 points. A point is the mean of its finite pixels. Grey
 * is from the 0.002 to the 0.998 quantile of the points. "" if there is no mean image. Throws as PixelUsePicture(). */
std::string
MeanPicture(const PageMaps & maps);

/** Returns the map of pixel use with its legend as an HTML figure of at most 256 x 256 points. A point is "used" if
 * more than seven eighths of its pixels are used. Otherwise it has the most frequent other use. "" if there is no map.
 * Throws std::runtime_error if zlib cannot compress the picture. */
std::string
PixelUsePicture(const PageMaps & maps);

} // namespace sensornoise

#endif
