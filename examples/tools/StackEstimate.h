// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef StackEstimate_h
#define StackEstimate_h

#include "sensornoise/report/Report.h"

namespace sensornoise
{
struct FrameList;
}

namespace sensornoise::tools
{
class MapFiles;
struct EstimateOptions;

/** Reads the frames, in parts, and measures what the options select of them. Writes the maps unless \a maps is null. */
Report
EstimateStack(const EstimateOptions & options, const FrameList & list, MapFiles * maps);

} // namespace sensornoise::tools

#endif
