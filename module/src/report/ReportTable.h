// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_ReportTable_h
#define sensornoise_report_ReportTable_h

#include "sensornoise/ReportText.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

#include <optional>
#include <string>

namespace sensornoise
{

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

} // namespace sensornoise

#endif
