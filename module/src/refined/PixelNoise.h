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
#include "scene/StillScene.h"
#include "series/SceneSeries.h"

#include <optional>

namespace sensornoise
{

/** What the third pass tells of the noise: of each pixel, and what pixels and frames share. */
struct PixelNoise
{
  StaticVariance   variance;
  NoiseCorrelation correlation;
  FrameNoise       frames; ///< of the frames' places
  LineIllumination lines;
};

/** Fits the variance and measures what is shared. Where neighbours share much, the mean variance of an area scatters
 * more, and what fits a static scene is judged once more. \a codesDn2 is the noise of rounding in the dark. If too few
 * pixels are left for a line, nothing else is measured. */
SensorNoise_EXPORT PixelNoise
MeasurePixelNoise(ProjectedVariance &                      projected,
                  FrameSample                              sample,
                  const StillScene &                       scene,
                  const std::optional<const SceneSeries> & series,
                  const RefinedSettings &                  settings,
                  double                                   codesDn2,
                  const ParallelFor &                      parallelFor);

} // namespace sensornoise

#endif
