// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/OffsetReport.h"

#include "base/ChiSquare.h"
#include "base/FaintFlicker.h"
#include "base/Significance.h"
#include "base/Text.h"
#include "sensornoise/Settings.h"
#include "pixels/Constants.h"
#include "refined/Constants.h"
#include "refined/GainEstimate.h"
#include "report/Quantities.h"
#include "series/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace sensornoise
{

namespace
{
/** Warns if the dark frames contain signal, or if their variance contradicts the line at the offset, see
 * CombineWithDarkPoint(). */
void
CompareDarkVariance(Report & report, const RefinedResults & found, const GainEstimate & gain, double quantisationDn2)
{
  if (found.darkSignal)
  {
    report.Warn(
      WarningCode::DarkFramesDiffer,
      "the dark frames hold " + Measured(100.0 * found.darkSignal->value, 100.0 * found.darkSignal->standardError) +
        " % of the signal of the frames (expected less than " + Percent(InRefined.leastSignalOfDark) +
        "), so the gain is measured without them. Close the shutter, or cover the lens, and record them again");
  }
  else if (gain.isDarkRejected)
  {
    const DarkVariance & dark = *found.settings.offset->variance;
    report.Warn(
      WarningCode::DarkFramesDiffer,
      "the noise variance of the dark frames is " + Measured(dark.valueDn2 - quantisationDn2, dark.standardErrorDn2) +
        " DN^2, but at the offset it is " +
        Measured(gain.atOffset->valueDn2 - quantisationDn2, gain.atOffset->standardErrorDn2) +
        " DN^2, so the gain is measured without them. Record dark frames in the dark, with the black level, exposure, "
        "gain and temperature of the frames");
  }
}

/** Files the read noise in electrons from the read noise in DN and the gain. */
void
FillElectrons(Report & report, double squareDn2, double errorDn2, double gain, double gainError, double student)
{
  if (report.readNoise.status == EstimateStatus::UpperLimit)
  {
    report.readNoiseElectrons = UpperLimit(*report.readNoise.bracket->high / gain);
    return;
  }
  const double fromGain = 2.0 * squareDn2 / gain * gainError;
  report.readNoiseElectrons =
    RootOf(squareDn2 / (gain * gain), std::hypot(errorDn2, fromGain) / (gain * gain), student);
}

/** Returns whether the known offset lies beyond its bounds. */
bool
IsKnownOffsetOutOfRange(const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits)
{
  const KnownOffset & known = *found.settings.offset;
  const double        slackDn = Significance.oneTest * known.standardErrorDn +
                         Significance.hint * std::sqrt(gain.covariance(1, 1)) / gain.line.gain;
  const double rangeDn = found.scene.model.brightestDn - found.scene.model.darkestDn;
  return (limits.lowestDn && known.valueDn < *limits.lowestDn - slackDn) ||
         known.valueDn > limits.highestDn + slackDn + InRefined.slackOfRange * rangeDn;
}

/** Warns if the known offset contradicts the offset of the flicker, or its bounds. */
void
CompareKnownOffset(Report &               report,
                   const RefinedResults & found,
                   const GainEstimate &   gain,
                   const OffsetEstimate & flicker,
                   const OffsetLimits &   limits)
{
  const double offsetDn = found.settings.offset->valueDn;
  const double offsetErrorDn = found.settings.offset->standardErrorDn;
  const double difference = flicker.valueDn - offsetDn;
  const double error = std::hypot(flicker.standardErrorDn, offsetErrorDn);
  if (flicker.failureReason.empty() && std::abs(difference) > Significance.oneTest * error)
  {
    report.Warn(WarningCode::SteadyLight,
                "the level that does not flicker is " + Measured(flicker.valueDn, flicker.standardErrorDn) + " DN, " +
                  Measured(std::abs(difference), error) + " DN " +
                  (difference > 0.0 ? "above the given offset: steady illumination or dark current adds to it. Switch "
                                      "steady lamps off, or give an offset of the same exposure and temperature"
                                    : "below the given offset, which is too high for these frames. Check --offset or "
                                      "--dark, or leave it out"));
  }
  if (IsKnownOffsetOutOfRange(found, gain, limits))
  {
    const bool        isDark = found.settings.offset->darkFrames > 0;
    const std::string lowest = limits.lowestDn ? Rounded(*limits.lowestDn) + " to " : "at most ";
    report.Warn(WarningCode::OffsetOutOfRange,
                (isDark ? "the mean level of the dark frames is " : "the given offset is ") + Text(offsetDn) +
                  " DN, but the darkest pixels and a read noise above 0 allow " + lowest +
                  RoundedApart(limits.highestDn, offsetDn) + " DN: " +
                  (isDark
                     ? "are frames and dark frames exchanged? Else record dark frames with the setting of the frames"
                     : "leave it out, or measure it with dark frames (--dark)"));
  }
}

/** Files that offset and read noise are not identifiable, with their bounds. */
void
FileBounds(Report & report, const OffsetLimits & limits, double gain)
{
  const double largest = std::sqrt(limits.largestNoiseDn2);
  report.offset = Quantity::Without(EstimateStatus::NotIdentifiable);
  report.offset.bracket = Interval{ limits.lowestDn, limits.highestDn };
  report.readNoise = Quantity::Without(EstimateStatus::NotIdentifiable);
  report.readNoise.bracket = Interval{ 0.0, largest };
  report.readNoiseElectrons = Quantity::Without(EstimateStatus::NotIdentifiable);
  report.readNoiseElectrons.bracket = Interval{ 0.0, largest / gain };
}

/** Files the covariance of gain, intercept and offset. The error of the offset is independent of the error of the line;
 * without an offset its elements are NaN. */
void
FillCovariance(Report & report, const GainEstimate & gain, std::optional<double> offsetVarianceDn2)
{
  // The error of assuming a linear response turns the line about its pivot.
  const double    ofModel = 0.5 * (gain.below + gain.above);
  const double    pivotDn = gain.line.pivotDn;
  Eigen::Matrix2d covariance;
  covariance << 1.0, -pivotDn, -pivotDn, pivotDn * pivotDn;
  covariance = gain.covariance + ofModel * ofModel * covariance;
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const double other = offsetVarianceDn2 ? 0.0 : unknown;
  report.covariance = std::array<std::array<double, 3>, 3>{ { { covariance(0, 0), covariance(0, 1), other },
                                                              { covariance(0, 1), covariance(1, 1), other },
                                                              { other, other, offsetVarianceDn2.value_or(unknown) } } };
}

/** Files the read noise at the offset, which must be identified. */
void
FillReadNoise(Report &               report,
              const RefinedResults & found,
              const GainEstimate &   gain,
              double                 offsetDn,
              double                 offsetErrorDn,
              double                 quantisationDn2,
              double                 student)
{
  const VarianceLine &    v = gain.line;
  const Eigen::Vector2d   design(offsetDn, 1.0);
  const Eigen::Matrix2d & covariance = gain.covariance;
  const double            square = v.intercept + v.gain * offsetDn - quantisationDn2;
  const double            ofModel = 0.5 * (gain.below + gain.above) * (v.pivotDn - offsetDn);
  const double            error =
    std::sqrt(design.dot(covariance * design) + ofModel * ofModel + v.gain * v.gain * offsetErrorDn * offsetErrorDn);
  if (found.settings.offset && found.settings.offset->variance)
  {
    const DarkVariance & dark = *found.settings.offset->variance;
    CompareDarkVariance(report, found, gain, quantisationDn2);
    FillFromDarkFrames(report, found.settings, quantisationDn2);
    FillElectrons(
      report, dark.valueDn2 - quantisationDn2, dark.standardErrorDn2, v.gain, gain.StandardError(), student);
  }
  else if (square + Significance.severalTests * error < 0.0)
  {
    report.readNoise = Quantity::Without(EstimateStatus::Failed);
    report.readNoiseElectrons = Quantity::Without(EstimateStatus::Failed);
  }
  else
  {
    report.readNoise = RootOf(square, error, student);
    report.readNoiseElectrons = RootOf(square / (v.gain * v.gain), error / (v.gain * v.gain), student);
  }
  if (report.readNoise.status == EstimateStatus::UpperLimit)
  {
    report.Warn(WarningCode::ReadNoiseUpperLimit,
                "the read noise is below " + Rounded(*report.readNoise.bracket->high) +
                  " DN and is not distinguished from 0 or from the quantization noise. Record more frames" +
                  (found.settings.offset && found.settings.offset->darkFrames > 0 ? ", or use a higher analogue gain"
                                                                                  : " or dark frames (--dark)"));
  }
}
} // namespace

UsedOffset
ChooseOffset(const RefinedResults & found,
             const GainEstimate &   gain,
             const OffsetEstimate & flicker,
             const OffsetLimits &   limits)
{
  const auto & known = found.settings.offset;
  if (known && !gain.isDarkRejected && !IsKnownOffsetOutOfRange(found, gain, limits))
  {
    return { known->valueDn, known->standardErrorDn };
  }
  if (flicker.failureReason.empty())
  {
    return { flicker.valueDn, flicker.standardErrorDn };
  }
  // An offset that is not identifiable lies between the level of sigma = 0 and the darkest level, with about equal
  // probability.
  const double lowestDn = limits.lowestDn.value_or(std::min(found.blackDn, limits.highestDn));
  return { 0.5 * (lowestDn + limits.highestDn), (limits.highestDn - lowestDn) / std::sqrt(12.0) };
}

void
FillFromDarkFrames(Report & report, const RefinedSettings & settings, double quantisationDn2)
{
  if (!settings.offset)
  {
    return;
  }
  const KnownOffset & known = *settings.offset;
  report.offset = WithError(known.valueDn, known.standardErrorDn);
  if (!known.variance)
  {
    return;
  }
  const double student = StudentQuantile(0.975, std::max(1.0, static_cast<double>(known.darkFrames) - 1.0));
  const double square = known.variance->valueDn2 - quantisationDn2;
  const double halfStepDn2 = 3.0 * quantisationDn2; // below it, the quantization hides the noise
  report.readNoise = square < halfStepDn2 ? UpperLimit(std::sqrt(halfStepDn2))
                                          : RootOf(square, known.variance->standardErrorDn2, student);
  if (known.readNoiseMedian)
  {
    report.readNoiseMedian = WithError(known.readNoiseMedian->valueDn, known.readNoiseMedian->standardErrorDn, student);
  }
}

namespace
{
/** Returns the offset of the line through the levels of frames of known exposures; null if it is not precise enough. */
std::optional<OffsetEstimate>
OffsetByExposures(const RefinedResults & found)
{
  if (found.exposures == nullptr || !found.exposures->offsetDn || found.exposures->levels.empty())
  {
    return std::nullopt;
  }
  const ExposureFit & fit = *found.exposures;
  const bool          isOfLine = !fit.isOffsetOfDarkFrames && fit.dof > 0.0;
  const double        halfWidthDn = StudentQuantile(0.975, isOfLine ? fit.dof : 1e6) * fit.offsetDn->standardError;
  const double        rangeDn = fit.levels.back().meanDn - fit.levels.front().meanDn;
  if (!(2.0 * halfWidthDn < LargestOffsetInterval * rangeDn))
  {
    return std::nullopt;
  }
  OffsetEstimate estimate;
  estimate.valueDn = fit.offsetDn->value;
  estimate.standardErrorDn = fit.offsetDn->standardError;
  estimate.interval = Interval{ estimate.valueDn - halfWidthDn, estimate.valueDn + halfWidthDn };
  return estimate;
}

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

/** Ends of an interval of the offset, minus the centre of the levels [DN]. */
struct OffsetEnds
{
  double low;
  double high;
};

/** Returns the reason why the illumination does not determine the offset \a estimate; "" if it does. */
std::string
FindFailureReason(const RefinedResults & found,
                  const GainEstimate &   gain,
                  const OffsetLimits &   limits,
                  const OffsetEstimate & estimate,
                  const OffsetEnds &     interval)
{
  const InitialNoiseModel &          model = found.scene.model;
  const OffsetLine &                 line = found.reestimated.line;
  const std::optional<LocalOffset> & local = found.reestimated.localOffset;
  const double                       rangeDn = model.brightestDn - model.darkestDn;
  const bool                         isLocal = found.HasLocalIllumination();
  const std::string                  moreFlicker = ", or record more flicker or more frames";
  const double                       slackDn = Significance.oneTest * estimate.standardErrorDn;
  const double                       slackBelowDn =
    slackDn + Significance.hint * std::sqrt(gain.covariance(1, 1)) / std::max(1e-9, gain.line.gain);
  const FrameOffsets & others = found.series.frameOffsets;
  if (!others.unlike.empty()) // too many to be left out
  {
    return TextOfOtherOffsets(others, line.response.rows());
  }
  if (!(line.contrast > InSeries.leastContrast))
  {
    return "the scene has one intensity" + Ask(", or include dark and bright areas in the scene");
  }
  if (line.isLevelMotion && !isLocal)
  {
    return "the scene is a ramp, along which motion changes every level alike, as an offset does" + Ask("");
  }
  if (!(line.flickerZ > Significance.everyPixel) && !isLocal)
  {
    return DescribeInsignificantFlicker(line.flickerZ) + Ask(moreFlicker);
  }
  if (isLocal && !local)
  {
    return "the illumination changes differently over the frame, and no part of it determines the offset" + Ask("");
  }
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high))
  {
    return "the flicker leaves the offset without bounds" + Ask(moreFlicker);
  }
  if (interval.high - interval.low > LargestOffsetInterval * rangeDn)
  {
    return "the interval of the offset, " + Rounded(interval.low + model.centreDn) + " to " +
           Rounded(interval.high + model.centreDn) + " DN, is wider than a quarter of the range of the scene, " +
           Rounded(rangeDn) + " DN" + Ask(moreFlicker);
  }
  if ((limits.lowestDn && estimate.valueDn < *limits.lowestDn - slackBelowDn) ||
      estimate.valueDn > limits.highestDn + slackDn)
  {
    return "the level that does not flicker, " + Rounded(estimate.valueDn) +
           " DN, is above the darkest level or makes the squared read noise negative: parts of the "
           "illumination flicker differently" +
           Ask("");
  }
  if (isLocal && local->phi > InRefined.largestLocalDispersion)
  {
    return "the lamps do not agree on one offset (dispersion " + RoundedApart(local->phi, 1.0) + ", expected 1)" +
           Ask("");
  }
  return {};
}

