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
#ifndef sensornoise_refined_MotionReport_h
#define sensornoise_refined_MotionReport_h

#include "SensorNoiseExport.h"
#include "sensornoise/refined/RefinedResults.h"
#include "sensornoise/report/Report.h"

namespace sensornoise
{

/** Files the flicker of every frame and its standard deviation, about the offset \a offset: known, identified, or else
 * the middle of where it can be, minus the centre [DN]; \a offsetErrorDn: how far it may be off; \a scaleError: error
 * of a flicker, relative to it, where the response bends [1]. */
SensorNoise_EXPORT void
FillFlicker(Report & report, const RefinedResults & found, double offset, double offsetErrorDn, double scaleError);

/** Files every frame's motion and the vibration's standard deviations and covariance; needs the flicker. */
SensorNoise_EXPORT void
FillMotion(Report & report, const RefinedResults & found);

} // namespace sensornoise

#endif
