// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_ComparisonWords_h
#define sensornoise_page_ComparisonWords_h

#include "page/Comparison.h"
#include "page/Verdict.h"

#include <cstddef>
#include <string>

namespace sensornoise
{

/** Returns the name of a row: its number from 1, its label and the channel of a mosaic. */
std::string
NameOfRow(const Comparison & comparison, std::size_t row);

/** Returns a sentence on what changed. The severity is a warning if something changed. It is an error if no difference
 * has a standard error. */
Verdict
VerdictOf(const Comparison & comparison);

/** Returns the difference, for example "+0.0123 ± 0.0026 DN/e⁻"; "" if there is none. */
std::string
DifferenceText(const ComparedQuantity & quantity, std::size_t row);

/** Returns the relative difference, for example "+2.5 % of the first"; "" if Change::fraction is not known. */
std::string
FractionText(const ComparedQuantity & quantity, std::size_t row);

/** Returns the result of the comparison, for example "changed by more than its errors: 4.7 standard errors". */
std::string
VerdictText(const Comparison & comparison, const ComparedQuantity & quantity, std::size_t row);

/** Returns a sentence on the weighted mean of the reports of a channel and on their scatter. */
std::string
MeanSentence(const ComparedQuantity & quantity, const CommonMean & common);

/** Returns camera, ISO speed, exposure time, number and size of the frames, bit depth and method of a report. Unknown
 * ones are left out. */
std::string
StackText(const ComparedReport & row);

/** Returns the rules of the comparison as sentences. */
std::string
RuleText(const Comparison & comparison);

} // namespace sensornoise

#endif
