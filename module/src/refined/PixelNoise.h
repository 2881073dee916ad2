// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_PixelNoise_h
#define sensornoise_refined_PixelNoise_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/FrameSample.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/StaticVariance.h"
#include "sensornoise/Settings.h"
#include "refined/LineIllumination.h"
#include "refined/UnlikeNoise.h"
#include "scene/StaticScene.h"
#include "series/SceneSeries.h"

#include <optional>

namespace sensornoise
{

/** Results of the third pass: the noise of each pixel, and its spatial and temporal correlation. */
struct PixelNoise
{
  StaticVariance   variance;
  NoiseCorrelation correlation;
  FrameNoise       frames; ///< indices among the distinct frames
  LineIllumination lines;
};

/** Fits the variance and measures the noise correlation. If the correlation is strong, the mean variance of a tile
 * scatters more, and the pixels are tested a second time for a static scene. \a codesDn2 is the variance of the
 * quantization noise in the dark [DN^2]. If too few pixels remain for a line, only the variance is set. */
SensorNoise_EXPORT PixelNoise
MeasurePixelNoise(ProjectedVariance &                      projected,
                  FrameSample                              sample,
                  const StaticScene &                      scene,
                  const std::optional<const SceneSeries> & series,
                  const RefinedSettings &                  settings,
                  double                                   codesDn2,
                  const ParallelFor &                      parallelFor);

} // namespace sensornoise

#endif
