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
#ifndef sensornoise_refined_RefinedReport_h
#define sensornoise_refined_RefinedReport_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/NothingToMeasure.h"
#include "sensornoise/refined/RefinedResults.h"
#include "sensornoise/refined/RefinedSettings.h"
#include "sensornoise/report/Report.h"
#include "sensornoise/scene/StillScene.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** The report of the refined method. */
SensorNoise_EXPORT Report
MakeRefinedReport(const RefinedResults & found);

/** The report of a stack that cannot be measured: what is known of it, and why; every quantity is `failed`. \a pixelUse
 * holds the values of PixelUse as far as they were found. */
SensorNoise_EXPORT Report
MakeRefusal(const RefinedSettings &           settings,
            const StillScene &                scene,
            const std::vector<std::uint8_t> & pixelUse,
            const NothingToMeasure &          obstacle);

} // namespace sensornoise

#endif
