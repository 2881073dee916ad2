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
#ifndef sensornoise_simulation_Interpolation_h
#define sensornoise_simulation_Interpolation_h

#include "SensorNoiseExport.h"

#include <string>

namespace sensornoise
{

/** How a camera takes a value between pixels. */
enum class Interpolation
{
  Nearest, ///< that of the nearest pixel
  Linear,  ///< of two pixels along each axis
  Cubic    ///< of four pixels along each axis, CubicShift
};

/** The name as options spell it: "nearest", "linear", "cubic". */
SensorNoise_EXPORT const char *
NameOf(Interpolation interpolation);

/** \throws std::invalid_argument for another name. */
SensorNoise_EXPORT Interpolation
InterpolationOf(const std::string & name);

} // namespace sensornoise

#endif
