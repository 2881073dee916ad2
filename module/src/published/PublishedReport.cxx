// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/PublishedReport.h"

#include "base/Text.h"
#include "sensornoise/FrameGeometry.h"
#include "base/Quantiles.h"
#include "base/PolynomialFit.h"
#include "sensornoise/Settings.h"
#include "base/Constants.h"
#include "published/FlickerEstimate.h"
#include "published/IsoIntensitySet.h"
#include "published/NoiseParameters.h"
#include "published/PublishedScene.h"
#include "published/VibrationCovariance.h"
#include "report/Quantities.h"
#include "report/StackReport.h"
#include "report/StackSettings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace sensornoise
{

namespace
{
void
DescribeSettings(Report & report, const PublishedFindings & found)
{
  const PublishedSettings & settings = found.settings;
  report.method = "published";
  report.settings = { { "level", settings.level },
                      { "bright_quantile", settings.brightQuantile },
                      { "dark_quantile", settings.darkQuantile },
                      { "rolling_shutter", std::string(NameOf(settings.rollingShutter)) },
                      { "sigma_rows", found.flicker.sigmaRows },
                      { "shutter_axis", std::string(settings.shutterAxis == 0 ? "x" : "y") } };
  NoteCodes(report, settings.codes);
}

void
WarnOfWidening(Report & report, WarningCode code, const char * name, const IsoIntensitySet & set)
{
  if (set.wideningSteps > 0)
  {
    report.Warn(code,
                std::string("too few pixels have the ") + name + " intensity: " + std::to_string(set.pixels.size()) +
                  " pixels at the quantile " + Text(set.quantile) + " were taken instead (" +
                  std::to_string(set.wideningSteps) + " steps, Remark 3 of the paper)");
  }
}

void
WarnOfFlicker(Report & report, const FlickerEstimate & flicker)
{
  if (flicker.sigmaRows > 0.0)
  {
    report.Warn(WarningCode::RollingShutter,
                "the flicker differs from row to row and is estimated over neighbourhoods of sigma_y = " +
                  Text(flicker.sigmaRows) + " rows");
    const auto unknown = std::count(flicker.rowKnown.begin(), flicker.rowKnown.end(), 0);
    if (unknown > 0)
    {
      report.Warn(WarningCode::LinesWithoutFlicker,
                  "the brightest pixels do not reach " + std::to_string(unknown) + " of " +
                    std::to_string(flicker.rows) + " rows, whose flicker is not known: their pixels are left out");
    }
  }
  if (flicker.offsetLinePhi > 3.0)
  {
    report.Warn(WarningCode::OffsetLineMisfit,
                "dark pixels do not follow the flicker of the bright ones (residual variance " +
                  RoundedApart(flicker.offsetLinePhi, 1.0) +
                  " times the noise, expected 1), so that the offset is doubtful. Use one lamp, or --method refined");
  }
}

void
FillFlicker(Report & report, const FlickerEstimate & flicker, bool isIdentified)
{
  report.flicker = flicker.gamma;
  for (std::size_t t = 0; t < flicker.gamma.size() && !flicker.gammaRows.empty(); ++t)
  {
    const auto first = flicker.gammaRows.begin() + static_cast<std::ptrdiff_t>(t * flicker.rows);
    report.flickerRows.emplace_back(first, first + static_cast<std::ptrdiff_t>(flicker.rows));
    for (std::size_t row = 0; row < flicker.rows; ++row)
    {
      if (!flicker.IsKnown(row))
      {
        report.flickerRows.back()[row] = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  if (isIdentified)
  {
    report.flickerSd = Quantity::Identified(flicker.flickerSd);
    return;
  }
  report.flickerSd = Quantity::Without(EstimateStatus::UpperLimit);
  report.flickerSd.bracket = Interval{ 0.0, flicker.flickerSd };
}

void
FillVibration(Report & report, const PublishedFindings & found, const ParallelFor & parallelFor)
{
  const VibrationCovariance vibration = FitVibrationCovariance(found.scene.mean.data(),
                                                               found.scene.variance.data(),
                                                               found.scene.valid.data(),
                                                               found.geometry.width,
                                                               found.geometry.height,
                                                               found.flicker.flickerSd,
                                                               parallelFor);
  const auto                sd = [&vibration](double varianceOfAxis) {
    return vibration.isDetermined && varianceOfAxis > 0.0 ? Quantity::Identified(std::sqrt(varianceOfAxis))
                                                                         : Quantity::Without(EstimateStatus::NotIdentifiable);
  };
  report.vibrationSdX = sd(vibration.varianceXPixels2);
  report.vibrationSdY = sd(vibration.varianceYPixels2);
  report.vibrationCovariance = vibration.isDetermined ? Quantity::Identified(vibration.covariancePixels2)
                                                      : Quantity::Without(EstimateStatus::NotIdentifiable);
}

double
ContrastDn(const PublishedScene & scene)
{
  return scene.bright.levelDn - scene.dark.levelDn;
}

/** Returns whether the even areas have enough different intensities for a line. If not, all parameters become
 * not-identifiable. */
bool
HasRange(Report & report, const PublishedScene & scene)
{
  const double spreadDn = scene.bright.levelSdDn + scene.dark.levelSdDn;
  if (ContrastDn(scene) > 6.0 * spreadDn)
  {
    return true;
  }
  SetSensorParameters(report, EstimateStatus::NotIdentifiable);
  report.Warn(WarningCode::IntensityRangeTooSmall,
              "the even areas span " + RoundedApart(ContrastDn(scene), 6.0 * spreadDn) + " DN, expected more than " +
                Rounded(6.0 * spreadDn) +
                " DN (6 standard deviations of their means). Include dark and bright areas in the scene");
  return false;
}

/** Sets the parameters of the sensor from the line through the corrected variance. */
void
FillNoise(Report &                  report,
          const PublishedFindings & found,
          const RegressionData &    corrected,
          const PolynomialFit &     line,
          const ParallelFor &       parallelFor)
{
  const PublishedScene &  scene = found.scene;
  const FlickerEstimate & flicker = found.flicker;
  const bool              isIdentified = flicker.flickerZ > Significance.everyPixel;
  if (!isIdentified)
  {
    report.Warn(WarningCode::OffsetNotIdentifiable,
                DescribeInsignificantFlicker(flicker.flickerZ) +
                  ". Record more flicker or more frames, or use --method refined with dark frames "
                  "(--dark)");
  }
  // The darkest mean bounds the offset (flux >= 0). As it is the mean of noisy values, it may be below the offset by
  // some of its errors.
  const IntensityIndex index(scene.mean.data(), scene.valid.data(), corrected.pixels, parallelFor);
  const double         darkestDn = index.QuantileDn(0.001, parallelFor) + 3.0 * scene.dark.levelSdDn;
  FillNoiseParameters(report, line, isIdentified ? std::optional<double>(flicker.offsetDn) : std::nullopt, darkestDn);
}

/** Sets the quality of the fit of the line. */
void
FillQuality(Report &                  report,
            const PublishedFindings & found,
            const RegressionData &    corrected,
            const PolynomialFit &     line,
            const ParallelFor &       parallelFor)
{
  const PublishedScene & scene = found.scene;
  const FitQuality       quality = EvaluateLineFit(corrected, line, found.frames, parallelFor);
  FillFit(report, quality);
  report.fit.offsetLinePhi = found.flicker.offsetLinePhi;
  const double contrastDn = ContrastDn(scene);
  // Parabola minus chord, half way between both levels.
  const double bendDn2 = quality.curvature * contrastDn * contrastDn / 8.0;
  const double middleDn2 = line.intercept + line.slope * 0.5 * (scene.bright.levelDn + scene.dark.levelDn);
  if (std::abs(quality.curvatureZ) > 5.0 && std::abs(bendDn2) > 0.03 * middleDn2)
  {
    report.Warn(WarningCode::CorrectedVarianceCurved,
                "the corrected variance deviates from its line by " +
                  PercentApart(std::abs(bendDn2) / middleDn2, 0.03) +
                  " of itself (expected less than 3 %): vibrations, several lamps, or a non-linear response. Use "
                  "--method refined");
  }
}
} // namespace

Report
MakePublishedReport(const PublishedFindings & found, const ParallelFor & parallelFor)
{
  const PublishedScene & scene = found.scene;
  const CorrectedMaps &  maps = found.corrected;
  Report                 report;
  DescribeSettings(report, found);
  const auto valid = static_cast<std::size_t>(std::count(scene.valid.begin(), scene.valid.end(), std::uint8_t{ 1 }));
  DescribeStack(report, found.geometry, found.frames, scene.summary, valid, maps.pixelUse);
  WarnOfStack(report, found.frames, scene.summary);
  if (scene.failureReason)
  {
    report.Warn(scene.failureReason->GetCode(), scene.failureReason->what());
    return report;
  }
  WarnOfWidening(report, WarningCode::BrightSetWidened, "bright", scene.bright);
  WarnOfWidening(report, WarningCode::DarkSetWidened, "dark", scene.dark);
  WarnOfFlicker(report, found.flicker);
  FillFlicker(report, found.flicker, found.flicker.flickerZ > Significance.everyPixel);
  FillVibration(report, found, parallelFor);
  if (!HasRange(report, scene))
  {
    return report;
  }
  const std::size_t    pixels = found.geometry.Pixels();
  const RegressionData corrected{ scene.mean.data(), maps.variance.data(), scene.kept.data(), pixels };
  const RegressionData raw{ scene.mean.data(), scene.variance.data(), scene.kept.data(), pixels };
  const PolynomialFit  line = FitLine(corrected, parallelFor);
  FillBaselines(report, raw, parallelFor);
  FillNoise(report, found, corrected, line, parallelFor);
  FillQuality(report, found, corrected, line, parallelFor);
  FillScatter(report, scene.mean, scene.variance, maps.variance, MaskOfUsed(maps.pixelUse), parallelFor);
  return report;
}

} // namespace sensornoise
