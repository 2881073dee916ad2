// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_PolishedSeries_h
#define sensornoise_refined_PolishedSeries_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/LocalFlicker.h"
#include "pixels/LocalOffset.h"
#include "pixels/PixelCoordinates.h"
#include "pixels/StaticVariance.h"
#include "series/FrameSums.h"
#include "series/MotionSeries.h"
#include "series/OffsetLine.h"
#include "series/SceneSeries.h"

#include <optional>

namespace sensornoise
{

/** The series over time with the noise that the third pass measured: what the report says of light and motion. */
struct PolishedSeries
{
  OffsetLine                      line; ///< offset and flicker
  MotionSeries                    motion;
  double                          motionPhi{ 1.0 }; ///< dispersion of the frames over all gradient classes
  std::optional<InstrumentShifts> shifts;
  bool                            isOffsetDrift{ false }; ///< the local light is an offset that drifts
  std::optional<LocalOffset>      localOffset;            ///< where light is local
  LocalFlicker                    localFlicker;
};

/** Offset, flicker and shifts once more, with the noise that is now known. Needs no reading; the pixels' \a coordinates
 * in the series' basis only where light is local. */
SensorNoise_EXPORT PolishedSeries
PolishSceneSeries(const FrameSums &        sums,
                  const SceneSeries &      series,
                  const PixelCoordinates & coordinates,
                  const StaticVariance &   variance,
                  const ParallelFor &      parallelFor);

} // namespace sensornoise

#endif
