// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ModelCheck_h
#define ModelCheck_h

#include "sensornoise/NoiseModel.h"
#include "tools/StackEstimate.h"

#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{
struct FrameList;
}

namespace sensornoise::tools
{
struct EstimateOptions;

/** Check of the report, or of the report of each channel. An entry is empty if its report has no model. */
using ModelChecks = std::vector<std::optional<NoiseModelCheck>>;

/** Returns the reports of the channels, or the only report. */
std::vector<const Report *>
ReportsOf(const MeasuredStack & measured);

/** Opens the frames of --check before the frames of the report are measured. Prints a warning about the files. Throws
 * std::runtime_error if they cannot be read, are too few, or lack the region or the size of the mask. */
FrameList
OpenFramesToCheck(const EstimateOptions & options);

/** Compares the model of a report with \a frames, of --check or of the report itself, channel by channel. A report
 * without a model, and frames that cannot be measured, are reported on standard error. */
ModelChecks
CheckModel(const EstimateOptions & options, const MeasuredStack & measured, const FrameList & frames);

/** Returns the report as JSON. The check is added as the member "check", or as "checks" for several channels, the check
 * of a profile as "profile_check" or "profile_checks". Without a check no member is added. */
std::string
ToJson(const MeasuredStack & measured, const ModelChecks & checks, const ModelChecks & profileChecks);

/** Returns the report as a table, followed by the checks of the report and of a profile. */
std::string
MakeTable(const MeasuredStack & measured, const ModelChecks & checks, const ModelChecks & profileChecks);

} // namespace sensornoise::tools

#endif
