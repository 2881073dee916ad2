// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorTable_h
#define RealSensorTable_h

#include "studies/RealSensorLines.h"
#include "studies/RealSensorRun.h"
#include "studies/RealSensorSetting.h"

#include <vector>

namespace sensornoise::tools
{

/** A setting and its stacks. */
struct RealSensorGroup
{
  RealSensorSetting              setting;
  std::vector<RealSensorOutcome> outcomes;
};

/** Prints the line's name and the names of the columns. */
void
PrintLineHeader(const RealSensorLine & line);

/** Prints a row about a setting. */
void
PrintGroup(const RealSensorGroup & group);

/** Prints a row about each stack of a setting. */
void
PrintStacks(const RealSensorGroup & group);

} // namespace sensornoise::tools

#endif
