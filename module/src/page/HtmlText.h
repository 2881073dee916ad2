// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_HtmlText_h
#define sensornoise_page_HtmlText_h

#include "sensornoise/Report.h"

#include <string>

namespace sensornoise
{

/** \a text with &, <, > and quotes as HTML and SVG want them; control characters, which XML has none of, as spaces. */
std::string
Escaped(const std::string & text);

/** Returns \a text escaped, with `names` as code. */
std::string
WithCode(const std::string & text);

/** Returns HTML in which no line ends behind a "±". */
std::string
Unbroken(std::string html);

/** A unit of QuantityList() as people write it: "DN²", "DN/e⁻", and "" for "1". */
std::string
UnitText(const std::string & unit);

/** A label of QuantityList() as people write it: "offset μ", "intercept σ² - g μ". */
std::string
LabelText(const std::string & label);

/** A message of a warning as a sentence: with a capital, a full stop, and signs for "+-", "chi2", "^2" and "/e-". */
std::string
SentenceText(const std::string & message);

/** "5.0004 ± 0.0026", both to two digits of the error; "< 1.3" of an upper limit; "–" where there is no value. */
std::string
ValueText(const Quantity & quantity);

/** The 95 % interval, else the physical limits, to the same place as the error: "4.9953 to 5.0056". "" where there are
 * none. */
std::string
RangeText(const Quantity & quantity);

} // namespace sensornoise

#endif
