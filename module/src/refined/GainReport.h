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

/** Files the fit, and gain and intercept if they are identifiable. Returns whether they are. If not, every parameter of
 * the sensor is filed without a value, and a warning gives the reason. \a quantisationDn2 is the variance of the
 * quantization noise [DN^2], \a student the quantile of the 95 % intervals. */
SensorNoise_EXPORT bool
FillGain(Report &               report,
         const RefinedResults & found,
         const GainEstimate &   gain,
         double                 quantisationDn2,
         double                 student);

/** Warns if the darkest levels have too much signal to distinguish a non-linear response from a linear one. */
SensorNoise_EXPORT void
WarnOfNarrowRange(Report &               report,
                  const RefinedResults & found,
                  const GainEstimate &   gain,
                  const OffsetLimits &   limits);

} // namespace sensornoise

#endif
