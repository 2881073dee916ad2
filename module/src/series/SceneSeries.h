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

/** The result of the second pass: the temporal components of the frames apart from noise. */
struct SceneSeries
{
  OffsetLine        line;          ///< offset and flicker
  MotionSeries      motion;        ///< coefficients of the motion
  LocalIllumination local;         ///< local changes of the illumination
  double            offset{ 0.0 }; ///< offset minus the centre: from the line, or as given, or the darkest level [DN]
  bool isOffsetIdentifiable{ false }; ///< whether the flicker determines the offset, so that it is the offset of
                                      ///< the line
  TemporalBasis basis;                ///< temporal basis of the third pass
  FrameOffsets  frameOffsets;         ///< frames of another dark offset
};

/** Returns the noise according to the initial noise model, for which w V = 1. */
SensorNoise_EXPORT RegressorNoise
NoiseOfModel(const FrameRegressors & regressors);

/** Finds flicker, local illumination and motion from the sums of the second pass, with the noise of the initial noise
 * model. Throws NothingToMeasure if the pixels have one intensity.
 * \param knownOffsetDn offset that is used where the flicker does not determine it; without it the darkest level is
 * used, or \a blackDn if the scene has one level only [DN]
 * \param blackDn level that the offset is hardly below [DN]
 * \param changesStrongly whether the illumination changes strongly; a scene of one level then has no model for the
 * noise of each frame, and neither local illumination nor motion is searched */
SensorNoise_EXPORT SceneSeries
FindSceneSeries(const FrameSums &             sums,
                RollingShutter                rollingShutter,
                const std::optional<double> & knownOffsetDn = std::nullopt,
                double                        blackDn = 0.0,
                bool                          changesStrongly = false);

} // namespace sensornoise

#endif
