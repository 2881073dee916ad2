// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_ReestimatedComponents_h
#define sensornoise_refined_ReestimatedComponents_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/IlluminationResponses.h"
#include "pixels/ProjectionSums.h"
#include "pixels/StaticVariance.h"
#include "series/FrameSums.h"
#include "series/MotionSeries.h"
#include "series/OffsetLine.h"
#include "series/SceneSeries.h"

#include <optional>

namespace sensornoise
{

/** Temporal components that are re-estimated with the noise of the third pass: illumination and motion in the report.
 */
struct ReestimatedComponents
{
  OffsetLine                      line; ///< offset and flicker
  MotionSeries                    motion;
  double                          motionPhi{ 1.0 }; ///< dispersion of the frames over all gradient classes [1]
  std::optional<InstrumentShifts> shifts;
  bool                            isOffsetDrift{ false }; ///< whether the local illumination is a drifting offset
  std::optional<LocalOffset>      localOffset;            ///< only under local illumination
  LocalFlicker                    localFlicker;
};

/** Estimates offset, flicker and shifts again, with the noise that is now known. Reads no frames. The pixels'
 * \a coordinates on the temporal components are needed only under local illumination. */
SensorNoise_EXPORT ReestimatedComponents
ReestimateComponents(const FrameSums &        sums,
                     const SceneSeries &      series,
                     const PixelCoordinates & coordinates,
                     const StaticVariance &   variance,
                     const ParallelFor &      parallelFor);

} // namespace sensornoise

#endif
