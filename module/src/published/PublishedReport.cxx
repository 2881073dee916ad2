// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/PublishedPasses.h"

#include "base/Text.h"
#include "base/PolynomialFit.h"
#include "sensornoise/Settings.h"
#include "published/Flicker.h"
#include "published/PublishedScene.h"
#include "report/Quantities.h"
#include "report/StackReport.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace sensornoise
{

namespace
{
/** Largest residual variance of the offset line without a warning, relative to the variance of its noise [1]. Chosen.
 */
constexpr double LargestOffsetLinePhi = 3.0;

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
  NoteDnSettings(report, settings.dnSettings);
}

void
WarnOfWidening(Report & report, WarningCode code, const char * name, const IsoIntensitySet & set)
{
  if (set.wideningSteps > 0)
  {
    report.Warn(code,
                std::string("too few pixels have the ") + name + " intensity: " + std::to_string(set.pixels.size()) +
                  " pixels at the quantile " + Text(set.quantile) + " were taken instead (" +
                  CountText(set.wideningSteps, "step") +
                  ", Remark 3 of the paper), which determine the offset less well. Include larger areas of one "
                  "brightness in the scene");
  }
}

void
WarnOfFlicker(Report & report, const FlickerEstimate & flicker)
{
  if (flicker.sigmaRows > 0.0)
  {
    report.Warn(WarningCode::RollingShutter,
                "the flicker differs from row to row and is estimated over neighbourhoods of sigma_y = " +
                  Text(flicker.sigmaRows) +
                  " rows, which needs bright pixels in all of them. Use constant illumination to avoid this");
    const auto unknown = std::count(flicker.rowKnown.begin(), flicker.rowKnown.end(), 0);
    if (unknown > 0)
    {
      report.Warn(
        WarningCode::LinesWithoutFlicker,
        "the brightest pixels do not reach " + std::to_string(unknown) + " of " + std::to_string(flicker.rows) +
          " rows, whose flicker is not known: their pixels are left out. Include bright areas in all rows, or use "
          "--method refined");
    }
  }
  if (flicker.offsetLinePhi > LargestOffsetLinePhi)
  {
    report.Warn(
      WarningCode::OffsetLineMisfit,
      "dark pixels do not follow the flicker of the bright ones (residual variance " +
        RoundedApart(flicker.offsetLinePhi, 1.0) +
        " times the noise, expected 1), so that the offset is doubtful. Use one light source, or --method refined");
  }
}

void
FillFlicker(Report & report, const FlickerEstimate & flicker)
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
}

void
WarnOfLine(Report & report, const NoiseParameters & found)
{
  if (found.verdict != LineVerdict::Identified)
  {
    report.Warn(WarningCode::VarianceNotAffine,
                found.verdict == LineVerdict::NotRising
                  ? "the variance does not rise with the mean (slope " + Rounded(found.line.slope) +
                      " DN/e-, expected above 0): the frames are not raw, or have too little noise. Record raw "
                      "frames"
                  : "the " + std::to_string(found.line.pixels) +
                      " pixels of the regression have one intensity. Include dark and bright areas in "
                      "the scene");
  }
  if (found.IsReadNoiseLost())
  {
    report.Warn(
      WarningCode::ReadNoiseNotIdentifiable,
      "gain, intercept and offset give a squared read noise of " + Rounded(found.squaredReadNoiseDn2) +
        " DN^2 (expected above 0), which is within their errors. Record more frames, or use --method refined");
  }
  if (found.HasBounds() && found.offsetDn && *found.offsetDn > *found.darkestDn)
  {
    report.Warn(WarningCode::OffsetAboveDarkest,
                "the offset, " + RoundedApart(*found.offsetDn, *found.darkestDn) + " DN, is above the darkest level, " +
                  Rounded(*found.darkestDn) + " DN, because its error is large. Record more flicker or more frames");
  }
}

