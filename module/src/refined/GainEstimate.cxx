// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/GainEstimate.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "sensornoise/Settings.h"
#include "pixels/FixedPatternEstimate.h"
#include "pixels/VarianceCurve.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/Constants.h"
#include "refined/Constants.h"
#include "refined/FramePhotonTransfer.h"
#include "refined/RefinedEstimate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the remaining bias of the gain by large vibrations, for which the expansion in derivatives fails [DN/e-]. */
double
ErrorOfVibration(const VarianceLine & line, const InitialNoiseModel & model)
{
  const double square = std::max(model.vibrationXPixels2, model.vibrationYPixels2);
  return square > InRefined.strongVibration * InRefined.strongVibration ? InRefined.biasOfVibration * line.gain * square
                                                                        : 0.0;
}

/** Returns the largest error of the slope in a part of the pixels if their levels differ by fixed-pattern noise instead
 * of signal [DN/e-]. The fixed-pattern noise is \a pattern's fraction of the levels of all pixels. \a levelsDn2 is the
 * variance of the levels in the part: the dark parts of a scene may have no other differences. */
double
SlopeOfPattern(double gain, const FixedPatternEstimate & pattern, double levelsDn2)
{
  const double patternDn2 = pattern.LargestFraction() * pattern.levelVarianceDn2;
  return levelsDn2 > patternDn2 ? std::abs(gain) * patternDn2 / levelsDn2 : std::abs(gain);
}

double
DispersionOfClasses(const StaticVariance & variance)
{
  return variance.varianceInflation * BeyondChance(variance.classes.reducedChi2, ProjectedVariance::Classes - 1.0);
}

/** Chooses between the line of all pixels, with the error by fixed-pattern noise, and the instrumental-variable fit, by
 * their errors. Where they contradict, levels of single pixels depend on more than the scene: a pixel with telegraph
 * noise is both brighter and noisier. That fit is free of it. */
void
ChooseLine(GainEstimate &            estimate,
           const SensorLines &       lines,
           const StaticVariance &    variance,
           const InitialNoiseModel & model)
{
  const VarianceLine & all = lines.all;
  const double         dispersion = DispersionOfClasses(variance);
  const double         fromPattern = variance.pattern.LargestFraction() * std::abs(all.gain);
  const double         error = std::sqrt(dispersion * all.covariance(0, 0));
  estimate.line = all;
  estimate.covariance = dispersion * all.covariance;
  const VarianceLine & instrumental = lines.instrumentalLine;
  const double         errorOfInstrumental = std::sqrt(dispersion * instrumental.covariance(0, 0));
  if (instrumental.isDetermined &&
      (DoContradict(all, instrumental, dispersion) || std::hypot(error, fromPattern) > errorOfInstrumental))
  {
    estimate.line = lines.instrumentalLine;
    estimate.covariance = dispersion * lines.instrumentalLine.covariance;
  }
  else
  {
    estimate.covariance += SlopeCovariance(std::min(fromPattern, 100.0 * std::abs(all.gain)), all.pivotDn);
  }
  const double ofClasses = variance.classes.keptDeviation * std::abs(estimate.line.gain);
  const double ofSteps = variance.pattern.stepFraction * std::abs(estimate.line.gain);
  for (const double slopeError : { ErrorOfVibration(all, model), ofClasses, ofSteps })
  {
    estimate.covariance += SlopeCovariance(slopeError, all.pivotDn);
  }
  estimate.covariance += lines.covarianceOfCorrelation;
}

/** Fits one line on either side of \a step, with the same gain, and replaces the curve by the deviations from both
 * lines. */
void
ApplyStep(GainEstimate &            estimate,
          const VarianceStep &      step,
          const SensorLines &       lines,
          const StaticVariance &    variance,
          const InitialNoiseModel & model)
{
  estimate.step = step;
  estimate.line = step.line;
  estimate.curve = step.RestOf(lines.ofOwnLevels);
  estimate.reducedChi2 = estimate.curve.ReducedChi2(variance.varianceInflation);
  estimate.covariance = DispersionOfClasses(variance) * step.line.covariance + lines.covarianceOfCorrelation;
  const double ofPattern = variance.pattern.LargestFraction() * std::abs(step.line.gain);
  const double ofSteps = variance.pattern.stepFraction * std::abs(step.line.gain);
  for (const double error : { ErrorOfVibration(step.line, model), ofPattern, ofSteps, step.errorOfSlopes })
  {
    estimate.covariance += SlopeCovariance(error, step.line.pivotDn);
  }
}

