// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorSummary_h
#define RealSensorSummary_h

#include "studies/RealSensorLines.h"
#include "studies/RealSensorTable.h"

#include <vector>

namespace sensornoise::tools
{

/** Prints what the stacks of a line show together: coverage of every quantity, and each demand with its share. */
void
PrintLineSummary(const RealSensorLine & line, const std::vector<RealSensorGroup> & groups);

} // namespace sensornoise::tools

#endif
