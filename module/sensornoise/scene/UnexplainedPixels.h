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
#ifndef sensornoise_scene_UnexplainedPixels_h
#define sensornoise_scene_UnexplainedPixels_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/scene/ProvisionalModel.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Marks the pixels that are no part of a static scene, as far as one pass can tell: 1 if their variance is far above
 * the model's, 2 if that of many of their 7 x 7 neighbours is. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindUnexplained(const ReferenceFrame & frame, const ProvisionalModel & model, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
