// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_CorrelationReport_h
#define sensornoise_refined_CorrelationReport_h

#include "SensorNoiseExport.h"
#include "correlation/NoiseCorrelation.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** Says in plain words that the frames are not raw. \a gain and \a variance_slope must be filed. */
SensorNoise_EXPORT void
WarnOfCorrelation(Report & report, const NoiseCorrelation & correlation);

} // namespace sensornoise

#endif
