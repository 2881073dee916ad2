// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_QuantityTable_h
#define sensornoise_page_QuantityTable_h

#include "sensornoise/Report.h"

#include <string>

namespace sensornoise
{

/** Whether any quantity of the report has a value or a limit. */
bool
HasValues(const Report & report);

/** Gain, read noise and offset as three cards: the value with its error and unit, and its 95 % interval or its status.
 * "" where no quantity has a value. */
std::string
KeyNumbers(const Report & report);

/** All quantities in three groups: the sensor, illumination and motion, and for a denoiser. Each has its value, its
 * error, its unit, and its 95 % interval or its status. */
std::string
QuantityTable(const Report & report);

std::string
EmvaTable(const Report & report);

} // namespace sensornoise

#endif
