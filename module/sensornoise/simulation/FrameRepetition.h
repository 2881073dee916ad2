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
#ifndef sensornoise_simulation_FrameRepetition_h
#define sensornoise_simulation_FrameRepetition_h

#include "sensornoise/simulation/SettingChecks.h"

#include <cstddef>

namespace sensornoise
{

/** Frames that are written more than once, as when a recorder runs faster than the camera. */
struct RepetitionSettings
{
  /** How often each exposure is written, 1 or more. */
  std::size_t count{ 1 };

  /** The exposure that frame \a frame of the stack shows. */
  std::size_t
  ExposureOf(std::size_t frame) const
  {
    return frame / count;
  }
};

/** \throws std::invalid_argument if the setting cannot be used. */
inline void
CheckSettings(const RepetitionSettings & settings)
{
  RequireSetting(
    settings.count >= 1, "number of times that a frame is written", static_cast<double>(settings.count), "1 or more");
}

} // namespace sensornoise

#endif
