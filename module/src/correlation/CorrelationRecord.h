// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_CorrelationRecord_h
#define sensornoise_correlation_CorrelationRecord_h

#include "SensorNoiseExport.h"
#include "correlation/NoiseCorrelation.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** Returns the record of the spatial and temporal noise correlation. If it was not measured, only the noise class is
 * filled. */
SensorNoise_EXPORT NoiseCorrelationRecord
RecordOf(const NoiseCorrelation & correlation);

} // namespace sensornoise

#endif
