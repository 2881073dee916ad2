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
#ifndef sensornoise_simulation_TruthJson_h
#define sensornoise_simulation_TruthJson_h

#include "SensorNoiseExport.h"
#include "sensornoise/simulation/SimulationTruth.h"

#include <cstddef>
#include <string>

namespace sensornoise
{

/** The truth of a simulated stack as JSON, schema "itk-sensornoise-truth/1": every parameter by the names of the
 * report, and the random series. Numbers that do not exist (a standard deviation of one frame) are null. */
SensorNoise_EXPORT std::string
ToJson(const SimulationTruth & truth, std::size_t width, std::size_t height);

} // namespace sensornoise

#endif
