// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_OffsetReport_h
#define sensornoise_refined_OffsetReport_h

#include "SensorNoiseExport.h"
#include "refined/RefinedEstimate.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Report.h"

#include <string>

namespace sensornoise
{

/** Returns the reason why the illumination does not determine the offset, and what to do; "": it does. */
SensorNoise_EXPORT std::string
ReasonOf(const OffsetEstimate & offset, const RefinedResults & found);

/** Warns if the flicker is not identifiable. */
SensorNoise_EXPORT void
WarnOfFlicker(Report & report, const SeriesOfFlicker & flicker);

/** Warns of an offset that is not identifiable, of a given offset or dark frames that contradict the frames, and of a
 * read noise that is only limited. The gain must be identified. */
SensorNoise_EXPORT void
WarnOfOffset(Report & report, const RefinedResults & found, const RefinedEstimate & estimate);

} // namespace sensornoise

#endif
