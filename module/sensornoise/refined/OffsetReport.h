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
#ifndef sensornoise_refined_OffsetReport_h
#define sensornoise_refined_OffsetReport_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/RequiredFlickerZ.h"
#include "sensornoise/moments/KnownOffset.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/refined/RefinedFindings.h"
#include "sensornoise/report/Quantities.h"
#include "sensornoise/report/Report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace sensornoise
{

namespace detail
{
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
} // namespace detail

} // namespace sensornoise

#endif
