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
#ifndef sensornoise_published_PublishedReport_h
#define sensornoise_published_PublishedReport_h

#include "sensornoise/base/IntensityIndex.h"
#include "sensornoise/base/RollingShutter.h"
#include "sensornoise/base/PolynomialFit.h"
#include "sensornoise/base/RequiredFlickerZ.h"
#include "sensornoise/published/FlickerEstimate.h"
#include "sensornoise/published/NoiseParameters.h"
#include "sensornoise/published/PublishedFindings.h"
#include "sensornoise/published/PublishedSettings.h"
#include "sensornoise/published/VibrationCovariance.h"
#include "sensornoise/report/Quantities.h"
#include "sensornoise/report/Report.h"
#include "sensornoise/report/StackReport.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace sensornoise
{

namespace detail
{
inline void
DescribeSettings(Report & report, const PublishedFindings & found)
{
  const PublishedSettings & settings = found.settings;
  report.method = "published";
  report.settings = { { "level", settings.level },
                      { "bright_quantile", settings.brightQuantile },
                      { "dark_quantile", settings.darkQuantile },
                      { "rolling_shutter", std::string(NameOf(settings.rollingShutter)) },
                      { "sigma_rows", found.flicker.sigmaLines },
                      { "shutter_axis", std::string(settings.shutterAxis == 0 ? "x" : "y") } };
}

inline void
FillVibration(Report & report, const PublishedFindings & found)
{
  const VibrationCovariance vibration = FitVibrationCovariance(found.mean.data(),
                                                               found.variance.data(),
                                                               found.valid.data(),
                                                               found.geometry.width,
                                                               found.geometry.height,
                                                               found.flicker.flickerSd);
  const auto                sd = [&vibration](double varianceOfAxis) {
    return vibration.isDetermined && varianceOfAxis > 0.0 ? Quantity::Identified(std::sqrt(varianceOfAxis), "pixel")
                                                                         : Quantity::Without(EstimateStatus::NotIdentifiable, "pixel");
  };
  report.vibrationSdX = sd(vibration.varianceXPixels2);
  report.vibrationSdY = sd(vibration.varianceYPixels2);
  report.vibrationCovariance = vibration.isDetermined ? Quantity::Identified(vibration.covariancePixels2, "pixel^2")
                                                      : Quantity::Without(EstimateStatus::NotIdentifiable, "pixel^2");
}

inline void
FillFlicker(Report & report, const PublishedFindings & found, bool identified)
{
  const FlickerEstimate & flicker = found.flicker;
  report.flicker = flicker.gamma;
  for (std::size_t t = 0; t < found.frames && !flicker.gammaLines.empty(); ++t)
  {
    const auto first = flicker.gammaLines.begin() + static_cast<std::ptrdiff_t>(t * flicker.lines);
    report.flickerRows.emplace_back(first, first + static_cast<std::ptrdiff_t>(flicker.lines));
    for (std::size_t line = 0; line < flicker.lines; ++line)
    {
      if (!flicker.IsKnown(line))
      {
        report.flickerRows.back()[line] = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  if (identified)
  {
    report.flickerSd = Quantity::Identified(flicker.flickerSd, "1");
    return;
  }
  report.flickerSd = Quantity::Without(EstimateStatus::UpperLimit, "1");
  report.flickerSd.bracket = Interval{ 0.0, flicker.flickerSd };
}
} // namespace detail

/** The report of the published method: values and statuses, no standard errors and no intervals (the paper has none for
 * a stack, and those of ordinary regression would hide its bias). */
inline Report
MakePublishedReport(const PublishedFindings & found)
{
  Report report;
  detail::DescribeSettings(report, found);
  DescribeStack(report, found.geometry, found.frames, found.summary, found.valid, found.pixelUse);
  WarnOfStack(report, found.frames, found.summary);
  if (!found.failure.empty())
  {
    report.Warn("nothing-to-measure", found.failure);
    return report;
  }
  const FlickerEstimate & flicker = found.flicker;
  detail::WarnOfFlicker(report, found);
  detail::FillFlicker(report, found, flicker.flickerZ > RequiredFlickerZ);
  detail::FillVibration(report, found);

  const double contrastDn = found.bright.levelDn - found.dark.levelDn;
  const double spreadDn = found.bright.levelSdDn + found.dark.levelSdDn;
  if (!(contrastDn > 6.0 * spreadDn))
  {
    SetSensorParameters(report, EstimateStatus::NotIdentifiable);
    report.Warn("intensity-range-too-small",
                "the even areas span " + Text(contrastDn) + " DN, expected more than " + Text(6.0 * spreadDn) +
                  " DN (6 standard deviations of their means): use a scene with dark " + "and bright areas");
    return report;
  }

  const std::size_t    pixels = found.geometry.Pixels();
  const RegressionData corrected{ found.mean.data(), found.correctedVariance.data(), found.kept.data(), pixels };
  const RegressionData raw{ found.mean.data(), found.variance.data(), found.kept.data(), pixels };
  const PolynomialFit  line = FitLine(corrected);
  FillBaselines(report, raw);

  const bool identified = flicker.flickerZ > RequiredFlickerZ;
  if (!identified)
  {
    report.Warn("offset-not-identifiable",
                "the flicker (sd " + Text(flicker.flickerSd) + ") exceeds the noise of its estimate by " +
                  Text(flicker.flickerZ) + " standard deviations, expected more than 6: use a lamp that " +
                  "flickers more, or more frames, or dark frames");
  }
  // The darkest mean bounds the offset (flux >= 0); being a mean of noise it may lie below it by some of its errors.
  const IntensityIndex index(found.mean.data(), found.valid.data(), pixels);
  const double         darkestDn = index.QuantileDn(0.001) + 3.0 * found.dark.levelSdDn;
  FillNoiseParameters(report, line, identified ? std::optional<double>(flicker.offsetDn) : std::nullopt, darkestDn);

  const FitQuality quality = JudgeLine(corrected, line, found.frames);
  FillFit(report, quality);
  report.fit.offsetLinePhi = flicker.offsetLinePhi;
  const double bendDn2 = quality.curvature * contrastDn * contrastDn / 8.0; // parabola from chord, half way
  const double middleDn2 = line.intercept + line.slope * 0.5 * (found.bright.levelDn + found.dark.levelDn);
  if (std::abs(quality.curvatureZ) > 5.0 && std::abs(bendDn2) > 0.03 * middleDn2)
  {
    report.Warn("corrected-variance-curved",
                "the corrected variance bends by " + Text(100.0 * bendDn2 / middleDn2) +
                  " % of itself (expected under 3 %): vibrations, several lamps, or data that are not linear");
  }

  FillScatter(report, found.mean, found.variance, found.correctedVariance, found.pixelUse);
  return report;
}

} // namespace sensornoise

#endif
