// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_SceneRegressors_h
#define sensornoise_series_SceneRegressors_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "scene/StillScene.h"
#include "series/FrameRegressors.h"

namespace sensornoise
{

/** The regressors of the second pass, of all usable pixels but those that one pass cannot explain (FindUnexplained()).
 * They hold the address of the scene's frame, which must outlive them at its place. */
SensorNoise_EXPORT FrameRegressors
MakeSceneRegressors(const StillScene & scene, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
