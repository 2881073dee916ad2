// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_ReportTable_h
#define sensornoise_report_ReportTable_h

#include "SensorNoiseExport.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Report.h"

#include <optional>
#include <string>

namespace sensornoise
{

/** Returns the row of a quantity in a table: label, value, error, unit, status, and interval or limits, with a line
 * break. \a hasErrors: the table has a column for the standard error. */
SensorNoise_EXPORT std::string
QuantityLine(const std::string & label, const std::string & unit, const Quantity & quantity, bool hasErrors);

/** Returns the identification of the measured frames, and of the dark frames if there are any: number of files, bytes
 * and SHA-256. Each is one line with its line break. "": \a input is null. */
std::string
DescribeInput(const std::optional<InputRecord> & input);

/** Returns the quality of the fits: reduced chi-square of the variance about its line, and phi of the offset line. This
 * and the next functions return one line without a line break. "": not measured. */
std::string
DescribeFit(const Report & report);
/** Returns the largest relative deviation of the variance from its line. */
std::string
DescribeResponse(const Report & report);
/** Returns the noise class, with the largest correlation coefficient, and its effect on the gain. */
std::string
DescribeNoise(const Report & report);
/** Returns the number of exposures that the linearity error is measured from, with saturation level and source of the
 * offset; or the reason for which there is no linearity error. */
std::string
DescribeLinearity(const Report & report);

} // namespace sensornoise

#endif
