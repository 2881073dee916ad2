// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_GainReport_h
#define sensornoise_refined_GainReport_h

#include "SensorNoiseExport.h"
#include "refined/OffsetLimits.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

struct GainEstimate;

/** Files the fit, and gain and intercept if they can be told. Returns false if they cannot: then every parameter of the
 * sensor is without a value, with a warning that says why. \a quantisationDn2 is the codes' noise, \a student the
 * quantile of the 95 % intervals. */
SensorNoise_EXPORT bool
FillGain(Report &               report,
         const RefinedResults & found,
         const GainEstimate &   gain,
         double                 quantisationDn2,
         double                 student);

/** Warns if the levels do not reach down far enough to tell a bent response from a straight one. */
SensorNoise_EXPORT void
WarnOfNarrowRange(Report &               report,
                  const RefinedResults & found,
                  const GainEstimate &   gain,
                  const OffsetLimits &   limits);

} // namespace sensornoise

#endif
