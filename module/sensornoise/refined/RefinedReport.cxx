/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "sensornoise/refined/RefinedReport.h"

#include "sensornoise/base/ChiSquare.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/RollingShutter.h"
#include "sensornoise/base/Text.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/refined/GainEstimate.h"
#include "sensornoise/refined/MotionReport.h"
#include "sensornoise/refined/OffsetReport.h"
#include "sensornoise/report/Quantities.h"
#include "sensornoise/report/StackReport.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace sensornoise
{

namespace
{
/** Departure of the variance from its line above which the data are not those of a sensor [1]: local gains that differ
 * by 4 % make 0.03 to 0.1 of it, a gamma of 1.3 from 0.13 on. */
constexpr double LargestNonlinearity = 0.12;
/** Departure that is worth a warning [1]. Set by hand: a hundredth moves the gain by about half of it. */
constexpr double WorthTelling = 0.01;
/** Part of the usable pixels that a measurement needs [1]. Set by hand. */
constexpr double LeastUsedShare = 0.1;

void
WarnOfScene(Report & report, const RefinedResults & found)
{
  const auto total = static_cast<double>(found.scene.frame.geometry.Pixels());
  const auto percent = [total](std::size_t pixels) { return Text(100.0 * static_cast<double>(pixels) / total) + " %"; };
  if (found.series.local.series.cols() > 0)
  {
    const auto count = std::to_string(found.series.local.series.cols());
    if (found.polished.isOffsetDrift)
    {
      report.Warn("offset-drift", "a level common to all pixels drifts over the burst, as a black level does");
    }
    else
    {
      report.Warn("local-light",
                  "the light changes in some places in another way than in others (" + count +
                    " further series): a rolling shutter, several lamps or bleaching; gain and intercept allow for it");
    }
  }
  if (static_cast<double>(found.variance.notStatic) > 0.01 * total)
  {
    report.Warn("not-static",
                percent(found.variance.notStatic) +
                  " of the pixels lie where something moves or changes, and are left out");
  }
  if (static_cast<double>(found.scene.nearClip + found.scene.summary.clipped) > 0.01 * total)
  {
    report.Warn("near-clip-level",
                percent(found.scene.nearClip + found.scene.summary.clipped) +
                  " of the pixels reach a clip level or could have, and are left out");
  }
  if (found.variance.line.trimmedFraction > 2e-3)
  {
    report.Warn("noisy-pixels",
                Text(100.0 * found.variance.line.trimmedFraction) +
                  " % of the pixels are noisier or quieter than the sensor's noise explains, and are left out");
  }
}

/** Where the table's own limits do not exclude it. */
void
WarnOfMotion(Report & report, const RefinedResults & found)
{
  constexpr double strongPixels = 0.4;
  const auto       alongAxis = [](const Quantity & sd, double provisional) {
    return sd.interval95 && sd.interval95->high ? std::min(*sd.interval95->high, std::sqrt(provisional))
                                                      : std::sqrt(provisional);
  };
  const double vibration = std::max(alongAxis(report.vibrationSdX, found.scene.model.vibrationXPixels2),
                                    alongAxis(report.vibrationSdY, found.scene.model.vibrationYPixels2));
  if (vibration > strongPixels)
  {
    report.Warn("strong-vibration",
                "the scene moves by " + Text(vibration) +
                  " pixels rms: register the frames to whole pixels first; rough areas are left out");
  }
}

/** What the report says whatever was found. */
Report
DescribeInput(const RefinedSettings & settings, const StillScene & scene, const std::vector<std::uint8_t> & pixelUse)
{
  Report report;
  report.method = "refined";
  report.settings = { { "rolling_shutter", std::string(NameOf(settings.rollingShutter)) } };
  if (settings.levelRangeDn)
  {
    report.settings.emplace_back("level_range_low", settings.levelRangeDn->lowDn);
    report.settings.emplace_back("level_range_high", settings.levelRangeDn->highDn);
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
  DescribeStack(report, scene.frame.geometry, scene.frame.frames, scene.summary, scene.valid, pixelUse);
  WarnOfStack(report, scene.frame.frames, scene.summary);
  return report;
}

/** The noise of rounding to codes [DN^2]. */
double
QuantisationVariance(const StillScene & scene)
{
  const double step = scene.summary.codes.quantisationStepDn;
  return step * step / 12.0;
}

/** Files baselines and scatter, over the pixels used. */
void
FillCurves(Report & report, const RefinedResults & found)
{
  const std::vector<std::uint8_t> & pixelUse = found.variance.pixelUse;
  const std::vector<std::uint8_t>   used = MaskOfUsed(pixelUse);
  const StillScene &                scene = found.scene;
  FillBaselines(report, { scene.mean.data(), scene.variance.data(), used.data(), used.size() });
  FillScatter(report, scene.mean, scene.variance, found.correctedVariance, pixelUse);
}

/** Files the fit. */
void
FillFit(Report & report, const RefinedResults & found, const GainEstimate & gain)
{
  const VarianceLine & v = found.variance.line;
  report.fit.reducedChi2 = gain.reducedChi2;
  report.fit.curvature = v.curvature;
  report.fit.curvatureZ = v.curvatureSd > 0.0 ? v.curvature / v.curvatureSd : 0.0;
  report.fit.nonlinearity = gain.nonlinearity;
  report.fit.line = Report::Baseline{ 0.0, v.gain, v.intercept };
}

/** Why the variance is not that of a sensor; empty: it may be. */
std::string
FindContradiction(const RefinedResults & found, const GainEstimate & gain)
{
  const std::string advice = ": the data are not raw (gamma, compression), or not linear";
  const bool        hasCodes = found.scene.summary.codes.clipHighDn.has_value();
  if (gain.nonlinearity > LargestNonlinearity)
  {
    return "the variance departs from its line by " + Text(100.0 * gain.nonlinearity) +
           " % of itself (expected less than " + Text(100.0 * LargestNonlinearity) + " %)" + advice +
           (hasCodes ? "" : ", or they saturate: then give the levels that the sensor attains (clip)");
  }
  if (gain.IsBent() && gain.above + gain.below > 2.0 * LargestGainError * gain.line.gain)
  {
    return "the variance bends against the mean, and the gain depends on what is taken for read noise, between " +
           Text(gain.line.gain - gain.below) + " and " + Text(gain.line.gain + gain.above) + " DN/e-" + advice;
  }
  if (!(gain.line.gain > 0.0))
  {
    return "the variance does not rise with the mean (slope " + Text(gain.line.gain) + " +- " +
           Text(gain.StandardError()) + " DN/e-, expected above 0): the data are not raw, or hold too little noise";
  }
  return {};
}

/** The gain that cannot be told: every parameter of the sensor goes with it. */
void
FillTooLittle(Report & report, const RefinedResults & found, const GainEstimate & gain)
{
  SetSensorParameters(report, EstimateStatus::NotIdentifiable);
  const double error = gain.StandardError();
  if (static_cast<double>(report.pixels.used) < LeastUsedShare * found.scene.usable)
  {
    report.Warn("too-little-to-measure",
                Text(100.0 * static_cast<double>(report.pixels.used) / std::max(1.0, found.scene.usable)) +
                  " % of the pixels that are not clipped fit a static scene (expected at least " +
                  Text(100.0 * LeastUsedShare) + " %) and give a gain of " + Text(gain.line.gain) + " +- " +
                  Text(error) + " DN/e-: the scene is not static, or too dark; choose a static part of it");
    return;
  }
  const LevelPattern & pattern = found.variance.pattern;
  const double         levels = std::sqrt(std::max(0.0, pattern.lightDn2));
  report.Warn("intensity-range-too-small",
              "the scene has one intensity: its levels differ by " + Text(levels) + " DN rms, " +
                Text(100.0 * levels / std::max(1e-9, gain.line.pivotDn - found.blackDn)) +
                " % of the light, of which the pixels' own pattern may be " +
                Text(100.0 * std::min(1.0, pattern.LargestShare())) + " %, and tell the gain to +- " + Text(error) +
                " DN/e- only (about " + Text(gain.scale) +
                " expected): a scene with dark and bright areas would help, or dark frames");
}

/** Gain and intercept with their intervals, which hold the gains of all parts of the levels. */
void
FillGain(Report & report, const GainEstimate & gain, double quantisationDn2, double student)
{
  const double error = std::sqrt(gain.covariance(0, 0));
  report.gain = WithError(gain.line.gain, gain.StandardError(), "DN/e-", student);
  report.gain.interval95 =
    Interval{ gain.line.gain - gain.below - student * error, gain.line.gain + gain.above + student * error };
  // The value at the pivot is sure: the intercept moves against the gain.
  const double interceptError =
    std::hypot(std::sqrt(gain.covariance(1, 1)), 0.5 * (gain.below + gain.above) * gain.line.pivotDn);
  report.totalIntercept = WithError(gain.line.intercept, interceptError, "DN^2", student);
  report.intercept = WithError(gain.line.intercept - quantisationDn2, interceptError, "DN^2", student);
  if (gain.nonlinearity > WorthTelling && gain.IsBent())
  {
    report.Warn("response-not-straight",
                "the variance departs from its line by up to " + Text(100.0 * gain.nonlinearity) +
                  " % of itself: the sensor's response bends, and gain is between " +
                  Text(gain.line.gain - gain.below) + " and " + Text(gain.line.gain + gain.above) +
                  " DN/e- for parts of the levels; its interval holds them");
  }
}

/** Whether the levels reach down far enough to tell a bent response from a straight one. */
void
WarnOfNarrowRange(Report & report, const RefinedResults & found, const OffsetLimits & limits)
{
  const VarianceCurve & curve = found.variance.curve;
  const double          blackDn = report.offset.value.value_or(limits.rootDn);
  const bool            isDarkGiven = found.settings.offset && found.settings.offset->variance;
  const double          share = curve.DarkestShare(blackDn);
  if (!isDarkGiven && share > VarianceCurve::DarkEnough)
  {
    report.Warn("response-unchecked",
                "the darkest levels have " + Text(100.0 * share) + " % of the brightest's light (expected at most " +
                  Text(100.0 * VarianceCurve::DarkEnough) +
                  " %): a bent response could not be seen there; dark frames would tell");
  }
}
} // namespace

Report
MakeRefusal(const RefinedSettings &           settings,
            const StillScene &                scene,
            const std::vector<std::uint8_t> & pixelUse,
            const NothingToMeasure &          obstacle)
{
  Report report = DescribeInput(settings, scene, pixelUse);
  report.Warn(obstacle.GetCode(), obstacle.what());
  FillFromDarkFrames(report, settings, QuantisationVariance(scene));
  return report;
}

Report
MakeRefinedReport(const RefinedResults & found)
{
  Report report = DescribeInput(found.settings, found.scene, found.variance.pixelUse);
  FillCurves(report, found);
  WarnOfScene(report, found);

  const double         quantisationDn2 = QuantisationVariance(found.scene);
  const GainEstimate   gain = EstimateGain(found);
  const OffsetLimits   limits = LimitsOf(found, gain, quantisationDn2);
  const OffsetEstimate flicker = EstimateOffset(found, gain, limits);
  const UsedOffset     offset = OffsetInUse(found, flicker, limits);
  FillFlicker(report, found, offset.valueDn - found.scene.model.centreDn, offset.errorDn, gain.RelativeModelError());
  FillMotion(report, found);
  WarnOfMotion(report, found);
  FillFit(report, found, gain);
  const std::string contradiction = FindContradiction(found, gain);
  const double      samplingError = std::sqrt(gain.covariance(0, 0));
  const bool        isTooLittle = samplingError > LargestGainError * gain.scale ||
                           static_cast<double>(report.pixels.used) < LeastUsedShare * found.scene.usable;
  if (isTooLittle && !(gain.nonlinearity > LargestNonlinearity))
  {
    FillTooLittle(report, found, gain);
    FillFromDarkFrames(report, found.settings, quantisationDn2);
  }
  else if (!contradiction.empty())
  {
    SetSensorParameters(report, EstimateStatus::Failed);
    report.Warn("variance-not-affine", contradiction);
    FillFromDarkFrames(report, found.settings, quantisationDn2);
  }
  else
  {
    const double student = StudentQuantile(0.975, static_cast<double>(found.scene.frame.frames) - 2.0);
    FillGain(report, gain, quantisationDn2, student);
    FillOffsetAndReadNoise(report, found, gain, limits, flicker, quantisationDn2, student);
    WarnOfNarrowRange(report, found, limits);
  }
  return report;
}

} // namespace sensornoise
