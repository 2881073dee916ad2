// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/Quantiles.h"
#include "moments/DarkFrames.h"
#include "pixels/Constants.h"
#include "refined/Constants.h"
#include "refined/GainEstimate.h"
#include "report/Quantities.h"
#include "sensornoise/Settings.h"
#include "series/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the darkest quantile of the neighbours' means of the usable pixels [DN]. */
double
DarkestNeighbourhood(const ReferenceFrame & frame)
{
  std::vector<double> levels;
  for (const std::size_t p : SamplePixels(frame.usable))
  {
    levels.push_back(frame.neighbourMean[p]);
  }
  return Quantile(levels, InCommon.darkestQuantile);
}
} // namespace

OffsetLimits
LimitsOf(const RefinedResults & found, const GainEstimate & gain, double quantisationDn2)
{
  const VarianceLine & v = gain.line;
  const auto           frames = static_cast<double>(found.scene.frame.frames);
  const double         student = StudentQuantile(0.975, frames - 2.0);
  const double         slopeError = std::sqrt(gain.covariance(0, 0));
  const double         atPivot = v.intercept + v.gain * v.pivotDn;
  const double         slope = v.gain - gain.below - student * slopeError;
  OffsetLimits         limits;
  // The darkest pixels are dark also because of noise and their own offsets. Both are smaller in the means of eight
  // pixels.
  const double darkestDn = found.InDarkestFrame(DarkestNeighbourhood(found.scene.frame));
  const double spreadDn2 = (v.At(darkestDn) / frames + found.variance.pattern.OffsetVarianceDn2()) / 8.0;
  limits.rootDn = v.gain > 0.0 ? std::min(-v.intercept / v.gain, darkestDn) : darkestDn;
  if (slope > 0.0)
  {
    const Eigen::Vector2d pivot(v.pivotDn, 1.0);
    const double          pivotError = std::sqrt(std::max(0.0, pivot.dot(gain.covariance * pivot)));
    limits.lowestDn = std::min(v.pivotDn - (atPivot + student * pivotError) / slope, darkestDn);
  }
  limits.highestDn = darkestDn + Significance.oneTest * std::sqrt(spreadDn2);
  const Eigen::Vector2d design(limits.highestDn, 1.0);
  const double          error = std::sqrt(std::max(0.0, design.dot(gain.covariance * design)));
  limits.largestNoiseDn2 = std::max(0.0, v.intercept + v.gain * limits.highestDn + student * error - quantisationDn2);
  return limits;
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

/** Ends of an interval of the offset, minus the centre of the levels [DN]. */
struct OffsetEnds
{
  double low;
  double high;
};

/** Returns why the illumination does not determine the offset \a estimate, if it does not. */
OffsetFailure
FindFailure(const RefinedResults & found,
            const GainEstimate &   gain,
            const OffsetLimits &   limits,
            const OffsetEstimate & estimate,
            const OffsetEnds &     interval)
{
  const InitialNoiseModel &          model = found.scene.model;
  const OffsetLine &                 line = found.reestimated.line;
  const std::optional<LocalOffset> & local = found.reestimated.localOffset;
  const bool                         isLocal = found.HasLocalIllumination();
  const double                       slackDn = Significance.oneTest * estimate.standardErrorDn;
  const double                       slackBelowDn =
    slackDn + Significance.hint * std::sqrt(gain.covariance(1, 1)) / std::max(smallestDivisor, gain.line.gain);
  if (!found.series.frameOffsets.unlike.empty())
  {
    return OffsetFailure::UnlikeOffsets;
  }
  if (!(line.contrast > InSeries.leastContrast))
  {
    return OffsetFailure::OneIntensity;
  }
  if (line.isLevelMotion && !isLocal)
  {
    return OffsetFailure::Ramp;
  }
  if (!(line.flickerZ > Significance.everyPixel) && !isLocal)
  {
    return OffsetFailure::FaintFlicker;
  }
  if (isLocal && (!local || found.MayLocalIlluminationBeNoise() || found.IsMotionLocal()))
  {
    return OffsetFailure::LocalIllumination;
  }
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high))
  {
    return OffsetFailure::Unbounded;
  }
  if (interval.high - interval.low > LargestOffsetInterval * (model.brightestDn - model.darkestDn))
  {
    return OffsetFailure::WideInterval;
  }
  if ((limits.lowestDn && estimate.valueDn < *limits.lowestDn - slackBelowDn) ||
      estimate.valueDn > limits.highestDn + slackDn)
  {
    return OffsetFailure::OutOfLimits;
  }
  if ((isLocal && local->areParallel) ||
      found.reestimated.partOffsets.BeyondChanceDn(Significance.severalTests) > line.standardError)
  {
    return OffsetFailure::OffsetsDiffer;
  }
  return isLocal && !local->doLinesMeet ? OffsetFailure::OffsetsDisagree : OffsetFailure::None;
}

