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
#ifndef EfficiencyTable_h
#define EfficiencyTable_h

#include "studies/EfficiencyStatistics.h"

#include <string>
#include <vector>

namespace sensornoise::tools
{

void
PrintEfficiencyHeader();

/** One line a parameter; none for no runs. Over several experiments, \a isPooled, the rms error is relative and there
 * is no one truth. */
void
PrintEfficiencyRows(const std::vector<const EfficiencyRun *> & runs, const std::string & label, bool isPooled);

/** Every single run, one line a parameter. Throws std::runtime_error if the file cannot be written. */
void
WriteEfficiencyCsv(const std::string & name, const std::vector<EfficiencyRun> & runs);

} // namespace sensornoise::tools

#endif
