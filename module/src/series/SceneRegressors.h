// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_SceneRegressors_h
#define sensornoise_series_SceneRegressors_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "scene/StaticScene.h"
#include "series/FrameRegressors.h"

namespace sensornoise
{

/** Makes the regressors of the second pass, over all usable pixels except outlier pixels, see FindOutlierPixels(). They
 * hold the address of the frame of \a scene, which must outlive them without being moved. */
SensorNoise_EXPORT FrameRegressors
MakeSceneRegressors(const StaticScene & scene, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