/** Returns the error of the offset \a offsetDn by rounding to digital numbers [DN]. In a frame with little illumination
 * all pixels have about one level, so that rounding shifts all of them alike where the noise is below half a step.
 * Levels that differ by several steps are shifted both ways. */
double
RoundingOfDarkestFrameDn(const RefinedResults & found, const GainEstimate & gain, double offsetDn)
{
  const double stepDn = found.scene.summary.dnRange.quantisationStepDn;
  if (!(stepDn > 0.0))
  {
    return 0.0;
  }
  const std::vector<double> &  gamma = found.reestimated.line.gamma;
  const FixedPatternEstimate & pattern = found.variance.pattern;
  const double                 factor = gamma.empty() ? 1.0 : 1.0 + *std::min_element(gamma.begin(), gamma.end());
  const double                 varianceDn2 = gain.line.At(offsetDn + factor * (gain.line.pivotDn - offsetDn));
  const double stepsApart = std::abs(factor) * std::sqrt(std::max(0.0, pattern.levelVarianceDn2)) / stepDn;
  return RoundingErrorDn(stepDn, varianceDn2 + pattern.OffsetVarianceDn2()) / std::max(1.0, stepsApart);
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
  // response has the same effect. Offsets that differ between parts of the frame move it either way. Optics that change
  // as the illumination does move it where the scene is rough.
  const double signalDn = std::abs(model.centreDn - estimate.valueDn);
  const double ofPartsDn = found.reestimated.partOffsets.BeyondChanceDn(Significance.hint);
  const double systematicDn = AddInQuadrature(signalDn * found.variance.pattern.offsetFraction,
                                              signalDn * gain.RelativeModelError(),
                                              AddInQuadrature(isLocal ? 0.0 : line.differenceOfClassesDn,
                                                              ofPartsDn,
                                                              RoundingOfDarkestFrameDn(found, gain, estimate.valueDn)));
  if (systematicDn > InPixels.negligiblePattern * estimate.standardErrorDn)
  {
    estimate.standardErrorDn = std::hypot(estimate.standardErrorDn, systematicDn);
    low -= 1.96 * systematicDn;
    high += 1.96 * systematicDn;
    estimate.interval = Interval{ low + model.centreDn, high + model.centreDn };
  }
  estimate.failure = FindFailure(found, gain, limits, estimate, { low, high });
  return estimate;
}
} // namespace

OffsetEstimate
EstimateOffset(const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits)
{
  const OffsetEstimate estimate = OffsetByIllumination(found, gain, limits);
  return estimate.IsIdentified() ? estimate : OffsetByExposures(found).value_or(estimate);
}

bool
IsKnownOffsetOutOfLimits(const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits)
{
  const KnownOffset & known = *found.settings.offset;
  const double        slackDn = Significance.oneTest * known.standardErrorDn;
  const double        errorDn = Significance.hint * std::sqrt(gain.covariance(1, 1)) / gain.line.gain;
  const double        rangeDn = found.scene.model.brightestDn - found.scene.model.darkestDn;
  // The line determines the lower limit alone.
  return (limits.lowestDn && known.valueDn < *limits.lowestDn - slackDn - errorDn) ||
         known.valueDn > limits.highestDn + slackDn + InRefined.slackOfRange * rangeDn;
}

UsedOffset
ChooseOffset(const RefinedResults & found,
             const GainEstimate &   gain,
             const OffsetEstimate & flicker,
             const OffsetLimits &   limits)
{
  const auto & known = found.settings.offset;
  if (known && !gain.isDarkRejected && !gain.isOffsetAboveFlicker && !IsKnownOffsetOutOfLimits(found, gain, limits))
  {
    return { known->valueDn, known->standardErrorDn };
  }
  if (flicker.IsIdentified())
  {
    return { flicker.valueDn, flicker.standardErrorDn };
  }
  // An offset that is not identifiable lies between the level of sigma = 0 and the darkest level, with about equal
  // probability.
  const double lowestDn = limits.lowestDn.value_or(std::min(found.blackDn, limits.highestDn));
  return { 0.5 * (lowestDn + limits.highestDn), (limits.highestDn - lowestDn) / std::sqrt(12.0) };
}

} // namespace sensornoise
