// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_OffsetEstimate_h
#define sensornoise_refined_OffsetEstimate_h

#include "SensorNoiseExport.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Report.h"

#include <cstdint>
#include <optional>

namespace sensornoise
{

struct GainEstimate;

/** Bounds of the offset by physics: sigma^2 >= 0 from below, no pixel darker than the offset from above. Both bounds
 * are widened by their errors. */
struct OffsetLimits
{
  std::optional<double> lowestDn;               ///< null: not bounded [DN]
  double                highestDn{ 0.0 };       ///< the darkest level plus its error [DN]
  double                rootDn{ 0.0 };          ///< level at which the line has sigma = 0, without errors [DN]
  double                largestNoiseDn2{ 0.0 }; ///< sigma^2 if the offset is highestDn [DN^2]
};

/** Returns the bounds by the line of \a gain; \a quantisationDn2 is the variance of the quantization noise [DN^2]. */
SensorNoise_EXPORT OffsetLimits
LimitsOf(const RefinedResults & found, const GainEstimate & gain, double quantisationDn2);

/** Reason why the illumination does not determine the dark offset. */
enum class OffsetFailure : std::uint8_t
{
  None,              ///< it determines the offset
  UnlikeOffsets,     ///< too many frames have another dark offset to be left out
  OneIntensity,      ///< the scene has one intensity
  Ramp,              ///< the scene is a ramp, along which motion changes every level alike, as an offset does
  FaintFlicker,      ///< the flicker is not significant
  LocalIllumination, ///< the illumination changes differently over the frame, and no part determines the offset
  Unbounded,         ///< the interval has an end at infinity
  WideInterval,      ///< the interval is wider than LargestOffsetInterval of the range of the scene
  OutOfLimits,       ///< the offset is outside of its limits
  OffsetsDisagree    ///< the offsets by several components of the illumination scatter by more than their errors
};

/** Dark offset as the flicker determines it. */
struct OffsetEstimate
{
  double        valueDn{ 0.0 };         ///< dark offset [DN]
  double        standardErrorDn{ 0.0 }; ///< [DN]
  Interval      interval;               ///< 95 % interval [DN]
  double        phi{ 1.0 };             ///< dispersion about the offset line [1]; 1: noise alone
  OffsetFailure failure{ OffsetFailure::None };

  bool
  IsIdentified() const
  {
    return failure == OffsetFailure::None;
  }
};

/** Estimates the dark offset from the flicker of all frames, or, under local illumination, from the pixels' responses
 * to it. It is identifiable only if its interval is narrow, it lies within its bounds, and the components of the
 * flicker agree on it. Otherwise the offset from frames of known exposures replaces it, if its interval is narrow. */
SensorNoise_EXPORT OffsetEstimate
EstimateOffset(const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits);

/** Returns whether the known offset, which must be given, lies outside of its limits by more than their errors. */
SensorNoise_EXPORT bool
IsKnownOffsetOutOfLimits(const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits);

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

} // namespace sensornoise

#endif
