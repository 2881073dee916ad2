// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedEstimate.h"

#include "sensornoise/Settings.h"
#include "base/Constants.h"
#include "base/Quantiles.h"
#include "base/Text.h"
#include "correlation/NoiseCorrelation.h"
#include "pixels/VarianceLine.h"
#include "refined/Constants.h"
#include "refined/RefinedResults.h"
#include "report/StackReport.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns "80 to 120 DN": the range of nine tenths of the levels at the pixels of one use. */
std::string
RangeOfLevels(const RefinedResults & found, PixelUse use)
{
  std::vector<double> levels;
  for (std::size_t p = 0; p < found.variance.pixelUse.size(); ++p)
  {
    if (found.variance.pixelUse[p] == static_cast<std::uint8_t>(use))
    {
      levels.push_back(found.scene.frame.mean[p]);
    }
  }
  return levels.empty() ? "no level"
                        : Rounded(Quantile(levels, 0.05)) + " to " + Rounded(Quantile(levels, 0.95)) + " DN";
}

/** Warns of illumination that differs within a frame, and of its part that is not removed. */
void
WarnOfIllumination(Report & report, const RefinedResults & found)
{
  if (found.lines.isSubtracted)
  {
    const double square = std::max(0.0, found.lines.found.value);
    report.Warn(
      WarningCode::LocalLight,
      "the illumination differs from " + found.lines.NameOfLine() + " to " + found.lines.NameOfLine() +
        " within a frame by " + Percent(std::sqrt(square)) +
        " rms: pulsed illumination under a rolling shutter, or interlaced frames. Gain and intercept are from " +
        Percent(static_cast<double>(found.lines.pixels) / static_cast<double>(found.scene.frame.geometry.Pixels())) +
        " of the pixels, without the noise common to each " + found.lines.NameOfLine() +
        ", and their errors are larger. Use illumination without pulses if they are too large");
  }
  else if (found.series.local.IsLocal())
  {
    if (found.reestimated.isOffsetDrift)
    {
      report.Warn(
        WarningCode::OffsetDrift,
        "the dark offset of all pixels drifts over the burst, which gain and intercept allow for, at larger errors. "
        "Let the camera warm up before the recording");
    }
    else if (found.IsMotionLocal())
    {
      report.Warn(
        WarningCode::LocalLight,
        "parts of the scene move by themselves, or the illumination changes differently over the frame, which "
        "gain and intercept allow for, at larger errors. Record a scene that is still, or choose a part of "
        "it (--roi)");
    }
    else
    {
      const auto        count = found.series.local.series.cols();
      const std::string how = count == 0
                                ? "its flicker differs by " + Percent(found.series.local.unevenness.size) + " rms"
                                : std::to_string(count) + " further temporal component" + (count == 1 ? "" : "s");
      report.Warn(
        WarningCode::LocalLight,
        "the illumination changes differently over the frame (" + how +
          "): a rolling shutter, several light sources or bleaching, which gain and intercept allow for, at larger "
          "errors. Use one light source without pulses if they are too large");
    }
  }
  if (found.lines.remainingVariance > 0.0)
  {
    report.Warn(WarningCode::LightSeriesLeft,
                "the illumination changes in more ways than " + std::to_string(found.scene.frame.frames) +
                  " frames allow to remove, even without the illumination of whole rows and columns: this adds about " +
                  Percent(found.lines.remainingVariance) + " to the variance, and the interval of the gain contains " +
                  Rounded(InRefined.slopeOfRemaining) +
                  " times as much. Record more frames, or choose an evenly lit part: --roi");
  }
}

