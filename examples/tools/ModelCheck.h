// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ModelCheck_h
#define ModelCheck_h

#include "sensornoise/NoiseModel.h"
#include "tools/StackEstimate.h"

#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{
struct EstimateOptions;

/** The check of a report, or of each channel's; null where a report has no model. */
using ModelChecks = std::vector<std::optional<NoiseModelCheck>>;

/** Reads the frames of --check, or takes those of the report, and holds the report's model against them; channel by
 * channel, where it has some. Says on standard error where a report has no model. */
ModelChecks
CheckModel(const EstimateOptions & options, const MeasuredStack & measured);

/** The report as JSON, with the check as a member "check"; of channels "checks", one each. None, if \a checks is empty.
 */
std::string
ToJson(const MeasuredStack & measured, const ModelChecks & checks);

/** The report as a table, then its checks. */
std::string
MakeTable(const MeasuredStack & measured, const ModelChecks & checks);

} // namespace sensornoise::tools

#endif