/** Extends the interval to the gains of both amplifiers, or to the slope beside a step that is possible but not
 * certain.
 */
void
ExtendIntervalByStep(GainEstimate & estimate, const VarianceStep & step)
{
  const auto extend = [&](double slope) {
    double & side = slope < 0.0 ? estimate.below : estimate.above;
    side = std::max(side, std::abs(slope));
  };
  if (step.isCertain)
  {
    extend(step.slopeBelow);
    extend(step.slopeAbove);
  }
  else
  {
    extend(step.line.gain - estimate.line.gain);
  }
}

/** Extends the interval to the gain of pixels that were left out, although they have no motion. */
void
ExtendIntervalByLeftOut(GainEstimate & estimate, const StaticVariance & variance)
{
  estimate.above = std::max(estimate.above, variance.excessOfLeftOut * estimate.line.gain);
}

/** Extends the interval by the possible effect of illumination changes that could not be projected out. They add a
 * variance in proportion to the squared signal, whose slope is twice its ratio to the signal. They also correlate
 * neighbours, so that the total covariance over lags may contain illumination instead of noise. */
void
ExtendIntervalByIllumination(GainEstimate & estimate, const RefinedResults & found)
{
  const double rest = found.lines.remainingVariance;
  if (rest > 0.0)
  {
    const double ofVariance = (1.0 - InRefined.slopeOfRemaining * rest) * found.variance.line.gain;
    estimate.below = std::max(estimate.below, estimate.line.gain - ofVariance);
    estimate.above = std::max(estimate.above, ofVariance - estimate.line.gain);
  }
}

/** Extends the interval to the slope of the variance where the scene moves so much that motion may be left in the
 * residuals: it correlates neighbours as coupled charge does. */
void
ExtendIntervalByMotion(GainEstimate & estimate, const RefinedResults & found)
{
  const NoiseKind kind = found.correlation.kind;
  if ((kind == NoiseKind::Crosstalk || kind == NoiseKind::BrighterFatter) && !MovesLittle(found.scene.model))
  {
    const double slope = found.variance.line.gain;
    estimate.below = std::max(estimate.below, estimate.line.gain - slope);
    estimate.above = std::max(estimate.above, slope - estimate.line.gain);
  }
}

/** Extends the interval to the gains of the darker and the brighter half of the levels, where they differ significantly
 * from the gain of all. */
void
ExtendIntervalByHalves(GainEstimate &               estimate,
                       const VarianceCurve &        curve,
                       const FixedPatternEstimate & pattern,
                       double                       dispersion)
{
  for (const SlopeExcess & half : curve.FitHalves())
  {
    double & side = half.value < 0.0 ? estimate.below : estimate.above;
    // The bins are sorted by the mean of 8 neighbours, which has an eighth of the variance of fixed-pattern noise.
    const double ofPattern = SlopeOfPattern(curve.line.gain, pattern, 8.0 * half.levelsDn2);
    const double variance = dispersion * half.variance + ofPattern * ofPattern;
    side = std::max(side, SizeBeyondChance(half.value, variance, Significance.oneTest));
  }
}

