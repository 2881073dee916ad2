// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_OffsetReport_h
#define sensornoise_refined_OffsetReport_h

#include "SensorNoiseExport.h"
#include "refined/OffsetLimits.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Report.h"

#include <optional>
#include <string>

namespace sensornoise
{

struct GainEstimate;

/** The offset as the flicker tells it. */
struct OffsetEstimate
{
  double      valueDn{ 0.0 };
  double      standardErrorDn{ 0.0 };
  Interval    interval;   ///< 95 % [DN]
  double      phi{ 1.0 }; ///< dispersion about the offset line; 1: nothing but noise
  std::string obstacle;   ///< why it is not identifiable and what to do; empty: it is
};

/** The offset by the flicker of all frames, or, where the light is local, by the pixels' responses to it. It is told
 * only if its interval is narrow, it lies within its limits, and the flicker agrees with itself. Where it is not, the
 * offset of frames whose exposures are given takes its place, if its interval is narrow. */
SensorNoise_EXPORT OffsetEstimate
EstimateOffset(const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits);

/** The offset that the flicker is taken about. */
struct UsedOffset
{
  double valueDn;
  double errorDn;
};

/** Returns the known offset unless the frames contradict it, else that of the flicker, else the middle of the limits.
 */
SensorNoise_EXPORT UsedOffset
OffsetInUse(const RefinedResults & found,
            const GainEstimate &   gain,
            const OffsetEstimate & flicker,
            const OffsetLimits &   limits);

/** Files offset and read noise as dark frames, or the user, tell them, whatever the frames tell. \a quantisationDn2 is
 * the codes' noise. */
SensorNoise_EXPORT void
FillFromDarkFrames(Report & report, const RefinedSettings & settings, double quantisationDn2);

/** Files offset and read noise; the offset is \a flicker's unless one is known. \a student is the quantile of the 95 %
 * intervals. */
SensorNoise_EXPORT void
FillOffsetAndReadNoise(Report &               report,
                       const RefinedResults & found,
                       const GainEstimate &   gain,
                       const OffsetLimits &   limits,
                       const OffsetEstimate & flicker,
                       double                 quantisationDn2,
                       double                 student);

} // namespace sensornoise

#endif
