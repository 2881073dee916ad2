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

/** Name of a row in words: its number, its label and the channel of a mosaic. */
std::string
NameOfRow(const Comparison & comparison, std::size_t row);

/** What changed, in a sentence: a warning where something did, an error where no two reports have a value of the same
 * quantity. */
Verdict
VerdictOf(const Comparison & comparison);

/** "+0.0123 ± 0.0026 DN/e⁻"; "" where there is no difference. */
std::string
DifferenceText(const ComparedQuantity & quantity, std::size_t row);

/** "+2.5 % of the first"; "" where the first is too small to compare with. */
std::string
ShareText(const ComparedQuantity & quantity, std::size_t row);

/** "changed by more than its errors: 4.7 of them", and so on. */
std::string
JudgementText(const Comparison & comparison, const ComparedQuantity & quantity, std::size_t row);

/** What the reports of a channel have in common, as a sentence. */
std::string
MeanSentence(const ComparedQuantity & quantity, const CommonMean & common);

/** Camera, ISO, exposure, frames and method of a row. */
std::string
StackText(const ComparedReport & row);

/** How changes are judged, as sentences. */
std::string
RuleText(const Comparison & comparison);

} // namespace sensornoise

#endif
