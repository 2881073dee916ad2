// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef StackEstimate_h
#define StackEstimate_h

#include "sensornoise/ChannelReports.h"
#include "sensornoise/Report.h"

#include <string>
#include <variant>

namespace sensornoise
{
struct FrameList;
}

namespace sensornoise::tools
{
class MapFiles;
struct EstimateOptions;

/** What was measured: of a monochrome sensor, or of the channels of a mosaic. */
using MeasuredStack = std::variant<Report, ChannelReports>;

/** Reads the frames, in parts, and measures what the options select of them. Writes the maps unless \a maps is null,
 * and makes the text of the plot that the options ask for unless \a plot is null. */
MeasuredStack
EstimateStack(const EstimateOptions & options, const FrameList & list, MapFiles * maps, std::string * plot = nullptr);

/** The option --bayer that gives the same channels again: the pattern of the whole frame, or "none". */
std::string
PatternOf(const EstimateOptions & options, const MeasuredStack & measured);

} // namespace sensornoise::tools

#endif
