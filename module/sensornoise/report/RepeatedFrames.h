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
#ifndef sensornoise_report_RepeatedFrames_h
#define sensornoise_report_RepeatedFrames_h

#include "SensorNoiseExport.h"
#include "sensornoise/moments/DistinctFrames.h"
#include "sensornoise/report/Report.h"

namespace sensornoise
{

/** Makes of the report of the distinct frames that of the frames given: their number, the series with the values of a
 * frame's original, and the warning `repeated-frames` if any is equal to an earlier one. */
SensorNoise_EXPORT void
ReportAllFrames(Report & report, const DistinctFrames & frames);

} // namespace sensornoise

#endif
