// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_ComparisonPage_h
#define sensornoise_page_ComparisonPage_h

#include "SensorNoiseExport.h"
#include "page/Comparison.h"

#include <string>

namespace sensornoise
{

/** Reports side by side as one HTML page that needs nothing else: what changed by more than its errors, in a sentence,
 * and of each quantity a figure and a table of values and differences. */
SensorNoise_EXPORT std::string
ToHtml(const Comparison & comparison);

/** The figures of the page as one SVG file. */
SensorNoise_EXPORT std::string
ToSvg(const Comparison & comparison);

/** The same in letters of ASCII, a line a report and quantity. */
SensorNoise_EXPORT std::string
MakeText(const Comparison & comparison);

} // namespace sensornoise

#endif
