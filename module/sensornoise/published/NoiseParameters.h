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
#ifndef sensornoise_published_NoiseParameters_h
#define sensornoise_published_NoiseParameters_h

#include "sensornoise/base/PolynomialFit.h"
#include "sensornoise/report/Quantities.h"
#include "sensornoise/report/Report.h"

#include <cmath>
#include <optional>
#include <string>

namespace sensornoise
{

/** Fills gain, intercept, offset and read noise from the line through the corrected variance, section 3.3 of
 * Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035): g is the slope, sigma^2 - g mu the intercept, and
 * sigma^2 = intercept + g mu once mu is known.
 *
 * \a offsetDn is mu where the flicker identifies it, else null: then offset and read noise are not-identifiable, with
 * the bracket that sigma^2 >= 0 and flux >= 0 leave, -intercept/g <= mu <= \a darkestDn. A gain that is not positive
 * contradicts the model: everything is failed, with the warning `variance-not-affine`.
 *
 * Nothing is removed for the codes: intercept and total intercept are the same, as in the paper. */
inline void
FillNoiseParameters(Report &              report,
                    const PolynomialFit & line,
                    std::optional<double> offsetDn,
                    std::optional<double> darkestDn)
{
  if (!line.isDetermined || !(line.slope > 0.0))
  {
    SetSensorParameters(report, EstimateStatus::Failed);
    report.Warn("variance-not-affine",
                line.isDetermined ? "the variance does not rise with the mean (slope " + std::to_string(line.slope) +
                                      " DN/e-, expected above 0): the data are not raw, or hold too little noise"
                                  : "the regression has " + std::to_string(line.pixels) +
                                      " pixels of one intensity; expected pixels of different intensities");
    return;
  }
  report.gain = Quantity::Identified(line.slope, "DN/e-");
  report.intercept = Quantity::Identified(line.intercept, "DN^2");
  report.totalIntercept = report.intercept;

  const double lowestOffsetDn = -line.intercept / line.slope; // sigma^2 = 0 there
  if (offsetDn)
  {
    report.offset = Quantity::Identified(*offsetDn, "DN");
    const double squared = line.intercept + line.slope * *offsetDn;
    if (squared > 0.0)
    {
      report.readNoise = Quantity::Identified(std::sqrt(squared), "DN");
      report.readNoiseElectrons = Quantity::Identified(std::sqrt(squared) / line.slope, "e-");
    }
    else
    {
      report.readNoise = Quantity::Without(EstimateStatus::NotIdentifiable, "DN");
      report.readNoiseElectrons = Quantity::Without(EstimateStatus::NotIdentifiable, "e-");
      report.Warn("read-noise-not-identifiable",
                  "gain, intercept and offset give a squared read noise of " + std::to_string(squared) +
                    " DN^2, expected above 0: it is smaller than their errors");
    }
  }
  else
  {
    report.offset = Quantity::Without(EstimateStatus::NotIdentifiable, "DN");
    report.readNoise = Quantity::Without(EstimateStatus::NotIdentifiable, "DN");
    report.readNoiseElectrons = Quantity::Without(EstimateStatus::NotIdentifiable, "e-");
  }
  if (darkestDn && *darkestDn > lowestOffsetDn)
  {
    const double highest = std::sqrt(line.intercept + line.slope * *darkestDn);
    report.offset.bracket = Interval{ lowestOffsetDn, darkestDn };
    report.readNoise.bracket = Interval{ 0.0, highest };
    report.readNoiseElectrons.bracket = Interval{ 0.0, highest / line.slope };
    if (offsetDn && *offsetDn > *darkestDn)
    {
      report.Warn("offset-above-darkest",
                  "the offset " + std::to_string(*offsetDn) + " DN is above the darkest level, " +
                    std::to_string(*darkestDn) + " DN, which is not possible: its error is larger than that; more " +
                    "frames or more flicker would help");
    }
  }
}

/** A line that the corrected variance leaves by more than this many times its sampling noise is no line. */
inline constexpr double LargestReducedChi2 = 10.0;

/** Files how well the line fits; a gross misfit fails every parameter, with the warning `variance-not-affine`. */
inline void
FillFit(Report & report, const FitQuality & quality)
{
  report.fit.reducedChi2 = quality.reducedChi2;
  report.fit.curvature = quality.curvature;
  report.fit.curvatureZ = quality.curvatureZ;
  if (quality.reducedChi2 > LargestReducedChi2)
  {
    SetSensorParameters(report, EstimateStatus::Failed);
    report.Warn(
      "variance-not-affine",
      "the corrected variance scatters about its line " + std::to_string(quality.reducedChi2) +
        " times as much as sampling noise does (expected 1, at most 10): the scene moves, the flicker differs "
        "within the frame, or the data are not raw");
  }
  else if (quality.reducedChi2 > 1.5)
  {
    report.Warn("poor-fit",
                "the corrected variance scatters about its line " + std::to_string(quality.reducedChi2) +
                  " times as much as sampling noise does (expected 1): vibrations, flicker that differs within the "
                  "frame, or a scene that moves are left in it");
  }
}

} // namespace sensornoise

#endif
