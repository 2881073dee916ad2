// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_RepeatedFrames_h
#define sensornoise_report_RepeatedFrames_h

#include "SensorNoiseExport.h"
#include "sensornoise/moments/DistinctFrames.h"
#include "sensornoise/report/Report.h"

namespace sensornoise
{

/** Makes of the report of the distinct frames that of the frames given: their number, the series with the values of a
 * frame's original, and the warning `repeated-frames` if any is equal to an earlier one. */
SensorNoise_EXPORT void
ReportAllFrames(Report & report, const DistinctFrames & frames);

} // namespace sensornoise

#endif
