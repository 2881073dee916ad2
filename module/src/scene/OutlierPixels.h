// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_OutlierPixels_h
#define sensornoise_scene_OutlierPixels_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Marks outlier pixels, which are no part of a static scene as far as one pass determines it. Returns 1 where the
 * variance is far above the model, 2 where this is true of many of the 7 x 7 neighbours, else 0. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindOutlierPixels(const ReferenceFrame & frame, const InitialNoiseModel & model, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
