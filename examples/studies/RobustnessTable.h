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
#ifndef RobustnessTable_h
#define RobustnessTable_h

#include "studies/RobustnessRun.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** What the columns of PrintRun are. */
void
PrintRunHeader(const std::string & method, std::size_t size);

void
PrintRun(const Run & run);

/** One line a case and reference: over the seeds, mean error and rms z, and the verdict. */
void
PrintSummary(const std::vector<Run> & runs);

} // namespace sensornoise::tools

#endif
