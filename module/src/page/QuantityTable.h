// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_QuantityTable_h
#define sensornoise_page_QuantityTable_h

#include "sensornoise/Report.h"

#include <string>

namespace sensornoise
{

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
