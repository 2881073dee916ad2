// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_CorrelationReport_h
#define sensornoise_refined_CorrelationReport_h

#include "SensorNoiseExport.h"
#include "correlation/NoiseCorrelation.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** Adds a warning that the frames are not raw if the noise is correlated or not linear. The gain and the slope of the
 * variance must be filed before. */
SensorNoise_EXPORT void
WarnOfCorrelation(Report & report, const NoiseCorrelation & correlation);

} // namespace sensornoise

#endif
