// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_RefinedReport_h
#define sensornoise_refined_RefinedReport_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "base/NothingToMeasure.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"
#include "scene/StaticScene.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Makes the report of the refined method. */
SensorNoise_EXPORT Report
MakeRefinedReport(const RefinedResults & found, const ParallelFor & parallelFor = SerialFor);

/** Makes the report of a stack that cannot be measured: its description and the reason. Every quantity is `failed`.
 * \a pixelUse has the values of PixelUse as far as they were found. */
SensorNoise_EXPORT Report
MakeFailedReport(const RefinedSettings &           settings,
                 const StaticScene &               scene,
                 const std::vector<std::uint8_t> & pixelUse,
                 const NothingToMeasure &          failureReason);

} // namespace sensornoise

#endif
