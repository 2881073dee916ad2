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

/** Dark offset as the flicker determines it. */
struct OffsetEstimate
{
  double      valueDn{ 0.0 };         ///< dark offset [DN]
  double      standardErrorDn{ 0.0 }; ///< [DN]
  Interval    interval;               ///< 95 % interval [DN]
  double      phi{ 1.0 };             ///< dispersion about the offset line [1]; 1: noise alone
  std::string failureReason;          ///< reason why it is not identifiable, and what to do; empty: it is
};

/** Estimates the dark offset from the flicker of all frames, or, under local illumination, from the pixels' responses
 * to it. It is identifiable only if its interval is narrow, it lies within its bounds, and the components of the
 * flicker agree on it. Otherwise the offset from frames of known exposures replaces it, if its interval is narrow. */
SensorNoise_EXPORT OffsetEstimate
EstimateOffset(const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits);

/** Offset at which the flicker is computed, and its standard error [DN]. */
struct UsedOffset
{
  double valueDn;
  double errorDn;
};

/** Returns the known offset unless the frames contradict it, else the offset of the flicker if it is identifiable, else
 * the middle of the bounds. */
SensorNoise_EXPORT UsedOffset
ChooseOffset(const RefinedResults & found,
             const GainEstimate &   gain,
             const OffsetEstimate & flicker,
             const OffsetLimits &   limits);

/** Files offset and read noise from dark frames or the user, whatever the frames show. \a quantisationDn2 is the
 * variance of the quantization noise [DN^2]. */
SensorNoise_EXPORT void
FillFromDarkFrames(Report & report, const RefinedSettings & settings, double quantisationDn2);

/** Files offset and read noise. The offset is the known one, if there is one, else the offset of \a flicker. \a student
 * is the quantile of the 95 % intervals. */
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
