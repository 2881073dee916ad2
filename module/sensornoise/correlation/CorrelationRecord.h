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
#ifndef sensornoise_correlation_CorrelationRecord_h
#define sensornoise_correlation_CorrelationRecord_h

#include "SensorNoiseExport.h"
#include "sensornoise/correlation/NoiseCorrelation.h"
#include "sensornoise/report/Report.h"

namespace sensornoise
{

/** The record of what neighbours and frames share. Where it was not measured, the kind alone is filled. */
SensorNoise_EXPORT NoiseCorrelationRecord
RecordOf(const NoiseCorrelation & correlation);

} // namespace sensornoise

#endif
