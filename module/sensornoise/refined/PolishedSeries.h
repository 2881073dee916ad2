/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_refined_PolishedSeries_h
#define sensornoise_refined_PolishedSeries_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/pixels/LocalFlicker.h"
#include "sensornoise/pixels/LocalOffset.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/StaticVariance.h"
#include "sensornoise/series/FrameSums.h"
#include "sensornoise/series/MotionSeries.h"
#include "sensornoise/series/OffsetLine.h"
#include "sensornoise/series/SceneSeries.h"

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

/** Offset, flicker and shifts once more, with the noise that is now known. Needs no reading. */
SensorNoise_EXPORT PolishedSeries
PolishSceneSeries(const FrameSums &         sums,
                  const SceneSeries &       series,
                  const ProjectedVariance & projected,
                  const StaticVariance &    variance,
                  const ParallelFor &       parallelFor);

} // namespace sensornoise

#endif
