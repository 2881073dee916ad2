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

/** Report of a monochrome sensor, or reports of the channels of a mosaic. */
using MeasuredStack = std::variant<Report, ChannelReports>;

/** Reads the frames in chunks, and measures the part that the options select. Writes the maps unless \a maps is
 * null. Makes the text of the plot unless \a plot is null. */
MeasuredStack
EstimateStack(const EstimateOptions & options, const FrameList & list, MapFiles * maps, std::string * plot = nullptr);

/** Throws std::exception unless the frames hold the region of --roi and --frames, are enough to be measured there, and
 * have the size of the mask. No pixel of the frames is read. */
void
RequireSelection(const EstimateOptions & options, const FrameList & list);

/** Returns the value of --bayer for the whole frame that gives the same channels again: a pattern, or "none". */
std::string
PatternOf(const EstimateOptions & options, const MeasuredStack & measured);

} // namespace sensornoise::tools

#endif
