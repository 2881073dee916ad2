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
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/VarianceLine.h"
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
/** What is known of the bias of vibrations above 0.4 pixels, beyond which the expansion in derivatives fails: about
 * 0.15 % of the gain at 0.5 pixels, growing with the square (measured by measure-robustness); nothing below. */
Eigen::Matrix2d
StrongVibration(const VarianceLine & line, const ProvisionalModel & model)
{
  const double    square = std::max(model.vibrationXPixels2, model.vibrationYPixels2);
  const double    error = square > 0.16 ? 0.0015 * line.gain * square / 0.25 : 0.0;
  Eigen::Matrix2d added;
  added << 1.0, -line.pivotDn, -line.pivotDn, line.pivotDn * line.pivotDn;
  return error * error * added;
}

/** What the smoother half of the pixels says against all of them, as a covariance: 0 unless gain or value at the centre
 * differ by more than 2 standard deviations of the difference, which is that of a part against the whole (Hausman
 * 1978). Motion that is left in the rough half shows here. */
Eigen::Matrix2d
Disagreement(const VarianceLine & all, const VarianceLine & flat)
{
  Eigen::Matrix2d added = Eigen::Matrix2d::Zero();
  if (flat.isDetermined)
  {
    const Eigen::Vector2d difference(flat.gain - all.gain, flat.intercept - all.intercept);
    const Eigen::Matrix2d expected = flat.covariance - all.covariance;
    for (int k = 0; k < 2; ++k)
    {
      const double square = difference(k) * difference(k);
      added(k, k) = square > 4.0 * expected(k, k) ? std::max(0.0, square - expected(k, k)) : 0.0;
    }
    added(0, 1) = added(1, 0) = std::copysign(std::sqrt(added(0, 0) * added(1, 1)), difference(0) * difference(1));
  }
  return added;
}

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
  const double vibration = std::max(found.scene.model.vibrationXPixels2, found.scene.model.vibrationYPixels2);
  if (vibration > 0.4 * 0.4)
  {
    report.Warn("strong-vibration",
                "the scene moves by " + Text(std::sqrt(vibration)) +
                  " pixels rms: register the frames to whole pixels first; rough areas are left out");
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

/** What the report says whatever was found. */
Report
DescribeInput(const RefinedSettings & settings, const StillScene & scene, const std::vector<std::uint8_t> & pixelUse)
{
  Report report;
  report.method = "refined";
  report.settings = { { "rolling_shutter", std::string(NameOf(settings.rollingShutter)) } };
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

/** The offset that the flicker is taken about. */
struct UsedOffset
{
  double valueDn;
  double errorDn;
};

UsedOffset
OffsetInUse(const RefinedResults & found, const OffsetEstimate & flicker)
{
  if (const auto & known = found.settings.offset)
  {
    return { known->valueDn, known->standardErrorDn };
  }
  if (flicker.obstacle.empty())
  {
    return { flicker.valueDn, flicker.standardErrorDn };
  }
  // An offset that is not told lies between the level of sigma = 0 and the darkest, about evenly.
  const double darkestDn = found.scene.model.darkestDn;
  const double lowestDn = std::min(darkestDn, -found.variance.line.intercept / found.variance.line.gain);
  return { 0.5 * (lowestDn + darkestDn), (darkestDn - lowestDn) / std::sqrt(12.0) };
}

/** How far the parabola in the line's place departs from it over the scene's levels, relative to the line. */
double
LargestBend(const VarianceLine & line, const ProvisionalModel & model)
{
  double bend = 0.0;
  for (int i = 0; i <= 8; ++i)
  {
    const double level = model.darkestDn + (model.brightestDn - model.darkestDn) * i / 8.0;
    bend = std::max(bend, std::abs(line.BendAt(level)) / line.At(level));
  }
  return bend;
}

/** Files the fit. Returns false, with every parameter failed, if the variance is no rising line. */
bool
FillFit(Report & report, const RefinedResults & found)
{
  const VarianceLine & v = found.variance.line;
  report.fit.reducedChi2 = found.variance.intensityChi2;
  report.fit.curvature = v.curvature;
  report.fit.curvatureZ = v.curvatureSd > 0.0 ? v.curvature / v.curvatureSd : 0.0;
  const double bend = LargestBend(v, found.scene.model);
  if (!(v.gain > 0.0) || (std::abs(*report.fit.curvatureZ) > 5.0 && bend > 0.03))
  {
    SetSensorParameters(report, EstimateStatus::Failed);
    report.Warn("variance-not-affine",
                v.gain > 0.0
                  ? "the variance bends against the mean by " + Text(100.0 * bend) +
                      " % of itself (expected less than 3 %): the data are not raw (gamma, compression), or not linear"
                  : "the variance does not rise with the mean (slope " + Text(v.gain) +
                      " DN/e-, expected above 0): the data are not raw, or hold too little noise");
    return false;
  }
  return true;
}

/** Covariance of gain and intercept: the fit's, widened by all that contradicts it. */
Eigen::Matrix2d
CovarianceOf(const RefinedResults & found)
{
  // Chi-squares count where they are above what chance makes them, by 2 of their standard deviations.
  const auto beyondChance = [](double chi2, double freedom) {
    return chi2 > 1.0 + 2.0 * std::sqrt(2.0 / freedom) ? chi2 : 1.0;
  };
  const StaticVariance & variance = found.variance;
  const double           dispersion = std::max(beyondChance(variance.intensityChi2, 62.0),
                                     beyondChance(variance.classes.reducedChi2, ProjectedVariance::Classes - 1.0));
  return variance.line.covariance * dispersion + Disagreement(variance.line, variance.fromFlat) +
         variance.tailDisagreement + StrongVibration(variance.line, found.scene.model);
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
  return report;
}

Report
MakeRefinedReport(const RefinedResults & found)
{
  const VarianceLine & v = found.variance.line;
  Report               report = DescribeInput(found.settings, found.scene, found.variance.pixelUse);
  FillCurves(report, found);
  WarnOfScene(report, found);

  const OffsetEstimate flicker = EstimateOffset(found);
  const UsedOffset     offset = OffsetInUse(found, flicker);
  FillFlicker(report, found, offset.valueDn - found.scene.model.centreDn, offset.errorDn);
  FillMotion(report, found);
  if (!FillFit(report, found))
  {
    return report;
  }
  const Eigen::Matrix2d covariance = CovarianceOf(found);
  if (std::sqrt(covariance(0, 0)) > 0.25 * v.gain || static_cast<double>(report.pixels.used) < 0.1 * found.scene.usable)
  {
    SetSensorParameters(report, EstimateStatus::NotIdentifiable);
    report.Warn(
      "too-little-to-measure",
      Text(100.0 * static_cast<double>(report.pixels.used) / std::max(1.0, found.scene.usable)) +
        " % of the pixels that are not clipped fit a static scene (expected at least 10 %) and give a gain of " +
        Text(v.gain) + " +- " + Text(std::sqrt(covariance(0, 0))) +
        " DN/e-: the scene is not static, or too dark; choose a static part of it");
    return report;
  }
  const double step = found.scene.summary.codes.quantisationStepDn;
  const double quantisationDn2 = step * step / 12.0;
  const double student = StudentQuantile(0.975, static_cast<double>(found.scene.frame.frames) - 2.0);
  report.gain = WithError(v.gain, std::sqrt(covariance(0, 0)), "DN/e-", student);
  report.totalIntercept = WithError(v.intercept, std::sqrt(covariance(1, 1)), "DN^2", student);
  report.intercept = WithError(v.intercept - quantisationDn2, std::sqrt(covariance(1, 1)), "DN^2", student);
  FillOffsetAndReadNoise(report, found, flicker, covariance, quantisationDn2, student);
  return report;
}

} // namespace sensornoise
