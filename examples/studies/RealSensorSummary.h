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