void
WarnOfScatter(Report & report, const NoiseParameters & found)
{
  if (found.IsScattered())
  {
    report.Warn(
      WarningCode::VarianceNotAffine,
      "the corrected variance scatters about its line " + RoundedApart(found.quality->reducedChi2, LargestReducedChi2) +
        " times as much as sampling noise does (expected at most 10): the scene moves, the flicker differs within the "
        "frame, or the frames are not raw. Use --method refined, or raw frames");
  }
  else if (found.quality && found.quality->reducedChi2 > PoorReducedChi2)
  {
    report.Warn(WarningCode::PoorFit,
                "the corrected variance scatters about its line " +
                  RoundedApart(found.quality->reducedChi2, PoorReducedChi2) +
                  " times as much as sampling noise does (expected at most 1.5): vibrations, flicker that differs "
                  "within the frame, or moving objects are left in it. Use --method refined");
  }
}
/** Copies the parameters of the sensor, and warns of findings that contradict them. */
void
FillParameters(Report & report, const PublishedFindings & found, const PublishedEstimate & estimate)
{
  if (!estimate.HasFlicker())
  {
    report.Warn(WarningCode::OffsetNotIdentifiable,
                DescribeInsignificantFlicker(found.flicker.flickerZ) +
                  ". Record more flicker or more frames, or use --method refined with dark frames "
                  "(--dark)");
  }
  FileParameters(report, *estimate.parameters);
  report.fit.offsetLinePhi = found.flicker.offsetLinePhi;
  if (estimate.curvedFraction)
  {
    report.Warn(WarningCode::CorrectedVarianceCurved,
                "the corrected variance deviates from its line by " +
                  PercentApart(*estimate.curvedFraction, LargestCurvedFraction) +
                  " (expected less than 3 %), so that the gain depends on the range of levels: vibrations, several "
                  "light sources, or "
                  "a non-linear response. Use --method refined");
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
  const PublishedEstimate estimate = EstimatePublished(found, parallelFor);
  WarnOfWidening(report, WarningCode::BrightSetWidened, "bright", scene.bright);
  WarnOfWidening(report, WarningCode::DarkSetWidened, "dark", scene.dark);
  WarnOfFlicker(report, found.flicker);
  FillFlicker(report, found.flicker);
  report.flickerSd = estimate.flickerSd;
  report.vibrationSdX = estimate.vibrationSdX;
  report.vibrationSdY = estimate.vibrationSdY;
  report.vibrationCovariance = estimate.vibrationCovariance;
  if (!estimate.parameters)
  {
    SetSensorParameters(report, EstimateStatus::NotIdentifiable);
    report.Warn(WarningCode::IntensityRangeTooSmall,
                "the even areas span " + RoundedApart(estimate.contrastDn, estimate.neededDn) +
                  " DN, expected more than " + Rounded(estimate.neededDn) +
                  " DN (6 standard deviations of their means). Include dark and bright areas in the scene");
    return report;
  }
  const RegressionData raw{ scene.mean.data(), scene.variance.data(), scene.kept.data(), found.geometry.Pixels() };
  FillBaselines(report, raw, parallelFor);
  FillParameters(report, found, estimate);
  FillScatter(report, scene.mean, scene.variance, maps.variance, MaskOfUsed(maps.pixelUse), parallelFor);
  return report;
}

void
FileParameters(Report & report, const NoiseParameters & parameters)
{
  report.gain = report.varianceSlope = parameters.gain;
  report.intercept = report.totalIntercept = parameters.intercept;
  report.offset = parameters.offset;
  report.readNoise = parameters.readNoise;
  report.readNoiseElectrons = parameters.readNoiseElectrons;
  if (parameters.quality)
  {
    report.fit.reducedChi2 = parameters.quality->reducedChi2;
    report.fit.curvature = parameters.quality->curvature;
    report.fit.curvatureZ = parameters.quality->curvatureZ;
  }
  WarnOfLine(report, parameters);
  WarnOfScatter(report, parameters);
}

} // namespace sensornoise
