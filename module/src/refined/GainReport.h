// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_GainReport_h
#define sensornoise_refined_GainReport_h

#include "SensorNoiseExport.h"
#include "refined/RefinedResults.h"
#include "refined/SensorQuantities.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** Warns of what the verdict on the gain is due to, or, if the gain is identified, of what its interval allows for. The
 * numbers of pixels must be in the report. \a effectOfLines is RefinedEstimate::effectOfLines [1]. */
SensorNoise_EXPORT void
WarnOfGain(Report & report, const RefinedResults & found, const JudgedGain & judged, double effectOfLines);

/** Warns that the darkest areas have so much signal, \a darkestFraction of that of the brightest [1], that a non-linear
 * response would not be noticed. */
SensorNoise_EXPORT void
WarnOfNarrowRange(Report & report, const RefinedResults & found, double darkestFraction);

} // namespace sensornoise

#endif
