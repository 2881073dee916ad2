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
#ifndef RealSensorSituations_h
#define RealSensorSituations_h

#include "studies/RealSensorSetting.h"

#include <functional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Appends the test chart and the texture before all three cameras, 50 and 100 frames, with flicker and motion and
 * without: ten settings, each changed by \a change and called \a name. \param kinds what their noise may be called */
void
AppendEverywhere(std::vector<RealSensorSetting> &                 all,
                 const std::string &                              name,
                 const std::vector<std::string> &                 kinds,
                 const std::function<void(RealSensorSetting &)> & change);

} // namespace sensornoise::tools

#endif
