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
#ifndef sensornoise_base_RollingShutter_h
#define sensornoise_base_RollingShutter_h

#include "SensorNoiseExport.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

/** How the flicker may vary inside a frame. */
enum class RollingShutter : std::uint8_t
{
  Off,  ///< one gamma_t a frame
  Auto, ///< gamma_t(y) where the data show it, sigma_y by cross-validation
  Fixed ///< gamma_t(y) with the given sigma_y, section 3.5
};

/** The mode of a name: "off", "auto" or "fixed". Throws std::invalid_argument for others. */
SensorNoise_EXPORT RollingShutter
RollingShutterOf(const std::string & name);

/** The name of a mode. */
SensorNoise_EXPORT const char *
NameOf(RollingShutter mode);

} // namespace sensornoise

#endif
