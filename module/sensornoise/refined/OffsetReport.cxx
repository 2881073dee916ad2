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
#include "sensornoise/refined/OffsetReport.h"

#include "sensornoise/base/RequiredFlickerZ.h"
#include "sensornoise/base/Text.h"
#include "sensornoise/moments/KnownOffset.h"
#include "sensornoise/report/Quantities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace sensornoise
{

namespace
{
/** What is known when offset and read noise are filed. */
struct OffsetLimits
{
  double lowestDn;        ///< where sigma = 0
  double darkestDn;       ///< darkest level of the scene
  double largestNoiseDn2; ///< sigma^2 if the offset were the darkest level
};

OffsetLimits
LimitsOf(const RefinedResults & found, double quantisationDn2)
{
  const VarianceLine & v = found.variance.line;
  const double         lowestDn = -v.intercept / v.gain;
  const double         darkestDn = std::max(lowestDn, found.scene.model.darkestDn);
  return { lowestDn, darkestDn, std::max(0.0, v.intercept + v.gain * darkestDn - quantisationDn2) };
}

/** The read noise as dark frames tell it; \a lineDn2 is the variance at the offset of the line through the others. */
void
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

/** Warns if the known offset disagrees with the flicker's, or with the data. */
void
CompareKnownOffset(Report &                report,
                   const RefinedResults &  found,
                   const OffsetEstimate &  flicker,
                   const OffsetLimits &    limits,
                   const Eigen::Matrix2d & covariance)
{
  const double offsetDn = found.settings.offset->valueDn;
  const double offsetErrorDn = found.settings.offset->standardErrorDn;
  const double difference = flicker.valueDn - offsetDn;
  const double error = std::hypot(flicker.standardErrorDn, offsetErrorDn);
  if (flicker.obstacle.empty() && std::abs(difference) > 3.0 * error)
  {
    report.Warn("steady-light",
                "the level that does not flicker is " + Text(flicker.valueDn) + " +- " + Text(flicker.standardErrorDn) +
                  " DN, " + Text(difference) + " DN from the given offset: " +
                  (difference > 0.0 ? "light that does not flicker, or dark current, makes the difference"
                                    : "that is too high for these frames"));
  }
  const double slackDn = 3.0 * offsetErrorDn + 4.0 * std::sqrt(covariance(1, 1)) / found.variance.line.gain;
  const double rangeDn = found.scene.model.brightestDn - found.scene.model.darkestDn;
  if (offsetDn < limits.lowestDn - slackDn || offsetDn > limits.darkestDn + slackDn + 0.01 * rangeDn)
  {
    report.Warn("offset-out-of-range",
                "the given offset, " + Text(offsetDn) + " DN, is not between " + Text(limits.lowestDn) + " and " +
                  Text(limits.darkestDn) + " DN, where sigma^2 >= 0 and the darkest pixels put it");
  }
}

/** Files that offset and read noise are not identifiable, with their brackets. */
void
FillBrackets(Report & report, const OffsetLimits & limits, double gain)
{
  const auto bracket = report.offset.bracket;
  report.offset = Quantity::Without(EstimateStatus::NotIdentifiable, "DN");
  report.offset.bracket = bracket;
  report.readNoise = Quantity::Without(EstimateStatus::NotIdentifiable, "DN");
  report.readNoise.bracket = Interval{ 0.0, std::sqrt(limits.largestNoiseDn2) };
  report.readNoiseElectrons = Quantity::Without(EstimateStatus::NotIdentifiable, "e-");
  report.readNoiseElectrons.bracket = Interval{ 0.0, std::sqrt(limits.largestNoiseDn2) / gain };
}

/** Files the read noise at the offset, which is identified. */
void
FillReadNoise(Report &                report,
              const RefinedResults &  found,
              double                  offsetDn,
              double                  offsetErrorDn,
              const Eigen::Matrix2d & covariance,
              double                  quantisationDn2,
              double                  student)
{
  const VarianceLine & v = found.variance.line;
  const double         square = v.intercept + v.gain * offsetDn - quantisationDn2;
  const double         error = std::sqrt(covariance(1, 1) + offsetDn * offsetDn * covariance(0, 0) +
                                 2.0 * offsetDn * covariance(0, 1) + v.gain * v.gain * offsetErrorDn * offsetErrorDn);
  report.readNoise = RootOf(square, error, "DN", student);
  report.readNoiseElectrons = RootOf(square / (v.gain * v.gain), error / (v.gain * v.gain), "e-", student);
  if (square + 4.0 * error < 0.0)
  {
    report.readNoise = Quantity::Without(EstimateStatus::Failed, "DN");
    report.readNoiseElectrons = Quantity::Without(EstimateStatus::Failed, "e-");
  }
  if (found.settings.offset && found.settings.offset->variance)
  {
    FillDarkReadNoise(report, *found.settings.offset->variance, quantisationDn2, square, error);
  }
  if (report.readNoise.status == EstimateStatus::UpperLimit)
  {
    report.Warn("read-noise-upper-limit",
                "the read noise is below " + Text(*report.readNoise.bracket->high) +
                  " DN and cannot be told from 0 or from the rounding to codes");
  }
}
} // namespace

OffsetEstimate
EstimateOffset(const RefinedResults & found)
{
  const ProvisionalModel &           model = found.scene.model;
  const OffsetLine &                 line = found.polished.line;
  const std::optional<LocalOffset> & local = found.polished.localOffset;
  const double                       rangeDn = model.brightestDn - model.darkestDn;
  OffsetEstimate                     estimate;
  double                             low = line.low;
  double                             high = line.high;
  estimate.valueDn = line.offset + model.centreDn;
  estimate.standardErrorDn = line.standardError;
  estimate.phi = line.phi;
  const bool isLocal = found.HasLocalLight();
  if (isLocal && local)
  {
    estimate.valueDn = local->offset + model.centreDn;
    estimate.standardErrorDn = local->standardError;
    estimate.phi = local->phi;
    low = local->low;
    high = local->high;
  }
  estimate.interval = Interval{ low + model.centreDn, high + model.centreDn };

  const VarianceLine & v = found.variance.line;
  const double         slackDn = 3.0 * estimate.standardErrorDn +
                         4.0 * std::sqrt(v.At(model.darkestDn) / static_cast<double>(found.scene.frame.frames));
  const double slackBelowDn = slackDn + 4.0 * std::sqrt(v.covariance(1, 1)) / v.gain;
  if (!(line.flickerZ > RequiredFlickerZ) && !isLocal)
  {
    estimate.obstacle =
      "the flicker exceeds its own noise by " + Text(line.flickerZ) + " standard deviations (expected more than 6)";
  }
  else if (isLocal && !local)
  {
    estimate.obstacle = "the light changes differently over the frame, and no part of it tells the offset";
  }
  else if (!std::isfinite(low) || !std::isfinite(high) || high - low > 0.25 * rangeDn)
  {
    estimate.obstacle = "its interval, " + Text(low + model.centreDn) + " to " + Text(high + model.centreDn) +
                        " DN, is wider than a quarter of the range of the scene, " + Text(rangeDn) + " DN";
  }
  else if (estimate.valueDn < -v.intercept / v.gain - slackBelowDn || estimate.valueDn > model.darkestDn + slackDn)
  {
    estimate.obstacle = "the flicker's zero, " + Text(estimate.valueDn) +
                        " DN, contradicts sigma^2 >= 0 or the darkest level: parts of the light flicker differently";
  }
  else if (isLocal && local->phi > 4.0)
  {
    estimate.obstacle =
      "the responses to the lamps do not meet in one zero (dispersion " + Text(local->phi) + ", expected 1)";
  }
  return estimate;
}

void
FillOffsetAndReadNoise(Report &                report,
                       const RefinedResults &  found,
                       const OffsetEstimate &  flicker,
                       const Eigen::Matrix2d & covariance,
                       double                  quantisationDn2,
                       double                  student)
{
  const OffsetLimits limits = LimitsOf(found, quantisationDn2);
  report.fit.offsetLinePhi = flicker.phi;
  std::optional<double> offsetDn;
  double                offsetErrorDn = 0.0;
  if (found.settings.offset)
  {
    offsetDn = found.settings.offset->valueDn;
    offsetErrorDn = found.settings.offset->standardErrorDn;
    report.offset = WithError(*offsetDn, offsetErrorDn, "DN");
    CompareKnownOffset(report, found, flicker, limits, covariance);
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
  if (limits.darkestDn > limits.lowestDn)
  {
    report.offset.bracket = Interval{ limits.lowestDn, limits.darkestDn };
  }
  if (!offsetDn)
  {
    FillBrackets(report, limits, found.variance.line.gain);
    return;
  }
  FillReadNoise(report, found, *offsetDn, offsetErrorDn, covariance, quantisationDn2, student);
  report.covariance = std::array<std::array<double, 3>, 3>{ { { covariance(0, 0), covariance(0, 1), 0.0 },
                                                              { covariance(0, 1), covariance(1, 1), 0.0 },
                                                              { 0.0, 0.0, offsetErrorDn * offsetErrorDn } } };
}

} // namespace sensornoise
