// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"

#include "base/Constants.h"
#include "base/Text.h"
#include "pixels/Constants.h"
#include "pixels/FixedPatternEstimate.h"
#include "pixels/VarianceCurve.h"
#include "refined/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace sensornoise
{

namespace
{
/** Returns the advice to check whether frames and dark frames were exchanged, if the dark frames are brighter; else
 * \a otherwise. */
std::string
AskIfExchanged(const RefinedResults & found, const std::string & otherwise)
{
  const auto & known = found.settings.offset;
  if (!known || known->darkFrames == 0 || !(known->valueDn > found.scene.model.brightestDn))
  {
    return otherwise;
  }
  return "The dark frames are brighter than the frames, with " + Rounded(known->valueDn) + " DN against " +
         RoundedApart(found.scene.model.brightestDn, known->valueDn) + " DN. Check whether they are exchanged";
}

/** Returns why the variance does not fit a sensor of one gain, and what to do. */
std::string
TextOfFailure(const RefinedResults & found, const TestedGain & tested)
{
  const GainEstimate & gain = tested.line;
  const std::string    notRaw = ": the frames are not raw (gamma, compression), not linear";
  const bool           hasClipLevel = found.scene.summary.dnRange.clipHighDn.has_value();
  switch (tested.verdict)
  {
    case GainVerdict::FramesDiffer:
      return "the noise variance of the frames does not follow their levels, " +
             (found.frameNoise.scatter > 0.0
                ? "by " + PercentApart(found.frameNoise.scatter, InRefined.leastUnlikeNoise) + " rms"
                : "in groups (" + found.frameNoise.Text(gain.line.gain) + "; the first frame is 0)") +
             " (expected at most " + Percent(InRefined.leastUnlikeNoise) +
             "): they have several gains or were processed differently. Measure the frames of each kind by themselves: "
             "--frames";
    case GainVerdict::IlluminationIsLeft:
      return "the spatial noise correlation changes the gain by a factor of " +
             RoundedApart(CorrectionByCorrelation(found, gain), InRefined.largestCorrection) + " (expected at most " +
             Rounded(InRefined.largestCorrection) +
             "), but changes of the illumination that are left correlate neighbours, too. Record more frames, or "
             "choose an evenly lit part at rest: --roi";
    case GainVerdict::MotionIsLeft:
      return "the noise correlation between frames changes the gain by a factor of " +
             RoundedApart(CorrectionByCorrelation(found, gain), 1.0 + InRefined.leastUnlikeNoise) +
             " (expected at most " + Rounded(1.0 + InRefined.leastUnlikeNoise) +
             "), but the scene moves by more than " + Rounded(InRefined.strongVibration) +
             " pixels rms, and motion correlates frames, too. Switch noise reduction and interpolation in time off, or "
             "keep camera and scene still";
    case GainVerdict::NotAffine:
      return "the variance deviates from its line by " +
             PercentApart(gain.nonlinearity, InRefined.largestNonlinearity) + " of itself (expected less than " +
             Percent(InRefined.largestNonlinearity) + ")" + notRaw +
             (hasClipLevel
                ? ", or of several gains. Record raw frames, or fit the linear part alone: --level-range LOW,HIGH"
                : ", or saturated. Record raw frames, or give the levels at which they saturate: --clip LOW,HIGH");
    case GainVerdict::GainDependsOnOffset:
      return "the variance is a curve of the mean, so that the gain depends on the assumed read noise and is between " +
             Rounded(gain.line.gain - gain.below) + " and " + Rounded(gain.line.gain + gain.above) + " DN/e-" + notRaw +
             ", or of several gains. Record raw frames";
    default:
      return "the variance does not rise with the mean (slope " + Measured(gain.line.gain, gain.StandardError()) +
             " DN/e-, expected above 0): the frames are not raw, or have too little noise. " +
             AskIfExchanged(found, "Record raw frames");
  }
}

std::string
TextOfResampling(const LinesOfSensor & lines)
{
  return "the variance differs from column to column by " + PercentApart(lines.columns.size, InParts.sizeByWeights) +
         " rms, and from row to row by " + PercentApart(lines.rows.size, InParts.sizeByWeights) +
         " (expected at most " + Percent(InParts.sizeByWeights) +
         " in one of them): the frames were resampled by interpolation. Give the frames as the camera read them";
}

/** Returns the reason why the illumination of rows or columns makes the gain not identifiable. It adds the fraction
 * \a effect to the slope [1]. */
std::string
TextOfLineIllumination(const LineIllumination & lines, double effect)
{
  return "the illumination differs from " + lines.NameOfLine() + " to " + lines.NameOfLine() + " within a frame by " +
         Percent(std::sqrt(lines.left.value)) + " rms, which adds " +
         PercentApart(effect, InRefined.largestLineIllumination) + " to the slope of the variance (expected at most " +
         Percent(InRefined.largestLineIllumination) +
         "): pulsed illumination under a rolling shutter, or interlaced frames. Use steady light sources, expose "
         "for whole periods of the illumination, or give one field of the frames";
}

std::string
TextOfTooFewPixels(std::size_t used, double usable, const GainEstimate & gain)
{
  return PercentApart(static_cast<double>(used) / std::max(1.0, usable), InRefined.leastUsedFraction) +
         " of the pixels that are not clipped fit a static scene (expected at least " +
         Percent(InRefined.leastUsedFraction) + "), which would give a gain of " +
         Measured(gain.line.gain, gain.StandardError()) +
         " DN/e-: the scene moves, or is too dark. Choose a static part of it (--roi), or more light";
}

std::string
TextOfLitFrames(const LitFrames & lit, Eigen::Index frames)
{
  const std::size_t count = lit.frames.size();
  std::string       names;
  for (std::size_t i = 0; i < count; ++i)
  {
    names += (i == 0 ? "" : i + 1 == count ? " and " : ", ") + std::to_string(lit.frames[i]);
  }
  return (count == 1 ? "frame " + names + " alone carries " : "frames " + names + " carry ") +
         Percent(lit.illumination) + " of the illumination of " + std::to_string(frames) +
         " distinct frames (the first is 0): flicker and motion take up all but " +
         PercentApart(lit.noiseFraction, 1.0 - InPixels.largestFeedback) + " of their shot noise (expected at least " +
         Percent(1.0 - InPixels.largestFeedback) + "). The gain is not identifiable: record more illuminated frames";
}

std::string
TextOfLevels(const RefinedResults & found, const GainEstimate & gain)
{
  const FixedPatternEstimate & pattern = found.variance.pattern;
  const double                 levels = std::sqrt(std::max(0.0, pattern.levelVarianceDn2));
  const bool                   hasDark = found.settings.offset && found.settings.offset->darkFrames > 0;
  return "the levels of the scene do not determine the gain: they differ by " + Rounded(levels) + " DN rms, " +
         Percent(levels / std::max(smallestDivisor, gain.line.pivotDn - found.blackDn)) +
         " of the signal, and fixed-pattern noise may explain " +
         Percent(std::min(1.0, std::max(pattern.LargestFraction(), pattern.stepFraction))) +
         " of that. The gain is known only to +- " + Rounded(gain.StandardError()) + " of about " +
         Rounded(gain.Size()) + " DN/e-. " +
         AskIfExchanged(
           found,
           hasDark ? "Record more frames, or include dark and bright areas in the scene"
                   : "Record more frames, include dark and bright areas in the scene, or give dark frames (--dark)");
}

/** Returns whether most of the variance of the gain is by the error of the temporal correlation. */
bool
IsByTemporalCorrelation(const RefinedResults & found, const GainEstimate & gain)
{
  const MeasuredNumber & factor = found.correlation.timeFactor;
  const double           ofFactor = factor.standardError / factor.value * gain.line.gain;
  return found.correlation.kind == NoiseKind::Temporal &&
         2.0 * ofFactor * ofFactor > gain.StandardError() * gain.StandardError();
}

std::string
TextOfTemporalCorrelation(const GainEstimate & gain)
{
  return "the noise is correlated over more frames than the burst shows, as behind noise reduction in time: the gain "
         "is known only to +- " +
         Rounded(gain.StandardError()) + " of about " + Rounded(gain.Size()) +
         " DN/e-. Switch the noise reduction of the camera off, or record more frames";
}

std::string
TextOfDarkFrames(const RefinedResults & found, const GainEstimate & gain)
{
  const DarkVariance & dark = *found.settings.offset->variance;
  return "the dark frames have a noise variance of " + Measured(dark.valueDn2, dark.standardErrorDn2) +
         " DN^2, but the line of the variance has " +
         Measured(gain.atOffset->valueDn2, gain.atOffset->standardErrorDn2) +
         " DN^2 at their level, and the levels of the scene are too alike for a line without them: parts of the sensor "
         "may have a gain or an offset of their own, or the dark frames another setting. Include dark and bright areas "
         "in the scene";
}

std::string
AdviceOn(Divided divided)
{
  switch (divided)
  {
    case Divided::Phases:
      return "Measure the colours of a mosaic by themselves (--bayer), or the pixels of each amplifier (--mask)";
    case Divided::Frames:
      return "The camera changed while it recorded, or frames were processed: measure the parts by themselves "
             "(--frames)";
    case Divided::Places:
      break;
  }
  return "Measure the parts by themselves (--roi)";
}

void
WarnOfParts(Report & report, const UnlikeParts & parts)
{
  const auto [lowest, highest] = parts.Extremes();
  report.Warn(WarningCode::GainNotUniform,
              "the gain differs between " + parts.words + ": from " + Measured(lowest.gain, lowest.standardError) +
                " DN/e- (" + lowest.name + ") to " + Measured(highest.gain, highest.standardError) + " DN/e- (" +
                highest.name + "), " + PercentApart(parts.rms, InParts.leastDifference) + " rms (expected at most " +
                Percent(InParts.leastDifference) + "), and their mean is given. " + AdviceOn(parts.divided));
}

void
WarnOfStep(Report & report, const GainEstimate & gain)
{
  if (gain.step)
  {
    const VarianceStep & step = *gain.step;
    const double         below = step.line.At(step.levelDn);
    const double         larger = std::max({ smallestDivisor, below, below + step.sizeDn2 });
    report.Warn(
      WarningCode::VarianceSteps,
      "the variance steps by " + Measured(step.sizeDn2, step.errorDn2) + " DN^2 at " + Rounded(step.levelDn) + " DN, " +
        PercentApart(std::abs(step.sizeDn2) / larger, InSteps.leastSize) +
        " of the larger variance (expected less than " + Percent(InSteps.leastSize) +
        "), as where two amplifiers read the pixels; intercept and read noise are of the levels below. Measure "
        "either side by itself: --level-range");
  }
}

void
WarnOfLeftOut(Report & report, const StaticVariance & variance)
{
  if (variance.excessOfLeftOut > 0.0)
  {
    const double fraction =
      static_cast<double>(variance.notStatic) / static_cast<double>(report.pixels.used + variance.notStatic);
    report.Warn(WarningCode::GainNotUniform,
                Percent(fraction) + " of the pixels have a gain of their own, " + Percent(variance.excessOfLeftOut) +
                  " larger than the gain of the others, and are left out: their variance is larger by as much in all "
                  "places, which motion does not cause. Processing that depends on the scene does, as the merging of "
                  "frames. If there is a gain, its interval contains both. Switch the processing off, or measure "
                  "either part by itself (--mask)");
  }
}

void
WarnOfIdentified(Report & report, const TestedGain & tested)
{
  const GainEstimate & gain = tested.line;
  for (const UnlikeParts & parts : tested.parts)
  {
    WarnOfParts(report, parts);
  }
  WarnOfStep(report, gain);
  if (gain.IsCurved())
  {
    report.Warn(
      WarningCode::ResponseNotStraight,
      "the variance deviates from its line by up to " + PercentApart(gain.nonlinearity, InPixels.leastDeviation) +
        " of itself (expected at most " + Percent(InPixels.leastDeviation) +
        "): the response is non-linear, and the interval of the gain contains the gains of parts of the levels, " +
        Rounded(gain.line.gain - gain.below) + " to " + Rounded(gain.line.gain + gain.above) +
        " DN/e-. Fit a linear part alone: --level-range");
  }
}
} // namespace

void
WarnOfGain(Report & report, const RefinedResults & found, const TestedGain & tested, double effectOfLines)
{
  WarnOfLeftOut(report, found.variance);
  switch (tested.verdict)
  {
    case GainVerdict::Identified:
      WarnOfIdentified(report, tested);
      return;
    case GainVerdict::NoiseNotLinear: // WarnOfCorrelation() has the reason
      return;
    case GainVerdict::DarkFramesContradict:
      report.Warn(WarningCode::VarianceNotAffine, TextOfDarkFrames(found, tested.line));
      return;
    case GainVerdict::LineIllumination:
      report.Warn(WarningCode::Contradicted, TextOfLineIllumination(found.lines, effectOfLines));
      return;
    case GainVerdict::TooFewPixels:
      report.Warn(WarningCode::TooLittleToMeasure,
                  TextOfTooFewPixels(report.pixels.used, found.scene.usable, tested.line));
      return;
    case GainVerdict::FewLitFrames:
      report.Warn(WarningCode::TooLittleToMeasure,
                  TextOfLitFrames(*FindFewLitFrames(found), found.series.basis.GetBasis().rows()));
      return;
    case GainVerdict::LevelsTooAlike:
      if (IsByTemporalCorrelation(found, tested.line))
      {
        report.Warn(WarningCode::TooLittleToMeasure, TextOfTemporalCorrelation(tested.line));
        return;
      }
      report.Warn(WarningCode::IntensityRangeTooSmall, TextOfLevels(found, tested.line));
      return;
    case GainVerdict::Resampled:
      report.Warn(WarningCode::FramesEnlarged, TextOfResampling(found.variance.lines));
      return;
    case GainVerdict::FramesDiffer:
    case GainVerdict::IlluminationIsLeft:
    case GainVerdict::MotionIsLeft:
    case GainVerdict::NotAffine:
    case GainVerdict::GainDependsOnOffset:
    case GainVerdict::NotRising:
      report.Warn(WarningCode::VarianceNotAffine, TextOfFailure(found, tested));
      return;
  }
}

void
WarnOfNarrowRange(Report & report, const RefinedResults & found, double darkestFraction)
{
  const bool hasDark = found.settings.offset && found.settings.offset->variance;
  report.Warn(WarningCode::ResponseUnchecked,
              "the darkest areas have " + PercentApart(darkestFraction, InCommon.darkFraction) +
                " of the signal of the brightest (expected at most " + Percent(InCommon.darkFraction) +
                "), so that a non-linear response would not be noticed. " +
                (hasDark ? "Include dark and bright areas in the scene, or record several exposures (--exposures)"
                         : "Give dark frames (--dark), or include dark areas in the scene"));
}

} // namespace sensornoise
