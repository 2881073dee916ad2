// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_UnexplainedPixels_h
#define sensornoise_scene_UnexplainedPixels_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "scene/ProvisionalModel.h"
#include "scene/ReferenceFrame.h"

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
