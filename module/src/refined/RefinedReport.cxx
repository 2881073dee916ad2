// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedReport.h"

#include "base/ChiSquare.h"
#include "base/Eigen.h"
#include "sensornoise/Settings.h"
#include "base/Text.h"
#include "pixels/VarianceLine.h"
#include "correlation/CorrelationRecord.h"
#include "refined/Constants.h"
#include "refined/CorrelationReport.h"
#include "refined/GainEstimate.h"
#include "refined/GainReport.h"
#include "refined/MotionReport.h"
#include "refined/OffsetReport.h"
#include "refined/PixelsOfVariance.h"
#include "refined/SensorLines.h"
#include "report/Quantities.h"
#include "report/StackReport.h"
#include "report/StackSettings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace sensornoise
{

namespace
{
std::string
NameOfLine(LineAxis axis)
{
  return axis == LineAxis::Rows ? "row" : "column";
}

void
WarnOfScene(Report & report, const RefinedResults & found)
{
  const auto total = static_cast<double>(found.scene.frame.geometry.Pixels());
  const auto percent = [total](std::size_t pixels) { return Percent(static_cast<double>(pixels) / total); };
  if (found.lines.isTakenOff)
  {
    const double square = std::max(0.0, found.lines.found.value);
    report.Warn(WarningCode::LocalLight,
                "the illumination differs from " + NameOfLine(found.lines.axis) + " to " +
                  NameOfLine(found.lines.axis) + " within a frame by " + Percent(std::sqrt(square)) +
                  " rms: a pulsed lamp under a rolling shutter, or interlaced frames. Gain and intercept are from " +
                  percent(found.lines.pixels) + " of the pixels, without what each " + NameOfLine(found.lines.axis) +
                  " of a frame shares");
  }
  else if (found.series.local.series.cols() > 0)
  {
    const auto count = std::to_string(found.series.local.series.cols());
    if (found.reestimated.isOffsetDrift)
    {
      report.Warn(WarningCode::OffsetDrift,
                  "the dark offset of all pixels drifts over the burst. Let the camera warm up before the recording");
    }
    else
    {
      report.Warn(WarningCode::LocalLight,
                  "the illumination changes differently over the frame (" + count + " further temporal component" +
                    (count == "1" ? "" : "s") +
                    "): a rolling shutter, several lamps or bleaching, which gain and intercept allow for");
    }
  }
  if (found.lines.remainingVariance > 0.0)
  {
    report.Warn(WarningCode::LightSeriesLeft,
                "the illumination changes in more ways than " + std::to_string(found.scene.frame.frames) +
                  " frames allow to remove, also beside that of whole rows and columns: this adds about " +
                  Percent(found.lines.remainingVariance) + " to the variance, and the interval of the gain contains " +
                  Rounded(InRefined.slopeOfRemaining) +
                  " times as much. Record more frames, or choose an evenly lit part: --roi");
  }
  if (static_cast<double>(found.variance.notStatic) > InRefined.reportedFraction * total)
  {
    report.Warn(WarningCode::NotStatic,
                percent(found.variance.notStatic) +
                  " of the pixels lie where something moves or changes, and are left out");
  }
  if (static_cast<double>(found.scene.nearClip + found.scene.summary.clipped) > InRefined.reportedFraction * total)
  {
    report.Warn(WarningCode::NearClipLevel,
                percent(found.scene.nearClip + found.scene.summary.clipped) +
                  " of the pixels reach a clip level or could have, and are left out");
  }
  if (found.variance.line.trimmedFraction > InRefined.reportedTrimmed)
  {
    report.Warn(WarningCode::NoisyPixels,
                Percent(found.variance.line.trimmedFraction) +
                  " of the pixels are noisier or quieter than the sensor's noise explains, and are left out");
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
    report.Warn(
      WarningCode::BorderLeftOut,
      std::to_string(scene.border.Pixels(scene.frame.geometry)) + " pixels along the border, " +
        Percent(static_cast<double>(scene.border.Pixels(scene.frame.geometry)) /
                static_cast<double>(scene.frame.geometry.Pixels())) +
        " of the frame, have one level, end within a pixel, and are left out as no part of the scene: " + strips);
  }
}

/** Warns of a strong vibration unless its interval excludes it. */
void
WarnOfMotion(Report & report, const RefinedResults & found)
{
  const auto alongAxis = [](const Quantity & sd, double provisional) {
    return sd.interval95 && sd.interval95->high ? std::min(*sd.interval95->high, std::sqrt(provisional))
                                                : std::sqrt(provisional);
  };
  const double vibration = std::max(alongAxis(report.vibrationSdX, found.scene.model.vibrationXPixels2),
                                    alongAxis(report.vibrationSdY, found.scene.model.vibrationYPixels2));
  if (vibration > InRefined.strongVibration && !found.IsFlatUnderChange())
  {
    report.Warn(WarningCode::StrongVibration,
                "the scene may move by " + RoundedApart(vibration, InRefined.strongVibration) +
                  " pixels rms (expected at most " + Rounded(InRefined.strongVibration) +
                  "), so that rough areas are left out. Register the frames to whole pixels first");
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
  NoteCodes(report, settings.codes);
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
  FillBaselines(report, { frame.mean.data(), frame.variance.data(), used.data(), used.size() }, parallelFor);
  FillScatter(report, frame.mean, frame.variance, found.correctedVariance, used, parallelFor);
}

/** Returns Student's quantile of the 95 % intervals. */
double
StudentOf(const RefinedResults & found)
{
  return StudentQuantile(0.975, static_cast<double>(found.scene.frame.frames) - 2.0);
}

/** Returns the settings with the dark variance of the sensor before filters, without the noise of rows and columns.
 * Dark frames passed the same filter. */
RefinedSettings
SettingsOfSensor(const RefinedResults & found, double codesDn2)
{
  RefinedSettings settings = found.settings;
  if (settings.offset && settings.offset->variance)
  {
    DarkVariance & dark = *settings.offset->variance;
    const double   spread = StandardDeviationOfShapes(dark.valueDn2, found.correlation, codesDn2);
    dark.valueDn2 = VarianceOfSensor(dark.valueDn2, found.correlation, codesDn2);
    dark.standardErrorDn2 = std::hypot(FilterFactor(found.correlation) * dark.standardErrorDn2,
                                       FilterFactor(found.correlation) * found.correlation.LineNoise().standardError,
                                       spread);
    settings.offset->maps.reset();
    if (auto & median = settings.offset->readNoiseMedian; median && FilterFactor(found.correlation) == 1.0)
    {
      const double square = median->valueDn * median->valueDn - found.correlation.LineNoise().value;
      median->valueDn = std::sqrt(std::max(0.0, square));
    }
    else
    {
      median.reset(); // the median before a filter is not known
    }
  }
  return settings;
}

/** Files that there is no gain, because of the illumination that is specific to rows or columns. */
void
FailByLineIllumination(Report & report, const RefinedResults & found, double effect)
{
  SetSensorParameters(report, EstimateStatus::Failed);
  report.Warn(WarningCode::Contradicted,
              "the illumination differs from " + NameOfLine(found.lines.axis) + " to " + NameOfLine(found.lines.axis) +
                " within a frame by " + Percent(std::sqrt(found.lines.left.value)) + " rms, which adds " +
                PercentApart(effect, InRefined.largestLineIllumination) +
                " to the slope of the variance (expected at most " + Percent(InRefined.largestLineIllumination) +
                "): a pulsed lamp under a rolling shutter, or interlaced frames. Use a lamp on direct current, expose "
                "for whole periods of the lamp, or give one field of the frames");
}

/** Files gain, offset, read noise, flicker and motion. */
void
FillSensor(Report & report, const RefinedResults & found, const GainEstimate & gain, double codesDn2)
{
  const OffsetLimits   limits = LimitsOf(found, gain, codesDn2);
  const OffsetEstimate flicker = EstimateOffset(found, gain, limits);
  const UsedOffset     offset = ChooseOffset(found, gain, flicker, limits);
  const double         offsetFromCentre = offset.valueDn - found.scene.model.centreDn;
  FillFlicker(report, found, offsetFromCentre, offset.errorDn, gain.RelativeModelError());
  FillMotion(report, found, offsetFromCentre, offset.errorDn);
  WarnOfMotion(report, found);
  if (const double effect = EffectOfLineIllumination(found.lines.left,
                                                     found.scene.model.brightestDn - found.blackDn,
                                                     gain.line.gain,
                                                     InRefined.largestLineIllumination);
      effect > 0.0)
  {
    FailByLineIllumination(report, found, effect);
    FillFromDarkFrames(report, found.settings, codesDn2);
    return;
  }
  const bool isLinear = found.correlation.kind != NoiseKind::NotLinear;
  if (isLinear && FillGain(report, found, gain, codesDn2, StudentOf(found)))
  {
    FillOffsetAndReadNoise(report, found, gain, limits, flicker, codesDn2, StudentOf(found));
    WarnOfNarrowRange(report, found, gain, limits);
    return;
  }
  if (!isLinear)
  {
    SetSensorParameters(report, EstimateStatus::Failed);
  }
  FillFromDarkFrames(report, found.settings, codesDn2);
}

/** Replaces the gain, and the quantities that follow from it, by bounds of the gain, for frames that have fewer samples
 * than pixels. One bound is the slope of the variance, as for white noise; the other is the slope of the total
 * covariance. */
void
WithholdGain(Report & report)
{
  const std::optional<Interval> & all = report.gain.interval95;
  const std::optional<Interval> & white = report.varianceSlope.interval95;
  if (!all || !white)
  {
    return;
  }
  const auto lower = [](const Interval & a, const Interval & b) {
    return a.low && b.low ? std::optional(std::max(0.0, std::min(*a.low, *b.low))) : std::nullopt;
  };
  const auto higher = [](const Interval & a, const Interval & b) {
    return a.high && b.high ? std::optional(std::max(*a.high, *b.high)) : std::nullopt;
  };
  report.gain =
    Quantity::Without(EstimateStatus::NotIdentifiable, Interval{ lower(*all, *white), higher(*all, *white) });
  report.gainByParts.clear();
  report.covariance.reset();
  for (Quantity * const quantity :
       { &report.intercept, &report.readNoise, &report.readNoiseMedian, &report.readNoiseElectrons })
  {
    *quantity = Quantity::Without(EstimateStatus::NotIdentifiable);
  }
  const auto isOfReadNoise = [](const Warning & warning) { return warning.code == WarningCode::ReadNoiseUpperLimit; };
  report.warnings.erase(std::remove_if(report.warnings.begin(), report.warnings.end(), isOfReadNoise),
                        report.warnings.end());
}

/** Files the slope and intercept that a denoiser needs: the variance of a pixel as a function of its level, without
 * correction for filters. */
void
FillVariance(Report & report, const RefinedResults & found, const GainEstimate & ofVariance)
{
  Report own;
  own.pixels = report.pixels;
  FillGain(own, found, ofVariance, 0.0, StudentOf(found));
  report.varianceSlope = own.varianceSlope;
  report.totalIntercept = own.totalIntercept;
  if (!report.fit.line)
  {
    // The noise is not linear: the fit may have further warnings.
    report.fit = own.fit;
    if (!own.gain.value)
    {
      report.warnings.insert(report.warnings.end(), own.warnings.begin(), own.warnings.end());
    }
  }
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
  FillFromDarkFrames(report, settings, CodesVariance(scene));
  return report;
}

Report
MakeRefinedReport(const RefinedResults & found, const ParallelFor & parallelFor)
{
  Report report = DescribeInput(found.settings, found.scene, found.variance.pixelUse);
  FillCurves(report, found, parallelFor);
  WarnOfScene(report, found);

  const double       codesDn2 = found.variance.codeNoise.darkVarianceDn2;
  const GainEstimate ofVariance = EstimateGain(found);
  if (found.correlation.IsCorrelated() || found.correlation.LineNoise().value > 0.0)
  {
    const RefinedSettings settings = SettingsOfSensor(found, codesDn2);
    const SensorLines     lines = AddCovariances(LinesOf(found.variance), found.correlation, found.blackDn, codesDn2);
    const RefinedResults  sensor = { settings,       found.scene,       found.series,
                                     found.variance, found.reestimated, found.correctedVariance,
                                     found.blackDn,  found.correlation, found.frameNoise,
                                     found.lines,    found.exposures,   found.darkSignal };
    FillSensor(report, sensor, EstimateGain(sensor, lines), codesDn2);
  }
  else
  {
    FillSensor(report, found, ofVariance, codesDn2);
  }
  if (found.correlation.kind != NoiseKind::NotMeasured)
  {
    report.noiseCorrelation = RecordOf(found.correlation);
  }
  FillVariance(report, found, ofVariance);
  if (found.correlation.kind == NoiseKind::Enlarged)
  {
    WithholdGain(report);
  }
  WarnOfCorrelation(report, found.correlation);
  return report;
}

} // namespace sensornoise