/** Returns the dark offset as the illumination determines it. */
OffsetEstimate
OffsetByIllumination(const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits)
{
  const InitialNoiseModel &          model = found.scene.model;
  const OffsetLine &                 line = found.reestimated.line;
  const std::optional<LocalOffset> & local = found.reestimated.localOffset;
  OffsetEstimate                     estimate;
  double                             low = line.low;
  double                             high = line.high;
  estimate.valueDn = line.offset + model.centreDn;
  estimate.standardErrorDn = line.standardError;
  estimate.phi = line.phi;
  const bool isLocal = found.HasLocalIllumination();
  if (isLocal && local)
  {
    estimate.valueDn = local->offset + model.centreDn;
    estimate.standardErrorDn = local->standardError;
    estimate.phi = local->phi;
    low = local->low;
    high = local->high;
  }
  estimate.interval = Interval{ low + model.centreDn, high + model.centreDn };

  // Offsets that differ between pixels are taken for signal, which moves the zero away from the levels. A non-linear
  // response has the same effect.
  const double lightDn = std::abs(model.centreDn - estimate.valueDn);
  const double fromPatternDn = lightDn * std::hypot(found.variance.pattern.offsetFraction, gain.RelativeModelError());
  if (fromPatternDn > InPixels.negligiblePattern * estimate.standardErrorDn)
  {
    estimate.standardErrorDn = std::hypot(estimate.standardErrorDn, fromPatternDn);
    low -= 1.96 * fromPatternDn;
    high += 1.96 * fromPatternDn;
    estimate.interval = Interval{ low + model.centreDn, high + model.centreDn };
  }
  estimate.failureReason = FindFailureReason(found, gain, limits, estimate, { low, high });
  return estimate;
}
} // namespace

