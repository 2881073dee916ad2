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
#ifndef sensornoise_report_ReportTable_h
#define sensornoise_report_ReportTable_h

#include "SensorNoiseExport.h"
#include "sensornoise/report/Report.h"

#include <string>

namespace sensornoise
{

/** The report as a table that a person can read: what was found, one line a quantity, no warnings. */
SensorNoise_EXPORT std::string
MakeTable(const Report & report);

/** The table and, a line each, what the user should know: for those who see nothing else. */
SensorNoise_EXPORT std::string
MakeText(const Report & report);

} // namespace sensornoise

#endif
