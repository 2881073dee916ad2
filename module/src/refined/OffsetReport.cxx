// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"

#include "base/Constants.h"
#include "base/Text.h"
#include "refined/Constants.h"

#include <cmath>
#include <optional>
#include <string>

namespace sensornoise
{

namespace
{
/** Returns the request for the offset, which the illumination does not determine. \a other is an alternative, and
 * begins with ", or". */
std::string
Ask(const std::string & other)
{
  return ". Give dark frames (--dark) or the offset (--offset)" + other;
}

std::string
TextOfOtherOffsets(const FrameOffsets & others, Eigen::Index frames)
{
  return "the dark offset of " + std::to_string(others.unlike.size()) + " of " + std::to_string(frames) +
         " frames differs by " + Rounded(others.stepDn) + " DN from the dark offset of the others" + Ask("");
}

/** Returns the clause of a significant difference of the offsets of parts; empty: there is none. */
std::string
TextOfParts(const PartOffsets & parts)
{
  return parts.BeyondChanceDn(Significance.severalTests) > 0.0
           ? ", and is " + Measured(std::abs(parts.differenceDn), std::sqrt(parts.varianceDn2)) + " DN " +
               (parts.differenceDn > 0.0 ? "higher" : "lower") + " in parts of the frame than over all of it"
           : std::string();
}

/** Returns the clause that the known offset lies above the level that does not flicker. */
std::string
TextOfExcess(const KnownOffset & known, const OffsetEstimate & flicker)
{
  const double error = std::hypot(flicker.standardErrorDn, known.standardErrorDn);
  return Measured(known.valueDn, known.standardErrorDn) + " DN, " + Measured(known.valueDn - flicker.valueDn, error) +
         " DN above the level that does not flicker, which no steady illumination explains";
}

void
WarnOfDarkFrames(Report & report, const RefinedResults & found, const RefinedEstimate & estimate)
{
  const double         quantisationDn2 = found.variance.quantisationNoise.darkVarianceDn2;
  const GainEstimate & gain = estimate.ofSensor.line;
  if (found.darkSignal)
  {
    report.Warn(
      WarningCode::DarkFramesDiffer,
      "the dark frames hold " + Measured(100.0 * found.darkSignal->value, 100.0 * found.darkSignal->standardError) +
        " % of the signal of the frames (expected less than " + Percent(InRefined.leastSignalOfDark) +
        "), so the gain is measured without them. Close the shutter, or cover the lens, and record them again");
  }
  else if (gain.isOffsetAboveFlicker)
  {
    report.Warn(WarningCode::DarkFramesDiffer,
                "the mean level of the dark frames is " + TextOfExcess(*estimate.known, estimate.flickerOffset) +
                  ", so the gain is measured without them. Record dark frames with the black level, exposure, gain and "
                  "temperature of the frames");
  }
  else if (gain.isDarkRejected)
  {
    const DarkVariance & dark = *estimate.known->variance;
    report.Warn(
      WarningCode::DarkFramesDiffer,
      "the noise variance of the dark frames is " + Measured(dark.valueDn2 - quantisationDn2, dark.standardErrorDn2) +
        " DN^2, but at the offset it is " +
        Measured(gain.atOffset->valueDn2 - quantisationDn2, gain.atOffset->standardErrorDn2) +
        " DN^2, so the gain is measured without them. Record dark frames in the dark, with the black level, exposure, "
        "gain and temperature of the frames");
  }
}

/** Returns the clause of a charge, after \a levels, the clause of its level. */
std::string
TextOfCharge(const DarkCharge & charge, const std::string & levels)
{
  return levels + ", and their variance grows with it by " + Measured(charge.slope.value, charge.slope.standardError) +
         " DN per DN, as charge does";
}

/** Warns of charge in dark frames that are used. */
void
WarnOfDarkCharge(Report & report, const RefinedResults & found, const RefinedEstimate & estimate)
{
  const GainEstimate & gain = estimate.ofSensor.line;
  if (gain.isDarkRejected || !(gain.line.gain > 0.0))
  {
    return;
  }
  const auto & [ofPlaces, ofPixels] = found.darkCharge;
  const double darkDn2 = estimate.known->variance->valueDn2;
  const double chargeDn2 = found.darkCharge.VarianceDn2(gain.line.gain);
  const auto   isCertain = [&](const std::optional<DarkCharge> & charge) {
    return charge && charge->VarianceDn2(gain.line.gain) > 0.0 &&
           charge->slope.value > Significance.severalTests * charge->slope.standardError;
  };
  const bool isOfPlaces = isCertain(ofPlaces);
  const bool isOfPixels = isCertain(ofPixels);
  if (chargeDn2 > InCommon.leastDarkDifference * darkDn2 && (isOfPlaces || isOfPixels))
  {
    const bool isMostlyOfPixels =
      isOfPixels && (!isOfPlaces || ofPixels->VarianceDn2(gain.line.gain) > ofPlaces->VarianceDn2(gain.line.gain));
    report.Warn(
      WarningCode::DarkSignalVaries,
      (isMostlyOfPixels ? TextOfCharge(*ofPixels,
                                       "the levels of two pixels of the dark frames differ by " +
                                         Rounded(ofPixels->spreadDn) + " DN in the mean")
                        : TextOfCharge(*ofPlaces,
                                       "the level of the dark frames is " + Rounded(ofPlaces->spreadDn) +
                                         " DN above its darkest places in the mean")) +
        ": " + Percent(chargeDn2 / darkDn2) +
        " of the dark variance. The errors of offset and read noise contain this charge. Cover the sensor and "
        "record the dark frames again, or cool the sensor");
  }
}

/** Warns if the known offset contradicts the offset of the flicker, or its limits. */
void
WarnOfKnownOffset(Report & report, const RefinedEstimate & estimate)
{
  const KnownOffset &    known = *estimate.known;
  const OffsetEstimate & flicker = estimate.flickerOffset;
  const OffsetLimits &   limits = estimate.limits;
  const bool             isAboveFlicker = estimate.ofSensor.line.isOffsetAboveFlicker;
  if (estimate.isIlluminationSteady && !isAboveFlicker)
  {
    const double difference = flicker.valueDn - known.valueDn;
    const double error = std::hypot(flicker.standardErrorDn, known.standardErrorDn);
    report.Warn(WarningCode::SteadyLight,
                "the level that does not flicker is " + Measured(flicker.valueDn, flicker.standardErrorDn) + " DN, " +
                  Measured(std::abs(difference), error) + " DN " +
                  (difference > 0.0 ? "above the given offset: steady illumination or dark current adds to it. Switch "
                                      "steady light sources off, or give an offset of the same exposure and temperature"
                                    : "below the given offset, which is too high for these frames. Check --offset or "
                                      "--dark, or leave it out"));
  }
  if (estimate.isOffsetOutOfLimits)
  {
    const bool        isDark = known.darkFrames > 0;
    const std::string lowest = limits.lowestDn ? Rounded(*limits.lowestDn) + " to " : "at most ";
    report.Warn(
      WarningCode::OffsetOutOfRange,
      (isDark ? "the mean level of the dark frames is " : "the given offset is ") + Text(known.valueDn) +
        " DN, but the darkest pixels and a read noise above 0 allow " + lowest +
        RoundedApart(limits.highestDn, known.valueDn) + " DN: " +
        (isDark
           ? "check whether frames and dark frames are exchanged, or record dark frames with the setting of the frames"
           : "leave the offset out, or measure it with dark frames (--dark)"));
  }
  else if (isAboveFlicker && !known.variance)
  {
    report.Warn(WarningCode::OffsetOutOfRange,
                "the given offset is " + TextOfExcess(known, flicker) +
                  ": leave the offset out, or measure it with dark frames (--dark)");
  }
}

/** Returns the reason why there is no flicker, and what to do. */
std::string
TextOfUnknownFlicker(const SeriesOfFlicker & flicker)
{
  const std::string giveOffset =
    ": give the offset (--offset) or dark frames (--dark), or include dark and bright areas "
    "in the scene";
  if (flicker.failure == FlickerFailure::UnknownOffset)
  {
    return "signal and offset are not distinguished, so that the illumination change and the flicker are not known" +
           giveOffset;
  }
  if (flicker.failure == FlickerFailure::UncertainOffset)
  {
    return "the illumination change is known only to within " +
           PercentApart(flicker.scaleError, InCommon.largestRelativeError) + "; " +
           Percent(InCommon.largestRelativeError) + " is needed for the flicker" + giveOffset;
  }
  if (flicker.failure == FlickerFailure::LocalMotion)
  {
    return "parts of the scene move by themselves, which changes their levels as a flicker does. Record a scene that "
           "is still, or choose a part of it: --roi";
  }
  return "the flicker is not distinguished from the noise of the frames: its standard deviation may be " +
         (flicker.limit && flicker.limit->high ? RoundedApart(*flicker.limit->high, 1.0) : std::string("of any size")) +
         " (below 1 is needed). Record more frames";
}
} // namespace

std::string
ReasonOf(const OffsetEstimate & offset, const RefinedResults & found)
{
  const std::string moreFlicker = ", or record more flicker or more frames";
  switch (offset.failure)
  {
    case OffsetFailure::None:
      return {};
    case OffsetFailure::UnlikeOffsets:
      return TextOfOtherOffsets(found.series.frameOffsets, found.reestimated.line.response.rows());
    case OffsetFailure::OneIntensity:
      return "the scene has one intensity" + Ask(", or include dark and bright areas in the scene");
    case OffsetFailure::Ramp:
      return "the scene is a ramp, along which motion changes every level alike, as an offset does" + Ask("");
    case OffsetFailure::FaintFlicker:
      return DescribeInsignificantFlicker(found.reestimated.line.flickerZ) + Ask(moreFlicker);
    case OffsetFailure::LocalIllumination:
      return found.IsMotionLocal()
               ? "parts of the scene move by themselves, which changes their levels as a flicker does" +
                   Ask(", or record a scene that is still")
               : "the illumination changes differently over the frame, and no part of it determines the offset" +
                   Ask("");
    case OffsetFailure::Unbounded:
      return "the flicker leaves the offset without bounds" + Ask(moreFlicker);
    case OffsetFailure::WideInterval:
      return "the interval of the offset, " + Rounded(*offset.interval.low) + " to " + Rounded(*offset.interval.high) +
             " DN, is wider than a quarter of the range of the scene, " +
             Rounded(found.scene.model.brightestDn - found.scene.model.darkestDn) + " DN" + Ask(moreFlicker);
    case OffsetFailure::OutOfLimits:
      return "the level that does not flicker, " + Rounded(offset.valueDn) +
             " DN, is above the darkest level or makes the squared read noise negative: parts of the "
             "illumination flicker differently" +
             Ask("");
    case OffsetFailure::OffsetsDiffer:
      return "the level that does not flicker differs from place to place" +
             TextOfParts(found.reestimated.partOffsets) +
             ": a part of the light is steady, or the dark offset differs over the sensor" + Ask("");
    case OffsetFailure::OffsetsDisagree:
      break;
  }
  return "areas under different illumination give different offsets (dispersion " +
         RoundedApart(found.reestimated.localOffset->phi, 1.0) + ", expected 1)" + Ask("");
}

void
WarnOfFlicker(Report & report, const SeriesOfFlicker & flicker)
{
  if (flicker.failure != FlickerFailure::None)
  {
    report.Warn(WarningCode::FlickerNotIdentifiable, TextOfUnknownFlicker(flicker));
  }
}

void
WarnOfOffset(Report & report, const RefinedResults & found, const RefinedEstimate & estimate)
{
  const OffsetEstimate & flicker = estimate.flickerOffset;
  if (!estimate.known && !flicker.IsIdentified())
  {
    report.Warn(WarningCode::OffsetNotIdentifiable, ReasonOf(flicker, found));
    return;
  }
  if (estimate.known)
  {
    WarnOfKnownOffset(report, estimate);
  }
  if (estimate.known && estimate.known->variance)
  {
    WarnOfDarkFrames(report, found, estimate);
    WarnOfDarkCharge(report, found, estimate);
  }
  if (estimate.dark.readNoise.status == EstimateStatus::UpperLimit)
  {
    report.Warn(WarningCode::ReadNoiseUpperLimit,
                "the read noise is below " + Rounded(*estimate.dark.readNoise.bracket->high) +
                  " DN and is not distinguished from 0 or from the quantization noise. Record more frames" +
                  (estimate.known && estimate.known->darkFrames > 0 ? ", or use a higher analogue gain"
                                                                    : " or dark frames (--dark)"));
  }
}

} // namespace sensornoise
