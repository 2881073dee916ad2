// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_AllFrames_h
#define sensornoise_report_AllFrames_h

#include "SensorNoiseExport.h"
#include "moments/StackFrames.h"
#include "moments/UnlikeFrames.h"
#include "sensornoise/Report.h"

#include <vector>

namespace sensornoise
{

/** Makes of the report of the distinct frames that of the frames given: their number, which are left out, the series
 * with the values of a frame's original, or NaN where it is left out, and the warnings `repeated-frames` and
 * `frames-left-out`. */
SensorNoise_EXPORT void
ReportAllFrames(Report & report, const DistinctFrames & frames, const std::vector<LeftOutFrame> & leftOut);

} // namespace sensornoise

#endif
