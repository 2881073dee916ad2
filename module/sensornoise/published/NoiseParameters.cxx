// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/published/NoiseParameters.h"

#include "sensornoise/base/Text.h"
#include "sensornoise/report/Quantities.h"

#include <cmath>
#include <string>

namespace sensornoise
{

namespace
{
/** Offset and read noise without their brackets. */
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
    report.Warn(WarningCode::ReadNoiseNotIdentifiable,
                "gain, intercept and offset give a squared read noise of " + Rounded(squared) +
                  " DN^2, expected above 0: it is smaller than their errors");
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
                line.isDetermined ? "the variance does not rise with the mean (slope " + Rounded(line.slope) +
                                      " DN/e-, expected above 0): the data are not raw, or hold too little noise"
                                  : "the regression has " + std::to_string(line.pixels) +
                                      " pixels of one intensity; expected pixels of different intensities");
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
                  "the offset " + Rounded(*offsetDn) + " DN is above the darkest level, " + Rounded(*darkestDn) +
                    " DN, which is not possible: its error is larger than that; more " +
                    "frames or more flicker would help");
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
        " times as much as sampling noise does (expected 1, at most 10): the scene moves, the flicker differs "
        "within the frame, or the data are not raw");
  }
  else if (quality.reducedChi2 > 1.5)
  {
    report.Warn(WarningCode::PoorFit,
                "the corrected variance scatters about its line " + Rounded(quality.reducedChi2) +
                  " times as much as sampling noise does (expected 1): vibrations, flicker that differs within the "
                  "frame, or a scene that moves are left in it");
  }
}

} // namespace sensornoise
