/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
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