/** If the response is visibly non-linear, replaces the slope, which is then not the gain, by the mean local gain. */
void
ApplyMeanGain(GainEstimate & estimate, const VarianceCurve & curve, double blackDn, double dispersion)
{
  const std::optional<MeanGain> parabola = FindMeanGain(curve, 2);
  if (!parabola)
  {
    return;
  }
  const double difference = parabola->value - curve.line.gain;
  const double chance = dispersion * parabola->variance;
  const bool   isSure =
    estimate.IsNonlinear() || difference * difference > Significance.oneTest * Significance.oneTest * chance;
  if (!isSure || !(estimate.nonlinearity > InPixels.leastDeviation))
  {
    double & side = difference < 0.0 ? estimate.below : estimate.above;
    side = std::max(side, SizeBeyondChance(difference, chance, Significance.hint));
    return;
  }
  const MeanGain best = FindMeanGain(curve, 3).value_or(*parabola);
  const double   ofShape = InRefined.errorOfNonlinearity * estimate.nonlinearity * best.value;
  const double   atPivot = estimate.line.intercept + estimate.line.gain * estimate.line.pivotDn;
  estimate.below = estimate.above =
    std::max(ofShape, InRefined.errorOfMeanGain * std::abs(best.value - curve.line.gain));
  const double read = curve.line.intercept + curve.line.gain * blackDn;
  const auto   shotNoise = FindMeanGain(curve, 2, blackDn);
  if (shotNoise && read > InRefined.largestReadFraction * curve.line.At(curve.LevelOf(curve.bins.back())))
  {
    estimate.above = std::max(estimate.above, shotNoise->value - best.value);
    estimate.below = std::max(estimate.below, best.value - shotNoise->value);
  }
  estimate.line.gain = best.value;
  estimate.line.intercept = atPivot - best.value * estimate.line.pivotDn;
  estimate.covariance += SlopeCovariance(std::sqrt(dispersion * best.variance), estimate.line.pivotDn);
}

void
FindModelError(GainEstimate &               estimate,
               const VarianceCurve &        curve,
               const FixedPatternEstimate & pattern,
               double                       blackDn,
               double                       dispersion)
{
  estimate.isWide = curve.DarkestFraction(blackDn) < InRefined.largestDarkestFraction;
  if (!estimate.isWide && std::sqrt(estimate.covariance(0, 0)) > InCommon.largestRelativeError * estimate.Size())
  {
    return; // deviations from a line that is not known have no meaning
  }
  estimate.nonlinearity = curve.Nonlinearity(dispersion);
  ExtendIntervalByHalves(estimate, curve, pattern, dispersion);
  if (estimate.isWide)
  {
    ApplyMeanGain(estimate, curve, blackDn, dispersion);
  }
  const double beyond = BeyondChance(estimate.reducedChi2, static_cast<double>(curve.bins.size()) - 2.0);
  if (!estimate.IsCurved() && beyond > 1.0)
  {
    // The remaining deviations scatter about a line that is straight enough, and may be alike at neighbouring levels.
    estimate.covariance *= beyond;
    const double ofGroups = curve.SlopeVarianceByGroups() - estimate.covariance(0, 0);
    estimate.covariance += SlopeCovariance(std::sqrt(std::max(0.0, ofGroups)), estimate.line.pivotDn);
  }
}
/** Returns the estimate by frames of unequal illumination alone. */
GainEstimate
EstimateOfFrames(const VarianceCurve &   frames,
                 const Eigen::Matrix2d & covarianceOfCorrelation,
                 double                  blackDn,
                 double                  varianceInflation)
{
  GainEstimate estimate;
  estimate.line = frames.line;
  estimate.curve = frames;
  estimate.covariance = frames.line.covariance + covarianceOfCorrelation;
  estimate.reducedChi2 = frames.ReducedChi2(varianceInflation);
  estimate.isFromFrames = true;
  FindModelError(estimate, frames, {}, blackDn, varianceInflation); // no fixed-pattern noise between frames
  return estimate;
}

/** Combines the slopes by pixels and by frames. Their sampling noise is independent, and the error of the correlation
 * is the same in both. The variance at the pivot is taken from the more precise estimate. If either shows a non-linear
 * response, the more precise one is used alone. */
void
CombineWithFrames(GainEstimate & estimate, const SensorLines & lines, double blackDn, double varianceInflation)
{
  if (!lines.fromFrames.line.isDetermined || estimate.step) // the variance of the frames has the step, too
  {
    return;
  }
  GainEstimate other = EstimateOfFrames(lines.fromFrames, lines.covarianceOfCorrelation, blackDn, varianceInflation);
  other.scale = estimate.scale;
  if (other.StandardError() < estimate.StandardError())
  {
    std::swap(other, estimate);
  }
  const bool              isNonlinear = estimate.IsNonlinear() || other.IsNonlinear();
  const double            difference = other.line.gain - estimate.line.gain;
  const Eigen::Matrix2d & common = lines.covarianceOfCorrelation;
  const double            expected =
    std::pow(estimate.StandardError(), 2) + std::pow(other.StandardError(), 2) - 2.0 * common(0, 0);
  if (!isNonlinear)
  {
    const Eigen::Matrix2d own = estimate.covariance - common;
    const Eigen::Vector2d step = own.col(0) / expected;
    estimate.line.gain += step(0) * difference;
    estimate.line.intercept += step(1) * difference;
    estimate.covariance -= step * own.row(0);
  }
  if (difference * difference > Significance.hint * Significance.hint * expected)
  {
    estimate.covariance += SlopeCovariance(0.5 * difference, estimate.line.pivotDn);
  }
}
} // namespace