void
WarnOfScene(Report & report, const RefinedResults & found)
{
  WarnOfIllumination(report, found);
  const auto total = static_cast<double>(found.scene.frame.geometry.Pixels());
  const auto percent = [total](std::size_t pixels) { return Percent(static_cast<double>(pixels) / total); };
  if (static_cast<double>(found.variance.notStatic) > InRefined.reportedFraction * total)
  {
    report.Warn(
      WarningCode::NotStatic,
      percent(found.variance.notStatic) +
        " of the pixels lie where something moves or changes, and are left out, because the change adds to their "
        "variance. Nine tenths of them have " +
        RangeOfLevels(found, PixelUse::NotStatic) + "; of the pixels used, " + RangeOfLevels(found, PixelUse::Used) +
        ". Look at the map of pixel use (--maps) to see where they are");
  }
  const std::optional<FullWells> & wells = found.scene.fullWells;
  const std::size_t                clipped = found.scene.nearClip + found.scene.summary.clipped;
  if (static_cast<double>(clipped) > InRefined.reportedFraction * total)
  {
    report.Warn(WarningCode::NearClipLevel,
                percent(clipped) +
                  " of the pixels reach a clip level, or could reach it by noise and flicker. They are left out, "
                  "because clipping reduces their variance" +
                  (wells ? ". The noise vanishes at " + Rounded(wells->levelDn) +
                             " DN: there the full wells of the pixels end, which differ by " +
                             Percent(wells->spreadDn / wells->levelDn) + " rms"
                         : "") +
                  ". Change the exposure to keep them");
  }
  std::string unlike;
  if (found.variance.line.trimmedFraction > InRefined.reportedTrimmed)
  {
    unlike = Percent(found.variance.line.trimmedFraction) +
             " of the pixels are noisier or quieter than the sensor's noise explains";
  }
  if (found.variance.interpolatedFraction > InRefined.reportedTrimmed)
  {
    unlike += (unlike.empty() ? "" : ", and ") + Percent(found.variance.interpolatedFraction) +
              " of the pixels are copies or means of their neighbours, as where a camera corrects defective pixels";
  }
  if (!unlike.empty())
  {
    report.Warn(WarningCode::NoisyPixels,
                unlike +
                  ". They are left out, because their variance is not the variance of a typical pixel. Look at the map "
                  "of pixel use (--maps) to see where they are");
  }
}

/** Warns of the strips along the borders that were left out. */
void
WarnOfBorder(Report & report, const StaticScene & scene)
{
  std::string strips;
  for (const MaskedStrip & strip : scene.border.strips)
  {
    strips += (strips.empty() ? "the " : "; the ") + std::to_string(strip.lines) + " " + strip.words + " (" +
              Rounded(strip.levelDn) + " DN, the line beside " + Rounded(strip.besideDn) + " DN)";
  }
  if (!strips.empty())
  {
    report.Warn(WarningCode::BorderLeftOut,
                std::to_string(scene.border.Pixels(scene.frame.geometry)) + " pixels along the border, " +
                  Percent(static_cast<double>(scene.border.Pixels(scene.frame.geometry)) /
                          static_cast<double>(scene.frame.geometry.Pixels())) +
                  " of the frame, do not show the scene, which begins within a pixel, and are left out: " + strips +
                  ". Use the results as they are, or choose the lit area: --roi");
  }
}

/** Makes a report with the settings and the description of the stack, which do not depend on the results. */
Report
DescribeInput(const RefinedSettings & settings, const StaticScene & scene, const std::vector<std::uint8_t> & pixelUse)
{
  Report report;
  report.method = "refined";
  report.settings = { { "rolling_shutter", std::string(NameOf(settings.rollingShutter)) } };
  if (settings.levelRangeDn)
  {
    report.settings.emplace_back("level_range_low", settings.levelRangeDn->lowDn);
    report.settings.emplace_back("level_range_high", settings.levelRangeDn->highDn);
  }
  if (!settings.exposures.empty())
  {
    report.settings.emplace_back("exposures", settings.exposures);
  }
  if (settings.offset)
  {
    report.settings.emplace_back("offset", settings.offset->valueDn);
    report.settings.emplace_back("offset_standard_error", settings.offset->standardErrorDn);
    report.settings.emplace_back("dark_frames", static_cast<double>(settings.offset->darkFrames));
    if (const auto & variance = settings.offset->variance)
    {
      report.settings.emplace_back("dark_variance", variance->valueDn2);
      report.settings.emplace_back("dark_variance_standard_error", variance->standardErrorDn2);
    }
  }
  NoteDnSettings(report, settings.dnSettings);
  DescribeStack(report, scene.frame.geometry, scene.frame.frames, scene.summary, scene.valid, pixelUse);
  WarnOfStack(report, scene.frame.frames, scene.summary);
  WarnOfBorder(report, scene);
  return report;
}

/** Files baselines and scatter, over the pixels used. */
void
FillCurves(Report & report, const RefinedResults & found, const ParallelFor & parallelFor)
{
  const std::vector<std::uint8_t> used = MaskOfUsed(found.variance.pixelUse);
  const ReferenceFrame &          frame = found.scene.frame;
  const std::vector<double> &     variance = frame.variance.GetDoubles();
  FillBaselines(report, { frame.mean.data(), variance.data(), used.data(), used.size() }, parallelFor);
  FillScatter(report, frame.mean, variance, found.correctedVariance, used, parallelFor);
}

void
CopyDark(Report & report, const DarkQuantities & dark)
{
  report.offset = dark.offset;
  report.readNoise = dark.readNoise;
  report.readNoiseMedian = dark.readNoiseMedian;
  report.readNoiseElectrons = dark.readNoiseElectrons;
  report.covariance = dark.covariance;
}