OffsetEstimate
EstimateOffset(const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits)
{
  const OffsetEstimate estimate = OffsetByIllumination(found, gain, limits);
  return estimate.failureReason.empty() ? estimate : OffsetByExposures(found).value_or(estimate);
}

void
FillOffsetAndReadNoise(Report &               report,
                       const RefinedResults & found,
                       const GainEstimate &   gain,
                       const OffsetLimits &   limits,
                       const OffsetEstimate & flicker,
                       double                 quantisationDn2,
                       double                 student)
{
  report.fit.offsetLinePhi = flicker.phi;
  if (!found.settings.offset && !flicker.failureReason.empty())
  {
    report.Warn(WarningCode::OffsetNotIdentifiable, flicker.failureReason);
    FileBounds(report, limits, gain.line.gain);
    FillCovariance(report, gain, std::nullopt);
    return;
  }
  double offsetDn = flicker.valueDn;
  double offsetErrorDn = flicker.standardErrorDn;
  if (found.settings.offset)
  {
    offsetDn = found.settings.offset->valueDn;
    offsetErrorDn = found.settings.offset->standardErrorDn;
    CompareKnownOffset(report, found, gain, flicker, limits);
  }
  report.offset = WithError(offsetDn, offsetErrorDn);
  if (!found.settings.offset)
  {
    report.offset.interval95 = flicker.interval;
  }
  FillReadNoise(report, found, gain, offsetDn, offsetErrorDn, quantisationDn2, student);
  // The bracket contains the identified offset.
  report.offset.bracket = Interval{ limits.lowestDn, std::max(limits.highestDn, offsetDn + offsetErrorDn) };
  if (limits.lowestDn)
  {
    report.offset.bracket->low = std::min(*limits.lowestDn, offsetDn - offsetErrorDn);
  }
  FillCovariance(report, gain, offsetErrorDn * offsetErrorDn);
}

} // namespace sensornoise
