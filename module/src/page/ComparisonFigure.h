// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_ComparisonFigure_h
#define sensornoise_page_ComparisonFigure_h

#include "page/Comparison.h"

#include <cstddef>
#include <string>

namespace sensornoise
{

/** Name of a row for a figure: its number, its label, shortened to fit, and the channel of a mosaic. */
std::string
RowName(const Comparison & comparison, std::size_t row);

/** Whether all rows are compared with the same one: the reports are of one channel. */
bool
HasOneFirst(const ComparedQuantity & quantity);

/** Whether any row has a value that can be drawn. */
bool
HasFigure(const Comparison & comparison, const ComparedQuantity & quantity);

/** One quantity: of each report the value and its 95 % interval, a line each, on one axis; words where there is no
 * value. The band is the interval of the first report, if all are compared with it. An SVG element for a page that has
 * FigureStyle. */
std::string
ComparisonFigure(const Comparison & comparison, const ComparedQuantity & quantity);

/** All quantities, one below the other, as an SVG file of its own. */
std::string
ComparisonAsSvgFile(const Comparison & comparison, const std::string & title);

} // namespace sensornoise

#endif