Report::Fit
FitOf(const RefinedResults & found, const GainEstimate & gain)
{
  const VarianceLine & v = gain.isFromFrames ? gain.line : found.variance.line;
  Report::Fit          fit;
  fit.reducedChi2 = gain.reducedChi2;
  fit.curvature = v.curvature;
  fit.curvatureZ = v.curvatureSd > 0.0 ? v.curvature / v.curvatureSd : 0.0;
  fit.nonlinearity = gain.nonlinearity;
  fit.line = Report::Baseline{ 0.0, v.gain, v.intercept };
  return fit;
}

/** Copies the quantities of the estimate and the fits. */
void
CopyQuantities(Report & report, const RefinedResults & found, const RefinedEstimate & estimate)
{
  CopyDark(report, estimate.dark);
  report.gain = estimate.ofSensor.gain;
  report.intercept = estimate.ofSensor.intercept;
  report.varianceSlope = estimate.ofFrames.varianceSlope;
  report.totalIntercept = estimate.ofFrames.totalIntercept;
  report.flicker = estimate.flicker.gamma;
  report.flickerSd = estimate.flicker.sd;
  report.vibrationSdX = estimate.motion.sdX;
  report.vibrationSdY = estimate.motion.sdY;
  report.vibrationCovariance = estimate.motion.covariance;
  report.motion = estimate.motion.shifts;
  report.fit = FitOf(found, (estimate.IsSensorLineTested() ? estimate.ofSensor : estimate.ofFrames).line);
  if (estimate.ofSensor.IsIdentified())
  {
    report.fit.offsetLinePhi = estimate.flickerOffset.phi;
  }
  if (!estimate.isWithheld)
  {
    for (const UnlikeParts & parts : estimate.ofSensor.parts)
    {
      report.gainByParts.push_back(parts.record);
    }
  }
}

/** Adds the warnings of the estimate, in the order of the passes. */
void
WarnOfEstimate(Report & report, const RefinedResults & found, const RefinedEstimate & estimate)
{
  WarnOfFlicker(report, estimate.flicker);
  if (estimate.strongVibrationPixels)
  {
    report.Warn(WarningCode::StrongVibration,
                "the scene may move by " + RoundedApart(*estimate.strongVibrationPixels, InRefined.strongVibration) +
                  " pixels rms (expected at most " + Rounded(InRefined.strongVibration) +
                  "), so that rough areas are left out. Choose a smooth part of the scene (--roi), or keep camera and "
                  "scene still");
  }
  if (estimate.motion.deviationOfBlocks > InCommon.largestRelativeError)
  {
    report.Warn(
      WarningCode::MotionNotUniform,
      "the shifts of blocks of the frame deviate from the common shifts by " +
        PercentApart(estimate.motion.deviationOfBlocks, InCommon.largestRelativeError) + " rms (expected at most " +
        Percent(InCommon.largestRelativeError) +
        "): a part of the frame does not move with the scene, or changes of the illumination resemble motion. "
        "Gain and intercept allow for both. Choose a part of the frame that moves as a whole (--roi)");
  }
  WarnOfGain(report, found, estimate.ofSensor, estimate.effectOfLines);
  if (estimate.ofSensor.IsIdentified())
  {
    WarnOfOffset(report, found, estimate);
  }
  if (estimate.uncheckedFraction)
  {
    WarnOfNarrowRange(report, found, *estimate.uncheckedFraction);
  }
  if (!estimate.IsSensorLineTested() && !estimate.ofFrames.IsIdentified())
  {
    WarnOfGain(report, found, estimate.ofFrames, 0.0);
  }
  WarnOfCorrelation(report, found.correlation);
}
} // namespace

Report
MakeFailedReport(const RefinedSettings &           settings,
                 const StaticScene &               scene,
                 const std::vector<std::uint8_t> & pixelUse,
                 const NothingToMeasure &          failureReason)
{
  Report report = DescribeInput(settings, scene, pixelUse);
  report.Warn(failureReason.GetCode(), failureReason.what());
  CopyDark(
    report,
    QuantitiesOfDarkFrames(WithoutStructuredNoise(settings), QuantisationVariance(scene), EstimateStatus::Failed));
  return report;
}

Report
MakeRefinedReport(const RefinedResults & found, const ParallelFor & parallelFor)
{
  const RefinedEstimate estimate = EstimateRefined(found);
  Report                report = DescribeInput(found.settings, found.scene, found.variance.pixelUse);
  FillCurves(report, found, parallelFor);
  WarnOfScene(report, found);
  CopyQuantities(report, found, estimate);
  if (found.correlation.kind != NoiseKind::NotMeasured)
  {
    report.noiseCorrelation = RecordOf(found.correlation);
  }
  WarnOfEstimate(report, found, estimate);
  return report;
}

} // namespace sensornoise
