// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ModelCheck_h
#define ModelCheck_h

#include "sensornoise/report/Report.h"
#include "sensornoise/stabilise/NoiseModelCheck.h"

#include <optional>
#include <string>

namespace sensornoise::tools
{
struct EstimateOptions;

/** Reads the frames of --check, or takes those of the report, and holds the report's model against them. Whatever
 * method the report is of, the frames are measured by the refined one. Null, and a sentence on standard error, where
 * the report has no model. */
std::optional<NoiseModelCheck>
CheckModel(const EstimateOptions & options, const Report & report);

/** The report as JSON, with the check as a member "check". */
std::string
ToJson(const Report & report, const std::optional<NoiseModelCheck> & check);

} // namespace sensornoise::tools

#endif
