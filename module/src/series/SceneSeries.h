// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_SceneSeries_h
#define sensornoise_series_SceneSeries_h

#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
#include "series/FrameEquations.h"
#include "series/FrameOffsets.h"
#include "series/FrameRegressors.h"
#include "series/FrameSums.h"
#include "series/LocalIllumination.h"
#include "series/MotionSeries.h"
#include "series/OffsetLine.h"
#include "series/TemporalBasis.h"

#include <optional>

namespace sensornoise
{

/** The result of the second pass: what changes from frame to frame beside the noise. */
struct SceneSeries
{
  OffsetLine        line; ///< offset and flicker
  MotionSeries      motion;
  LocalIllumination local;
  double            offset{ 0.0 }; ///< minus the centre: of the line, or what is known, or the darkest level [DN]
  bool              isOffsetTold{ false }; ///< whether the offset is the line's: the flicker tells it
  TemporalBasis     basis;                 ///< of the third pass
  FrameOffsets      frameOffsets;          ///< frames of another dark offset
};

/** The noise by the provisional model itself, by which w V = 1. */
SensorNoise_EXPORT RegressorNoise
NoiseOfModel(const FrameRegressors & regressors);

/** Finds flicker, local light and motion in the sums of the second pass. The noise is the provisional model's. Throws
 * NothingToMeasure if the pixels have one intensity. \a knownOffsetDn serves where the flicker does not tell the
 * offset; without it the darkest level, or, if the scene has one level only, \a blackDn, which the offset is hardly
 * below. \a changesStrongly: the illumination does; a scene of one level
 * then has no model for the noise of each frame, and neither local light nor motion is looked for. */
SensorNoise_EXPORT SceneSeries
FindSceneSeries(const FrameSums &             sums,
                RollingShutter                rollingShutter,
                const std::optional<double> & knownOffsetDn = std::nullopt,
                double                        blackDn = 0.0,
                bool                          changesStrongly = false);

} // namespace sensornoise

#endif
