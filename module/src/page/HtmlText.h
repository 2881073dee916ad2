// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_HtmlText_h
#define sensornoise_page_HtmlText_h

#include "sensornoise/Report.h"

#include <string>

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

} // namespace sensornoise

#endif
