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
#ifndef SensorNoiseRefinedReport_h
#define SensorNoiseRefinedReport_h

#include "SensorNoiseNoiseParameters.h"
#include "SensorNoiseRefinedFindings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** What the refined method's report is made of. */
struct RefinedReportInput
{
  const RefinedSettings &           settings;
  const FrameGeometry &             geometry;
  std::size_t                       frames;
  const StackSummary &              summary;
  const std::vector<double> &       mean;
  const std::vector<double> &       variance;
  const std::vector<double> &       correctedVariance;
  const std::vector<std::uint8_t> & valid;
  const std::vector<std::uint8_t> & pixelUse;
  const RefinedFindings &           found;
};

namespace detail
{
/** A value with its standard error and 95 % interval. */
inline Quantity
WithError(double value, double standardError, std::string unit, double student = 1.96)
{
  Quantity quantity = Quantity::Identified(value, std::move(unit));
  quantity.standardError = standardError;
  quantity.interval95 = Interval{ value - student * standardError, value + student * standardError };
  return quantity;
}

/** What is not distinguishable from 0: no value, and an interval up to \a high. */
inline Quantity
UpperLimit(double high, std::string unit)
{
  Quantity quantity = Quantity::Without(EstimateStatus::UpperLimit, std::move(unit));
  quantity.interval95 = Interval{ 0.0, high };
  quantity.bracket = quantity.interval95;
  return quantity;
}

/** A root of a squared quantity: its interval is the root of the square's, cut at 0; an interval that holds 0 gives an
 * upper limit and no value, and noise that carried the square below 0 does not lower it. */
inline Quantity
RootOf(double square, double standardError, std::string unit, double student = 1.96)
{
  const double high = std::sqrt(std::max(0.0, square) + student * standardError);
  if (!(square - student * standardError > 0.0))
  {
    return UpperLimit(high, std::move(unit));
  }
  const double value = std::sqrt(square);
  Quantity     quantity = WithError(value, standardError / (2.0 * value), std::move(unit));
  quantity.interval95 = Interval{ std::sqrt(square - student * standardError), high };
  return quantity;
}

/** The offset as the flicker tells it. */
struct OffsetEstimate
{
  double      valueDn{ 0.0 };
  double      standardErrorDn{ 0.0 };
  Interval    interval;
  double      phi{ 1.0 };
  std::string obstacle; ///< why it cannot be told; empty: it can
};

inline OffsetEstimate
EstimateOffset(const RefinedReportInput & input)
{
  const RefinedFindings & found = input.found;
  const double            rangeDn = found.model.brightestDn - found.model.darkestDn;
  OffsetEstimate          estimate;
  double                  low = found.line.low;
  double                  high = found.line.high;
  estimate.valueDn = found.line.offset + found.centreDn;
  estimate.standardErrorDn = found.line.standardError;
  estimate.phi = found.line.phi;
  const bool isLocal = found.local.series.cols() > 0 && !found.isOffsetDrift;
  if (isLocal && found.localOffset)
  {
    estimate.valueDn = found.localOffset->offset + found.centreDn;
    estimate.standardErrorDn = found.localOffset->standardError;
    estimate.phi = found.localOffset->phi;
    low = found.localOffset->low;
    high = found.localOffset->high;
  }
  estimate.interval = Interval{ low + found.centreDn, high + found.centreDn };

  const VarianceLine & v = found.variance;
  const double         slackDn =
    3.0 * estimate.standardErrorDn + 4.0 * std::sqrt(v.At(found.model.darkestDn) / static_cast<double>(input.frames));
  const double slackBelowDn = slackDn + 4.0 * std::sqrt(v.covariance(1, 1)) / v.gain;
  if (!(found.line.flickerZ > RequiredFlickerZ) && !isLocal)
  {
    estimate.obstacle = "the flicker exceeds its own noise by " + Text(found.line.flickerZ) +
                        " standard deviations (expected more than 6)";
  }
  else if (isLocal && !found.localOffset)
  {
    estimate.obstacle = "the light changes differently over the frame, and no part of it tells the offset";
  }
  else if (!std::isfinite(low) || !std::isfinite(high) || high - low > 0.25 * rangeDn)
  {
    estimate.obstacle = "its interval, " + Text(low + found.centreDn) + " to " + Text(high + found.centreDn) +
                        " DN, is wider than a quarter of the range of the scene, " + Text(rangeDn) + " DN";
  }
  else if (estimate.valueDn < -v.intercept / v.gain - slackBelowDn ||
           estimate.valueDn > found.model.darkestDn + slackDn)
  {
    estimate.obstacle = "the flicker's zero, " + Text(estimate.valueDn) +
                        " DN, contradicts sigma^2 >= 0 or the darkest level: parts of the light flicker differently";
  }
  else if (isLocal && found.localOffset->phi > 4.0)
  {
    estimate.obstacle = "the responses to the lamps do not meet in one zero (dispersion " +
                        Text(found.localOffset->phi) + ", expected 1)";
  }
  return estimate;
}

/** The read noise as dark frames tell it; \a lineDn2 is the variance at the offset of the line through the others. */
inline void
FillDarkReadNoise(Report &             report,
                  const DarkVariance & dark,
                  double               quantisationDn2,
                  double               lineDn2,
                  double               lineErrorDn2)
{
  const double gain = *report.gain.value;
  const double square = dark.valueDn2 - quantisationDn2;
  const double error = dark.standardErrorDn2;
  const double halfStepDn2 = 3.0 * quantisationDn2; // below it the codes hide the noise
  if (square < halfStepDn2)
  {
    report.readNoise = UpperLimit(std::sqrt(halfStepDn2), "DN");
    report.readNoiseElectrons = UpperLimit(std::sqrt(halfStepDn2) / gain, "e-");
    return;
  }
  const double gainError = 2.0 * square / gain * *report.gain.standardError;
  report.readNoise = RootOf(square, error, "DN");
  report.readNoiseElectrons = RootOf(square / (gain * gain), std::hypot(error, gainError) / (gain * gain), "e-");
  if (std::abs(square - lineDn2) > 4.0 * std::hypot(error, lineErrorDn2))
  {
    report.Warn("dark-frames-differ",
                "at the offset the noise is " + Text(lineDn2) + " +- " + Text(lineErrorDn2) +
                  " DN^2, but the dark frames have " + Text(square) + " +- " + Text(error) +
                  " DN^2: another exposure, gain or temperature");
  }
}

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
FillOffsetAndReadNoise(Report &                   report,
                       const RefinedReportInput & input,
                       const Eigen::Matrix2d &    covariance,
                       double                     quantisationDn2,
                       double                     student)
{
  const RefinedFindings & found = input.found;
  const VarianceLine &    v = found.variance;
  const OffsetEstimate    flicker = EstimateOffset(input);
  report.fit.offsetLinePhi = flicker.phi;

  const double          lowestOffsetDn = -v.intercept / v.gain;
  const double          darkestDn = std::max(lowestOffsetDn, found.model.darkestDn);
  const double          largestNoiseDn2 = std::max(0.0, v.intercept + v.gain * darkestDn - quantisationDn2);
  std::optional<double> offsetDn;
  double                offsetErrorDn = 0.0;
  if (input.settings.offset)
  {
    offsetDn = input.settings.offset->valueDn;
    offsetErrorDn = input.settings.offset->standardErrorDn;
    report.offset = WithError(*offsetDn, offsetErrorDn, "DN");
    const double difference = flicker.valueDn - *offsetDn;
    const double error = std::hypot(flicker.standardErrorDn, offsetErrorDn);
    if (flicker.obstacle.empty() && std::abs(difference) > 3.0 * error)
    {
      report.Warn("steady-light",
                  "the level that does not flicker is " + Text(flicker.valueDn) + " +- " +
                    Text(flicker.standardErrorDn) + " DN, " + Text(difference) + " DN from the given offset: " +
                    (difference > 0.0 ? "light that does not flicker, or dark current, makes the difference"
                                      : "that is too high for these frames"));
    }
    const double slackDn = 3.0 * offsetErrorDn + 4.0 * std::sqrt(covariance(1, 1)) / v.gain;
    const double rangeDn = found.model.brightestDn - found.model.darkestDn;
    if (*offsetDn < lowestOffsetDn - slackDn || *offsetDn > darkestDn + slackDn + 0.01 * rangeDn)
    {
      report.Warn("offset-out-of-range",
                  "the given offset, " + Text(*offsetDn) + " DN, is not between " + Text(lowestOffsetDn) + " and " +
                    Text(darkestDn) + " DN, where sigma^2 >= 0 and the darkest pixels put it");
    }
  }
  else if (flicker.obstacle.empty())
  {
    offsetDn = flicker.valueDn;
    offsetErrorDn = flicker.standardErrorDn;
    report.offset = WithError(*offsetDn, offsetErrorDn, "DN");
    report.offset.interval95 = flicker.interval;
  }
  else
  {
    report.Warn("offset-not-identifiable",
                flicker.obstacle + ": more flicker or more frames would help, or dark frames, or a known offset");
  }
  if (darkestDn > lowestOffsetDn)
  {
    report.offset.bracket = Interval{ lowestOffsetDn, darkestDn };
  }
  if (!offsetDn)
  {
    const auto bracket = report.offset.bracket;
    report.offset = Quantity::Without(EstimateStatus::NotIdentifiable, "DN");
    report.offset.bracket = bracket;
    report.readNoise = Quantity::Without(EstimateStatus::NotIdentifiable, "DN");
    report.readNoise.bracket = Interval{ 0.0, std::sqrt(largestNoiseDn2) };
    report.readNoiseElectrons = Quantity::Without(EstimateStatus::NotIdentifiable, "e-");
    report.readNoiseElectrons.bracket = Interval{ 0.0, std::sqrt(largestNoiseDn2) / v.gain };
    return;
  }
  const double square = v.intercept + v.gain * *offsetDn - quantisationDn2;
  const double error = std::sqrt(covariance(1, 1) + *offsetDn * *offsetDn * covariance(0, 0) +
                                 2.0 * *offsetDn * covariance(0, 1) + v.gain * v.gain * offsetErrorDn * offsetErrorDn);
  report.readNoise = RootOf(square, error, "DN", student);
  report.readNoiseElectrons = RootOf(square / (v.gain * v.gain), error / (v.gain * v.gain), "e-", student);
  if (square + 4.0 * error < 0.0)
  {
    report.readNoise = Quantity::Without(EstimateStatus::Failed, "DN");
    report.readNoiseElectrons = Quantity::Without(EstimateStatus::Failed, "e-");
  }
  if (input.settings.offset && input.settings.offset->variance)
  {
    FillDarkReadNoise(report, *input.settings.offset->variance, quantisationDn2, square, error);
  }
  report.covariance = std::array<std::array<double, 3>, 3>{ { { covariance(0, 0), covariance(0, 1), 0.0 },
                                                              { covariance(0, 1), covariance(1, 1), 0.0 },
                                                              { 0.0, 0.0, offsetErrorDn * offsetErrorDn } } };
  if (report.readNoise.status == EstimateStatus::UpperLimit)
  {
    report.Warn("read-noise-upper-limit",
                "the read noise is below " + Text(*report.readNoise.bracket->high) +
                  " DN and cannot be told from 0 or from the rounding to codes");
  }
}

/** \a offset: known, identified, or else the darkest level, minus the centre; \a offsetErrorDn how far it may be off.
 */
inline void
FillFlickerAndMotion(Report & report, const RefinedReportInput & input, double offset, double offsetErrorDn)
{
  const RefinedFindings & found = input.found;
  OffsetLine              line = found.line;
  line.UseOffset(offset);
  const auto frames = static_cast<double>(input.frames);
  report.flicker = line.gamma;
  const double noise = line.Widening() / line.precision;
  double       squares = 0.0;
  for (const double gamma : line.gamma)
  {
    squares += gamma * gamma;
  }
  const double variance = squares / (frames - 1.0) - noise;
  const double fromOffset = 2.0 * variance * line.sensitivity * offsetErrorDn;
  const double ownError =
    2.0 * std::sqrt(std::max(0.0, variance) * noise / (frames - 1.0)) + noise * std::sqrt(2.0 / (frames - 1.0));
  report.flickerSd = RootOf(variance, std::hypot(ownError, fromOffset), "1");
  if (found.local.series.cols() > 0 && !found.isOffsetDrift)
  {
    const double sd = found.localFlicker.Sd(offset);
    const double step = 1.0 + offsetErrorDn;
    const double slope = (found.localFlicker.Sd(offset + step) - found.localFlicker.Sd(offset - step)) / (2.0 * step);
    report.flickerSd = WithError(sd, std::hypot(slope * offsetErrorDn, sd * std::sqrt(noise)), "1");
  }

  const auto shift = [&](std::size_t stencil, std::size_t axis, Quantity & sd) {
    const auto &        stencils = found.motion.stencils;
    const auto          place = std::find(stencils.begin(), stencils.end(), stencil);
    std::vector<double> series;
    if (place == stencils.end())
    {
      sd = Quantity::Without(EstimateStatus::NotIdentifiable, "pixel");
      return series;
    }
    const auto k = static_cast<Eigen::Index>(place - stencils.begin());
    const auto spread = [&](const auto & coefficients, Eigen::Index column, double variance) {
      series.assign(input.frames, 0.0);
      double mean = 0.0;
      for (std::size_t t = 0; t < input.frames; ++t)
      {
        series[t] = coefficients(static_cast<Eigen::Index>(t), column) / (1.0 + line.gamma[t]);
        mean += series[t] / frames;
      }
      double sum = 0.0;
      for (double & value : series)
      {
        value -= mean;
        sum += value * value;
      }
      return sum / (frames - 1.0) - variance;
    };
    const double leastVariance = found.motion.covariance(k, k) * found.motionPhi;
    double       square = spread(found.motion.coefficients, k, leastVariance);
    double       error2 = leastVariance;
    double       systematic = 0.0;
    if (found.shifts)
    {
      const double leastSquares = std::sqrt(std::max(0.0, square));
      const auto   i = static_cast<Eigen::Index>(axis);
      error2 = found.shifts->covariance(i, i) * found.motionPhi;
      square = spread(found.shifts->coefficients, i, error2);
      systematic = 0.5 * std::abs(std::sqrt(std::max(0.0, square)) - leastSquares);
    }
    const double sdValue = std::sqrt(std::max(0.0, square));
    const double error = std::hypot(2.0 * sdValue * std::sqrt(error2 / (frames - 1.0)),
                                    error2 * std::sqrt(2.0 / (frames - 1.0)),
                                    2.0 * sdValue * systematic);
    sd = RootOf(square, error, "pixel");
    return series;
  };
  const std::vector<double> x = shift(StencilX, 0, report.vibrationSdX);
  const std::vector<double> y = shift(StencilY, 1, report.vibrationSdY);
  report.vibrationCovariance = Quantity::Without(EstimateStatus::NotIdentifiable, "pixel^2");
  if (!x.empty() && !y.empty())
  {
    double product = 0.0;
    for (std::size_t t = 0; t < input.frames; ++t)
    {
      report.motion.push_back({ x[t], y[t] });
      product += x[t] * y[t] / (frames - 1.0);
    }
    if (found.shifts)
    {
      product -= found.shifts->covariance(0, 1) * found.motionPhi;
    }
    report.vibrationCovariance = Quantity::Identified(product, "pixel^2");
  }
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
  const double dispersion = std::max({ 1.0, found.intensityChi2, found.classes.reducedChi2 });
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
                  ? "the variance bends against the mean by " + detail::Text(100.0 * bend) +
                      " % of itself (expected less than 3 %): the data are not raw (gamma, compression), or not linear"
                  : "the variance does not rise with the mean (slope " + detail::Text(v.gain) +
                      " DN/e-, expected above 0): the data are not raw, or hold too little noise");
    return report;
  }
  const double          step = input.summary.codes.quantisationStepDn;
  const double          quantisationDn2 = step * step / 12.0;
  const Eigen::Matrix2d covariance =
    v.covariance * dispersion + detail::Disagreement(v, found.fromFlat) + detail::StrongVibration(v, found.model);
  const double student = StudentQuantile(0.975, static_cast<double>(input.frames) - 2.0);
  if (std::sqrt(covariance(0, 0)) > 0.25 * v.gain || static_cast<double>(report.pixels.used) < 0.1 * found.usable)
  {
    SetSensorParameters(report, EstimateStatus::NotIdentifiable);
    report.Warn(
      "too-little-to-measure",
      detail::Text(100.0 * static_cast<double>(report.pixels.used) / std::max(1.0, found.usable)) +
        " % of the pixels that are not clipped fit a static scene (expected at least 10 %) and give a gain of " +
        detail::Text(v.gain) + " +- " + detail::Text(std::sqrt(covariance(0, 0))) +
        " DN/e-: the scene is not static, or too dark; choose a static part of it");
    return report;
  }
  report.gain = detail::WithError(v.gain, std::sqrt(covariance(0, 0)), "DN/e-", student);
  report.totalIntercept = detail::WithError(v.intercept, std::sqrt(covariance(1, 1)), "DN^2", student);
  report.intercept = detail::WithError(v.intercept - quantisationDn2, std::sqrt(covariance(1, 1)), "DN^2", student);
  detail::FillOffsetAndReadNoise(report, input, covariance, quantisationDn2, student);
  return report;
}

} // namespace sensornoise

#endif
