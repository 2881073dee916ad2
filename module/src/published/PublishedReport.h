// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_PublishedReport_h
#define sensornoise_published_PublishedReport_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "published/PublishedEstimate.h"

namespace sensornoise
{

/** Returns the report of the published method. It has values and statuses, but no standard errors or intervals: the
 * paper gives none for a stack, and the errors of an ordinary regression would hide its bias. */
SensorNoise_EXPORT Report
MakePublishedReport(const PublishedFindings & found, const ParallelFor & parallelFor);

/** Copies the parameters and the quality of the fit to \a report, and warns of what contradicts them. */
SensorNoise_EXPORT void
FileParameters(Report & report, const NoiseParameters & parameters);

} // namespace sensornoise

#endif
