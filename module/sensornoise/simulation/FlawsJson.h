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
#ifndef sensornoise_simulation_FlawsJson_h
#define sensornoise_simulation_FlawsJson_h

#include "SensorNoiseExport.h"
#include "sensornoise/report/JsonWriter.h"
#include "sensornoise/simulation/SensorFlaws.h"

namespace sensornoise
{

/** The settings of the flaws, a member for each piece, by the names of the settings without their units: DN, electrons,
 * pixels and rows as there. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const SensorFlaws & flaws);

} // namespace sensornoise

#endif
