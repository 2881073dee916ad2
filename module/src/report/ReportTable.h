// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_ReportTable_h
#define sensornoise_report_ReportTable_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

#include <optional>
#include <string>

namespace sensornoise
{

/** The report as a table that a person can read: what was found, one line a quantity, no warnings. */
SensorNoise_EXPORT std::string
MakeTable(const Report & report);

/** The frames that were measured, or their files, with their hash: a line, with its end, for these and one for dark
 * ones;
 * "" where there is no \a input. */
std::string
DescribeInput(const std::optional<InputRecord> & input);

/** How well the line fits, how straight the response is, what the noise is taken for, and what the linearity error
 * rests on, each as a line without its end; "" where the report has nothing of it. */
std::string
DescribeFit(const Report & report);
std::string
DescribeResponse(const Report & report);
std::string
DescribeNoise(const Report & report);
std::string
DescribeLinearity(const Report & report);

/** A warning as a line: "warning: message [code]", with "note" or "error" where its severity is that. */
SensorNoise_EXPORT std::string
TextOf(const Warning & warning);

/** " (3 left out, 50 different)", of the frames given; "" where all are counted. */
SensorNoise_EXPORT std::string
TextOfCounted(const Report & report);

/** The table and, a line each, what the user should know: for those who see nothing else. */
SensorNoise_EXPORT std::string
MakeText(const Report & report);

} // namespace sensornoise

#endif
