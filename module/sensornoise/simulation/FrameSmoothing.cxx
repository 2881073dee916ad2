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
#include "sensornoise/simulation/FrameSmoothing.h"

#include "sensornoise/simulation/Scenes.h"
#include "sensornoise/simulation/SettingChecks.h"

namespace sensornoise
{

void
CheckSettings(const SmoothingSettings & settings)
{
  RequireSetting(settings.sdPixels >= 0.0 && settings.sdPixels <= 100.0,
                 "smoothing in the camera",
                 settings.sdPixels,
                 "0 to 100 pixels");
}

DoubleFrame
SmoothFrame(DoubleFrame codesDn, const SmoothingSettings & settings, const ParallelFor & parallelFor)
{
  codesDn.values = GaussianBlur(codesDn.values, codesDn.width, codesDn.height, settings.sdPixels, parallelFor);
  return codesDn;
}

} // namespace sensornoise
