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
#ifndef sensornoise_simulation_FixedPattern_h
#define sensornoise_simulation_FixedPattern_h

#include "SensorNoiseExport.h"
#include "sensornoise/simulation/SimulationSettings.h"

#include <cstddef>
#include <vector>

/** \file
 * What differs from pixel to pixel and stays the same from frame to frame, all causes together. The maps depend on the
 * seed, not on the frames or on the light; a map is empty where nothing differs. */

namespace sensornoise
{

/** Efficiency of every pixel in units of the camera's: prnuSd and columnEfficiencySd [1]. */
SensorNoise_EXPORT std::vector<double>
DrawEfficiency(const SimulationSettings & settings, std::size_t width, std::size_t height);

/** Offset of every pixel about the camera's: dsnuSdDn and columnOffsetSdDn [DN]. */
SensorNoise_EXPORT std::vector<double>
DrawOffsetDn(const SimulationSettings & settings, std::size_t width, std::size_t height);

/** Read noise of every pixel before its own gain and its response: hot pixels and ReadNoiseSettings [DN]. */
SensorNoise_EXPORT std::vector<double>
DrawReadNoiseDn(const SimulationSettings & settings, std::size_t width, std::size_t height);

} // namespace sensornoise

#endif
