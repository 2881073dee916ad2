// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_QuantityTable_h
#define sensornoise_page_QuantityTable_h

#include "sensornoise/Report.h"

#include <string>

namespace sensornoise
{

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

} // namespace sensornoise

#endif
