// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"

#include "base/Constants.h"
#include "base/ChiSquare.h"
#include "pixels/VarianceCurve.h"
#include "refined/Constants.h"
#include "refined/GainEstimate.h"
#include "report/Quantities.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace sensornoise
{

namespace
{
/** Returns why the standard deviation of \a flicker is not identifiable. */
FlickerFailure
FindFailure(const SeriesOfFlicker & flicker)
{
  const Quantity & sd = flicker.sd;
  // The noise of an unknown flicker may be large, but illumination that is off in most frames makes more than 1, too.
  const bool isLarge = sd.value && sd.standardError && *sd.standardError < InCommon.largestRelativeError * *sd.value;
  const bool isBelowOne = sd.interval95 && sd.interval95->high.value_or(2.0) < 1.0;
  if (!(flicker.scaleError > InCommon.largestRelativeError) && (isLarge || isBelowOne))
  {
    return FlickerFailure::None;
  }
  if (!std::isfinite(flicker.scaleError))
  {
    return FlickerFailure::UnknownOffset;
  }
  return flicker.scaleError > InCommon.largestRelativeError ? FlickerFailure::UncertainOffset
                                                            : FlickerFailure::NoiseOfFrames;
}

/** Variance of the illumination factor over the frames, with the error by the noise of the frames [1]. \a gamma has the
 * variance \a noise by the noise of the frames. */
MeasuredNumber
VarianceOfFlicker(const Eigen::VectorXd & gamma, double noise)
{
  const auto   dof = static_cast<double>(gamma.size()) - 1.0;
  const double variance = gamma.squaredNorm() / dof - noise;
  return { variance, 2.0 * std::sqrt(std::max(0.0, variance) * noise / dof) + noise * std::sqrt(2.0 / dof) };
}

/** Flicker beside a dark offset that may differ from frame to frame. */
struct FlickerBesideDrift
{
  MeasuredNumber variance;            ///< variance of the illumination factor [1]
  bool           isRequired{ false }; ///< no flicker alone, about the offset in use, explains the frames as well
};

/** Returns the flicker beside a drift of the dark offset, if a drift alone explains the frames as well as a flicker
 * alone does, by J of OffsetLine; null: it does not. */
std::optional<FlickerBesideDrift>
FindFlickerBesideDrift(const OffsetLine & line, double fromCentre, double errorDn)
{
  const Eigen::Matrix2d & g = line.illumination;
  // The inverse variance of a change of the slope, whatever the level does.
  const double precision = g.determinant() / g(0, 0);
  if (line.isLevelMotion || !(g(0, 0) > 0.0) || !(precision > 0.0) || !std::isfinite(errorDn))
  {
    return std::nullopt;
  }
  const Eigen::Matrix2d energy = line.response.transpose() * line.response;
  const auto            explained = [&](double m) {
    const Eigen::Vector2d v(-m, 1.0);
    return v.dot(energy * v) / v.dot(g * v);
  };
  const double range = Significance.hint * errorDn;
  const double nearest = std::clamp(line.offset, fromCentre - range, fromCentre + range);
  const double ofFlicker =
    std::max({ explained(fromCentre - range), explained(nearest), explained(fromCentre + range) });
  const double ofDrift = energy(0, 0) / g(0, 0);
  const double student = StudentQuantile(0.975, std::max(1.0, static_cast<double>(line.response.rows()) - 2.0));
  const double chance = student * student * line.Widening();
  if (ofDrift < ofFlicker - chance)
  {
    return std::nullopt;
  }
  const Eigen::VectorXd slopes = line.response * g.inverse().col(1);
  return FlickerBesideDrift{ VarianceOfFlicker(slopes, line.Widening() / precision), ofDrift > ofFlicker + chance };
}

/** Sets the flicker beside a drift of the dark offset, or extends the interval of \a flicker to it. */
void
AllowForDrift(const FlickerBesideDrift & beside, SeriesOfFlicker & flicker)
{
  const Quantity sd = RootOf(beside.variance.value, beside.variance.standardError);
  const double   least = sd.interval95 ? sd.interval95->low.value_or(0.0) : 0.0;
  if (beside.isRequired)
  {
    flicker.sd = sd;
    flicker.scaleError = 0.0;
  }
  else if (flicker.sd.interval95 && flicker.sd.interval95->high && !(least > 0.0))
  {
    flicker.sd = UpperLimit(*flicker.sd.interval95->high);
  }
  else if (flicker.sd.interval95 && flicker.sd.interval95->low)
  {
    flicker.sd.interval95->low = std::min(*flicker.sd.interval95->low, least);
  }
}
} // namespace

SeriesOfFlicker
EstimateFlicker(const RefinedResults & found, const UsedOffset & offset, double modelError)
{
  const double offsetFromCentre = offset.valueDn - found.scene.model.centreDn;
  OffsetLine   line = found.reestimated.line;
  line.UseOffset(offsetFromCentre);
  SeriesOfFlicker flicker;
  flicker.gamma = line.gamma;
  flicker.scaleError = std::abs(line.sensitivity) * offset.errorDn;
  const double noise = line.Widening() / line.precision;
  const auto   all = static_cast<Eigen::Index>(line.gamma.size());
  const auto [variance, ownError] = VarianceOfFlicker(Eigen::Map<const Eigen::VectorXd>(line.gamma.data(), all), noise);
  const double fromOffset = 2.0 * variance * std::hypot(line.sensitivity * offset.errorDn, modelError);
  flicker.sd = RootOf(variance, std::hypot(ownError, fromOffset));
  if (found.HasLocalIllumination() && !found.MayLocalIlluminationBeNoise())
  {
    const LocalFlicker & local = found.reestimated.localFlicker;
    const double         sd = local.Sd(offsetFromCentre);
    const double         step = 1.0 + offset.errorDn;
    const double         slope = (local.Sd(offsetFromCentre + step) - local.Sd(offsetFromCentre - step)) / (2.0 * step);
    const double         error = AddInQuadrature(slope * offset.errorDn, sd * std::sqrt(noise), sd * modelError);
    flicker.sd = RootOf(sd * sd, 2.0 * sd * error);
  }
  else if (const auto beside = FindFlickerBesideDrift(line, offsetFromCentre, offset.errorDn))
  {
    AllowForDrift(*beside, flicker);
  }
  flicker.limit = flicker.sd.interval95;
  flicker.failure = found.IsMotionLocal() ? FlickerFailure::LocalMotion : FindFailure(flicker);
  if (flicker.failure != FlickerFailure::None)
  {
    flicker.sd = Quantity::Without(EstimateStatus::NotIdentifiable);
  }
  return flicker;
}

namespace
{
/** Variances of the noise of whole rows, whole columns and periodic interference [DN^2]; 0: not significant. */
struct StructuredVariances
{
  MeasuredNumber ofFrames;
  MeasuredNumber ofDarkFrames;
};

MeasuredNumber
IfSignificant(const MeasuredNumber & variance)
{
  return variance.value > Significance.severalTests * variance.standardError ? variance : MeasuredNumber{};
}

/** Returns the structured noise of the frames and of the dark frames. The electronics add the same noise to both, which
 * is then the mean of both measurements. If they differ, each has its own: the illumination adds to the noise of the
 * frames, and where their temporal components took it for illumination, they have less. */
StructuredVariances
FindStructuredNoise(const NoiseCorrelation & correlation, const std::optional<KnownOffset> & known)
{
  const MeasuredNumber frames = correlation.SignificantStructuredNoise();
  if (!known || !known->structured)
  {
    return { frames, frames };
  }
  const DarkVariance & variance = known->structured->variance;
  const MeasuredNumber dark{ variance.valueDn2, variance.standardErrorDn2 };
  const MeasuredNumber all = correlation.StructuredNoiseWithScatter();
  if (!(all.standardError > 0.0) || !(dark.standardError > 0.0))
  {
    return { IfSignificant(dark), IfSignificant(dark) };
  }
  const double error = std::hypot(all.standardError, dark.standardError);
  if (std::abs(all.value - dark.value) > Significance.severalTests * error)
  {
    return { frames, IfSignificant(dark) };
  }
  const double         ofDark = all.standardError * all.standardError / (error * error);
  const MeasuredNumber both =
    IfSignificant({ ofDark * dark.value + (1.0 - ofDark) * all.value, all.standardError * dark.standardError / error });
  return { both, both };
}

/** Returns the correlation with another structured noise. */
NoiseCorrelation
WithStructuredNoise(NoiseCorrelation correlation, const MeasuredNumber & structured)
{
  correlation.rowsDn2 = structured;
  correlation.columnsDn2 = {};
  correlation.interference.clear();
  return correlation;
}

/** Returns the settings with the dark variance of the sensor before filters, without the structured noise. Dark frames
 * passed the same filter. \a correlation has the structured noise of the dark frames. */
RefinedSettings
SettingsOfSensor(RefinedSettings settings, const NoiseCorrelation & correlation, double quantisationDn2)
{
  if (settings.offset && settings.offset->variance)
  {
    const MeasuredNumber structured = correlation.SignificantStructuredNoise();
    DarkVariance &       dark = *settings.offset->variance;
    const double         spread = StandardDeviationOfShapes(dark.valueDn2, correlation, quantisationDn2);
    dark.valueDn2 = VarianceOfSensor(dark.valueDn2, correlation, quantisationDn2);
    dark.standardErrorDn2 = AddInQuadrature(
      FilterFactor(correlation) * dark.standardErrorDn2, FilterFactor(correlation) * structured.standardError, spread);
    settings.offset->maps.reset();
    if (auto & median = settings.offset->readNoiseMedian; median && FilterFactor(correlation) == 1.0)
    {
      const double square = median->valueDn * median->valueDn - structured.value;
      median->valueDn = std::sqrt(std::max(0.0, square));
    }
    else
    {
      median.reset(); // the median before a filter is not known
    }
  }
  return settings;
}

/** Returns the standard deviation that the vibration may have, if it is strong; null: its interval excludes that. */
std::optional<double>
FindStrongVibration(const RefinedResults & found, const SeriesOfMotion & motion)
{
  const auto alongAxis = [](const std::optional<double> & highest, double initial) {
    return highest ? std::min(*highest, std::sqrt(initial)) : std::sqrt(initial);
  };
  const double vibration = std::max(alongAxis(motion.highestSds[0], found.scene.model.vibrationXPixels2),
                                    alongAxis(motion.highestSds[1], found.scene.model.vibrationYPixels2));
  return vibration > InRefined.strongVibration && !found.IsFlatUnderChange() ? std::optional(vibration) : std::nullopt;
}

GainVerdict
TestSensor(const RefinedResults & found, const GainEstimate & gain, double effectOfLines)
{
  if (effectOfLines > 0.0)
  {
    return GainVerdict::LineIllumination;
  }
  return found.correlation.kind == NoiseKind::NotLinear ? GainVerdict::NoiseNotLinear : TestGain(found, gain);
}

/** Returns the ratio of the signals of the darkest and the brightest areas [1], if neither this ratio nor dark frames
 * would reveal a non-linear response; else null. */
std::optional<double>
FindUncheckedFraction(const RefinedResults & found, const GainEstimate & gain, double blackDn)
{
  const bool   hasDark = found.settings.offset && found.settings.offset->variance;
  const bool   isTested = hasDark && gain.isLinearityTested && !gain.isDarkRejected;
  const double inFrames = (found.InDarkestFrame(found.scene.model.centreDn) - blackDn) /
                          (found.InBrightestFrame(found.scene.model.centreDn) - blackDn);
  const double fraction =
    found.variance.curve.DarkestFraction(blackDn) * (gain.isFromFrames ? std::max(0.0, inFrames) : 1.0);
  return !isTested && fraction > InCommon.darkFraction ? std::optional(fraction) : std::nullopt;
}

/** Returns the estimate from the line \a gain of the sensor's variance, without the variance of the frames. */
RefinedEstimate
EstimateBy(const RefinedResults & found, const GainEstimate & gain)
{
  const double    quantisationDn2 = found.variance.quantisationNoise.darkVarianceDn2;
  RefinedEstimate estimate;
  estimate.known = found.settings.offset;
  estimate.limits = LimitsOf(found, gain, quantisationDn2);
  estimate.flickerOffset = EstimateOffset(found, gain, estimate.limits);
  const UsedOffset offset = ChooseOffset(found, gain, estimate.flickerOffset, estimate.limits);
  estimate.flicker = EstimateFlicker(found, offset, gain.RelativeModelError());
  estimate.motion = EstimateMotion(found, estimate.flicker.gamma, offset);
  estimate.strongVibrationPixels = FindStrongVibration(found, estimate.motion);
  estimate.effectOfLines = EffectOfLineIllumination(
    found.lines.left, found.scene.model.brightestDn - found.blackDn, gain.line.gain, InRefined.largestLineIllumination);
  const GainVerdict verdict = TestSensor(found, gain, estimate.effectOfLines);
  estimate.ofSensor = QuantitiesBy(verdict, gain, found, quantisationDn2);
  if (verdict != GainVerdict::Identified)
  {
    // Dark frames that contradict the frames have no quantities of their own: either may be wrong.
    const bool doContradict = verdict == GainVerdict::DarkFramesContradict;
    estimate.dark = QuantitiesOfDarkFrames(doContradict ? RefinedSettings() : found.settings,
                                           quantisationDn2,
                                           StatusBy(verdict),
                                           FilterFactor(found.correlation));
    return estimate;
  }
  estimate.dark = QuantitiesByOffset(found, gain, estimate.limits, estimate.flickerOffset, quantisationDn2);
  if (estimate.known)
  {
    const OffsetEstimate & flicker = estimate.flickerOffset;
    const double           error = std::hypot(flicker.standardErrorDn, estimate.known->standardErrorDn);
    estimate.isIlluminationSteady =
      flicker.IsIdentified() && std::abs(flicker.valueDn - estimate.known->valueDn) > Significance.oneTest * error;
    estimate.isOffsetOutOfLimits = IsKnownOffsetOutOfLimits(found, gain, estimate.limits);
  }
  estimate.uncheckedFraction =
    FindUncheckedFraction(found, gain, estimate.dark.offset.value.value_or(estimate.limits.rootDn));
  return estimate;
}

/** Returns the estimate for frames that have fewer samples than pixels. Bounds replace the gain and all quantities that
 * follow from it. One bound is the slope of the variance, as for white noise; the other is the slope of the
 * total covariance. */
RefinedEstimate
WithholdGain(RefinedEstimate estimate)
{
  const std::optional<Interval> & all = estimate.ofSensor.gain.interval95;
  const std::optional<Interval> & white = estimate.ofFrames.varianceSlope.interval95;
  if (!all || !white)
  {
    return estimate;
  }
  const auto lower = [](const Interval & a, const Interval & b) {
    return a.low && b.low ? std::optional(std::max(0.0, std::min(*a.low, *b.low))) : std::nullopt;
  };
  const auto higher = [](const Interval & a, const Interval & b) {
    return a.high && b.high ? std::optional(std::max(*a.high, *b.high)) : std::nullopt;
  };
  estimate.ofSensor.gain =
    Quantity::Without(EstimateStatus::NotIdentifiable, Interval{ lower(*all, *white), higher(*all, *white) });
  DarkQuantities & dark = estimate.dark;
  for (Quantity * const quantity :
       { &estimate.ofSensor.intercept, &dark.readNoise, &dark.readNoiseMedian, &dark.readNoiseElectrons })
  {
    *quantity = Quantity::Without(EstimateStatus::NotIdentifiable);
  }
  dark.covariance.reset();
  estimate.isWithheld = true;
  return estimate;
}
} // namespace

RefinedSettings
WithoutStructuredNoise(const RefinedSettings & settings)
{
  NoiseCorrelation correlation;
  correlation.kind = NoiseKind::White;
  return SettingsOfSensor(
    settings, WithStructuredNoise(correlation, FindStructuredNoise({}, settings.offset).ofDarkFrames), 0.0);
}

RefinedEstimate
EstimateRefined(const RefinedResults & found)
{
  const double              quantisationDn2 = found.variance.quantisationNoise.darkVarianceDn2;
  const GainEstimate        ofFrames = EstimateGain(found);
  RefinedEstimate           estimate;
  const StructuredVariances structured = FindStructuredNoise(found.correlation, found.settings.offset);
  if (found.correlation.IsCorrelated() || structured.ofFrames.value > 0.0 || structured.ofDarkFrames.value > 0.0)
  {
    const RefinedSettings settings = SettingsOfSensor(
      found.settings, WithStructuredNoise(found.correlation, structured.ofDarkFrames), quantisationDn2);
    const SensorLines    lines = AddCovariances(LinesOf(found.variance),
                                             WithStructuredNoise(found.correlation, structured.ofFrames),
                                             found.blackDn,
                                             quantisationDn2);
    const RefinedResults sensor = { settings,        found.scene,       found.series,
                                    found.variance,  found.reestimated, found.correctedVariance,
                                    found.blackDn,   found.correlation, found.frameNoise,
                                    found.lines,     found.exposures,   found.darkSignal,
                                    found.darkCharge };
    estimate = EstimateBy(sensor, EstimateGain(sensor, lines));
  }
  else
  {
    estimate = EstimateBy(found, ofFrames);
  }
  estimate.ofFrames = QuantitiesBy(TestGain(found, ofFrames), ofFrames, found, 0.0);
  if (found.correlation.kind == NoiseKind::Enlarged)
  {
    return WithholdGain(std::move(estimate));
  }
  return estimate;
}

} // namespace sensornoise