bool
GainEstimate::IsCurved() const
{
  return this->IsNonlinear() && nonlinearity > InPixels.leastDeviation;
}

double
GainEstimate::RelativeModelError() const
{
  return this->IsNonlinear() ? 0.5 * (below + above) / std::max(smallestDivisor, line.gain) : 0.0;
}

double
GainEstimate::Size() const
{
  return std::max(scale, line.gain - Significance.hint * std::sqrt(covariance(0, 0)));
}

double
GainEstimate::StandardError() const
{
  return std::hypot(std::sqrt(covariance(0, 0)), 0.5 * (below + above));
}

namespace
{
/** Returns whether the known offset lies above the level that does not flicker, beyond its error, and by so much that
 * the shot noise of the difference changes the dark variance. No steady illumination explains that. */
bool
IsKnownOffsetAboveFlicker(const RefinedResults & found, const GainEstimate & gain)
{
  const KnownOffset &  known = *found.settings.offset;
  const OffsetLimits   limits = LimitsOf(found, gain, found.variance.quantisationNoise.darkVarianceDn2);
  const OffsetEstimate flicker = EstimateOffset(found, gain, limits);
  const double         differenceDn = known.valueDn - flicker.valueDn;
  const double varianceDn2 = known.variance ? known.variance->valueDn2 : std::max(0.0, gain.line.At(flicker.valueDn));
  return flicker.IsIdentified() &&
         differenceDn > Significance.oneTest * std::hypot(flicker.standardErrorDn, known.standardErrorDn) &&
         differenceDn * gain.line.gain > InCommon.leastDarkDifference * varianceDn2;
}
} // namespace

GainEstimate
EstimateGain(const RefinedResults & found, const SensorLines & lines)
{
  const StaticVariance & variance = found.variance;
  GainEstimate           estimate;
  estimate.curve = lines.curve;
  estimate.reducedChi2 = lines.curve.ReducedChi2(variance.varianceInflation);
  ChooseLine(estimate, lines, variance, found.scene.model);
  const std::optional<VarianceStep> step = FindVarianceStep(lines.ofOwnLevels);
  if (step && step->isCertain)
  {
    ApplyStep(estimate, *step, lines, variance, found.scene.model);
  }
  estimate.scale =
    estimate.line.At(estimate.line.pivotDn) / std::max(smallestDivisor, estimate.line.pivotDn - found.blackDn);
  const double dispersion =
    std::min(DispersionOfClasses(variance), InRefined.largestDispersion * variance.varianceInflation);
  FindModelError(estimate, estimate.curve, variance.pattern, found.blackDn, dispersion);
  if (step)
  {
    ExtendIntervalByStep(estimate, *step);
  }
  ExtendIntervalByIllumination(estimate, found);
  ExtendIntervalByMotion(estimate, found);
  ExtendIntervalByLeftOut(estimate, variance);
  const Eigen::Vector2d & ofOffsets = found.reestimated.partOffsets.ofLine;
  estimate.covariance += ofOffsets * ofOffsets.transpose();
  CombineWithFrames(estimate, lines, found.blackDn, variance.varianceInflation);
  if (found.settings.offset)
  {
    estimate.isOffsetAboveFlicker = IsKnownOffsetAboveFlicker(found, estimate);
    estimate.isDarkRejected = found.settings.offset->variance && (found.darkSignal || estimate.isOffsetAboveFlicker);
    if (found.settings.offset->variance && !estimate.isDarkRejected)
    {
      CombineWithDarkPoint(estimate, found);
    }
  }
  return estimate;
}

} // namespace sensornoise
