// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/NoiseParameters.h"

#include "base/Text.h"
#include "report/Quantities.h"

#include <cmath>
#include <string>

namespace sensornoise
{

namespace
{
/** Sets offset and read noise without their bounds. */
void
FillOffset(Report & report, const PolynomialFit & line, std::optional<double> offsetDn)
{
  if (!offsetDn)
  {
    report.offset = Quantity::Without(EstimateStatus::NotIdentifiable);
    report.readNoise = Quantity::Without(EstimateStatus::NotIdentifiable);
    report.readNoiseElectrons = Quantity::Without(EstimateStatus::NotIdentifiable);
    return;
  }
  report.offset = Quantity::Identified(*offsetDn);
  const double squared = line.intercept + line.slope * *offsetDn;
  if (squared > 0.0)
  {
    report.readNoise = Quantity::Identified(std::sqrt(squared));
    report.readNoiseElectrons = Quantity::Identified(std::sqrt(squared) / line.slope);
  }
  else
  {
    report.readNoise = Quantity::Without(EstimateStatus::NotIdentifiable);
    report.readNoiseElectrons = Quantity::Without(EstimateStatus::NotIdentifiable);
    report.Warn(
      WarningCode::ReadNoiseNotIdentifiable,
      "gain, intercept and offset give a squared read noise of " + Rounded(squared) +
        " DN^2 (expected above 0), which is within their errors. Record more frames, or use --method refined");
  }
}
} // namespace

void
FillNoiseParameters(Report &              report,
                    const PolynomialFit & line,
                    std::optional<double> offsetDn,
                    std::optional<double> darkestDn)
{
  if (!line.isDetermined || !(line.slope > 0.0))
  {
    SetSensorParameters(report, EstimateStatus::Failed);
    report.Warn(WarningCode::VarianceNotAffine,
                line.isDetermined
                  ? "the variance does not rise with the mean (slope " + Rounded(line.slope) +
                      " DN/e-, expected above 0): the frames are not raw, or have too little noise. Record raw "
                      "frames"
                  : "the " + std::to_string(line.pixels) +
                      " pixels of the regression have one intensity. Include dark and bright areas in "
                      "the scene");
    return;
  }
  report.gain = Quantity::Identified(line.slope);
  report.varianceSlope = report.gain;
  report.intercept = Quantity::Identified(line.intercept);
  report.totalIntercept = report.intercept;

  const double lowestOffsetDn = -line.intercept / line.slope; // sigma^2 = 0 there
  FillOffset(report, line, offsetDn);
  if (darkestDn && *darkestDn > lowestOffsetDn)
  {
    const double highest = std::sqrt(line.intercept + line.slope * *darkestDn);
    report.offset.bracket = Interval{ lowestOffsetDn, darkestDn };
    report.readNoise.bracket = Interval{ 0.0, highest };
    report.readNoiseElectrons.bracket = Interval{ 0.0, highest / line.slope };
    if (offsetDn && *offsetDn > *darkestDn)
    {
      report.Warn(WarningCode::OffsetAboveDarkest,
                  "the offset, " + RoundedApart(*offsetDn, *darkestDn) + " DN, is above the darkest level, " +
                    Rounded(*darkestDn) + " DN, because its error is large. Record more flicker or more frames");
    }
  }
}

void
FillFit(Report & report, const FitQuality & quality)
{
  report.fit.reducedChi2 = quality.reducedChi2;
  report.fit.curvature = quality.curvature;
  report.fit.curvatureZ = quality.curvatureZ;
  if (quality.reducedChi2 > LargestReducedChi2)
  {
    SetSensorParameters(report, EstimateStatus::Failed);
    report.Warn(
      WarningCode::VarianceNotAffine,
      "the corrected variance scatters about its line " + RoundedApart(quality.reducedChi2, LargestReducedChi2) +
        " times as much as sampling noise does (expected at most 10): the scene moves, the flicker differs within the "
        "frame, or the frames are not raw. Use --method refined, or raw frames");
  }
  else if (quality.reducedChi2 > 1.5)
  {
    report.Warn(WarningCode::PoorFit,
                "the corrected variance scatters about its line " + RoundedApart(quality.reducedChi2, 1.5) +
                  " times as much as sampling noise does (expected at most 1.5): vibrations, flicker that differs "
                  "within the frame, or moving objects are left in it. Use --method refined");
  }
}

} // namespace sensornoise
