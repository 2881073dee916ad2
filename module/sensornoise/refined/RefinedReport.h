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
#ifndef sensornoise_refined_RefinedReport_h
#define sensornoise_refined_RefinedReport_h

#include "sensornoise/base/ChiSquare.h"
#include "sensornoise/base/RollingShutter.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/refined/MotionReport.h"
#include "sensornoise/refined/OffsetReport.h"
#include "sensornoise/refined/RefinedFindings.h"
#include "sensornoise/report/Quantities.h"
#include "sensornoise/report/Report.h"
#include "sensornoise/report/StackReport.h"
#include "sensornoise/scene/ProvisionalModel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

namespace detail
{
/** What is known of the bias of vibrations above 0.4 pixels, beyond which the expansion in derivatives fails: about
 * 0.15 % of the gain at 0.5 pixels, growing with the square (measured by measure-robustness); nothing below. */
inline Eigen::Matrix2d
StrongVibration(const VarianceLine & line, const ProvisionalModel & model)
{
  const double    square = std::max(model.vibrationXPixels2, model.vibrationYPixels2);
  const double    error = square > 0.16 ? 0.0015 * line.gain * square / 0.25 : 0.0;
  Eigen::Matrix2d added;
  added << 1.0, -line.centreDn, -line.centreDn, line.centreDn * line.centreDn;
  return error * error * added;
}

/** What the smoother half of the pixels says against all of them, as a covariance: 0 unless gain or value at the centre
 * differ by more than 2 standard deviations of the difference, which is that of a part against the whole (Hausman
 * 1978). Motion that is left in the rough half shows here. */
inline Eigen::Matrix2d
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

inline void
WarnOfScene(Report & report, const RefinedReportInput & input)
{
  const RefinedFindings & found = input.found;
  const auto              total = static_cast<double>(input.geometry.Pixels());
  const auto percent = [total](std::size_t pixels) { return Text(100.0 * static_cast<double>(pixels) / total) + " %"; };
  if (found.local.series.cols() > 0)
  {
    const auto count = std::to_string(found.local.series.cols());
    if (found.isOffsetDrift)
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
  if (static_cast<double>(found.notStatic) > 0.01 * total)
  {
    report.Warn("not-static",
                percent(found.notStatic) + " of the pixels lie where something moves or changes, and are left out");
  }
  const double vibration = std::max(found.model.vibrationXPixels2, found.model.vibrationYPixels2);
  if (vibration > 0.4 * 0.4)
  {
    report.Warn("strong-vibration",
                "the scene moves by " + Text(std::sqrt(vibration)) +
                  " pixels rms: register the frames to whole pixels first; rough areas are left out");
  }
  if (static_cast<double>(found.nearClip + input.summary.clipped) > 0.01 * total)
  {
    report.Warn("near-clip-level",
                percent(found.nearClip + input.summary.clipped) +
                  " of the pixels reach a clip level or could have, and are left out");
  }
  if (found.variance.trimmedFraction > 2e-3)
  {
    report.Warn("noisy-pixels",
                Text(100.0 * found.variance.trimmedFraction) +
                  " % of the pixels are noisier or quieter than the sensor's noise explains, and are left out");
  }
}
} // namespace detail

/** The report of the refined method. */
inline Report
MakeRefinedReport(const RefinedReportInput & input)
{
  const RefinedFindings & found = input.found;
  Report                  report;
  report.method = "refined";
  report.settings = { { "rolling_shutter", std::string(NameOf(input.settings.rollingShutter)) } };
  if (input.settings.offset)
  {
    report.settings.emplace_back("offset", input.settings.offset->valueDn);
    report.settings.emplace_back("offset_standard_error", input.settings.offset->standardErrorDn);
    report.settings.emplace_back("dark_frames", static_cast<double>(input.settings.offset->darkFrames));
    if (const auto & variance = input.settings.offset->variance)
    {
      report.settings.emplace_back("dark_variance", variance->valueDn2);
      report.settings.emplace_back("dark_variance_standard_error", variance->standardErrorDn2);
    }
  }
  DescribeStack(report, input.geometry, input.frames, input.summary, input.valid, input.pixelUse);
  WarnOfStack(report, input.frames, input.summary);
  if (!found.failure.empty())
  {
    report.Warn(found.failureCode, found.failure);
    return report;
  }
  std::vector<std::uint8_t> used(input.pixelUse.size());
  std::transform(input.pixelUse.begin(), input.pixelUse.end(), used.begin(), [](std::uint8_t use) {
    return use == static_cast<std::uint8_t>(PixelUse::Used) ? 1 : 0;
  });
  FillBaselines(report, { input.mean.data(), input.variance.data(), used.data(), used.size() });
  FillScatter(report, input.mean, input.variance, input.correctedVariance, input.pixelUse);
  detail::WarnOfScene(report, input);

  const VarianceLine &         v = found.variance;
  const detail::OffsetEstimate flicker = detail::EstimateOffset(input);
  const bool                   isTold = flicker.obstacle.empty();
  // An offset that is not told lies between the level of sigma = 0 and the darkest, about evenly.
  const double lowestDn = std::min(found.model.darkestDn, -v.intercept / v.gain);
  double       offsetDn = 0.5 * (lowestDn + found.model.darkestDn);
  double       offsetErrorDn = (found.model.darkestDn - lowestDn) / std::sqrt(12.0);
  if (input.settings.offset || isTold)
  {
    offsetDn = input.settings.offset ? input.settings.offset->valueDn : flicker.valueDn;
    offsetErrorDn = input.settings.offset ? input.settings.offset->standardErrorDn : flicker.standardErrorDn;
  }
  detail::FillFlickerAndMotion(report, input, offsetDn - found.centreDn, offsetErrorDn);
  // Chi-squares count where they are above what chance makes them, by 2 of their standard deviations.
  const auto beyondChance = [](double chi2, double freedom) {
    return chi2 > 1.0 + 2.0 * std::sqrt(2.0 / freedom) ? chi2 : 1.0;
  };
  const double dispersion = std::max(beyondChance(found.intensityChi2, 62.0),
                                     beyondChance(found.classes.reducedChi2, ProjectedVariance::Classes - 1.0));
  report.fit.reducedChi2 = found.intensityChi2;
  report.fit.curvature = v.curvature;
  report.fit.curvatureZ = v.curvatureSd > 0.0 ? v.curvature / v.curvatureSd : 0.0;
  double bend = 0.0;
  for (int i = 0; i <= 8; ++i)
  {
    const double level = found.model.darkestDn + (found.model.brightestDn - found.model.darkestDn) * i / 8.0;
    bend = std::max(bend, std::abs(v.BendAt(level)) / v.At(level));
  }
  if (!(v.gain > 0.0) || (std::abs(*report.fit.curvatureZ) > 5.0 && bend > 0.03))
  {
    SetSensorParameters(report, EstimateStatus::Failed);
    report.Warn("variance-not-affine",
                v.gain > 0.0
                  ? "the variance bends against the mean by " + Text(100.0 * bend) +
                      " % of itself (expected less than 3 %): the data are not raw (gamma, compression), or not linear"
                  : "the variance does not rise with the mean (slope " + Text(v.gain) +
                      " DN/e-, expected above 0): the data are not raw, or hold too little noise");
    return report;
  }
  const double          step = input.summary.codes.quantisationStepDn;
  const double          quantisationDn2 = step * step / 12.0;
  const Eigen::Matrix2d covariance = v.covariance * dispersion + detail::Disagreement(v, found.fromFlat) +
                                     found.tailDisagreement + detail::StrongVibration(v, found.model);
  const double student = StudentQuantile(0.975, static_cast<double>(input.frames) - 2.0);
  if (std::sqrt(covariance(0, 0)) > 0.25 * v.gain || static_cast<double>(report.pixels.used) < 0.1 * found.usable)
  {
    SetSensorParameters(report, EstimateStatus::NotIdentifiable);
    report.Warn(
      "too-little-to-measure",
      Text(100.0 * static_cast<double>(report.pixels.used) / std::max(1.0, found.usable)) +
        " % of the pixels that are not clipped fit a static scene (expected at least 10 %) and give a gain of " +
        Text(v.gain) + " +- " + Text(std::sqrt(covariance(0, 0))) +
        " DN/e-: the scene is not static, or too dark; choose a static part of it");
    return report;
  }
  report.gain = WithError(v.gain, std::sqrt(covariance(0, 0)), "DN/e-", student);
  report.totalIntercept = WithError(v.intercept, std::sqrt(covariance(1, 1)), "DN^2", student);
  report.intercept = WithError(v.intercept - quantisationDn2, std::sqrt(covariance(1, 1)), "DN^2", student);
  detail::FillOffsetAndReadNoise(report, input, covariance, quantisationDn2, student);
  return report;
}

} // namespace sensornoise

#endif
