// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/NoiseParameters.h"

#include <cmath>
#include <optional>

namespace sensornoise
{

namespace
{
/** Fills offset and read noise without their bounds. */
void
FillOffset(NoiseParameters & found)
{
  found.offset = found.readNoise = found.readNoiseElectrons = Quantity::Without(EstimateStatus::NotIdentifiable);
  if (!found.offsetDn)
  {
    return;
  }
  found.offset = Quantity::Identified(*found.offsetDn);
  found.squaredReadNoiseDn2 = found.line.intercept + found.line.slope * *found.offsetDn;
  if (found.squaredReadNoiseDn2 > 0.0)
  {
    found.readNoise = Quantity::Identified(std::sqrt(found.squaredReadNoiseDn2));
    found.readNoiseElectrons = Quantity::Identified(std::sqrt(found.squaredReadNoiseDn2) / found.line.slope);
  }
}

void
FillBounds(NoiseParameters & found)
{
  if (found.HasBounds())
  {
    const double highest = std::sqrt(found.line.intercept + found.line.slope * *found.darkestDn);
    found.offset.bracket = Interval{ found.LowestOffsetDn(), found.darkestDn };
    found.readNoise.bracket = Interval{ 0.0, highest };
    found.readNoiseElectrons.bracket = Interval{ 0.0, highest / found.line.slope };
  }
}
} // namespace

NoiseParameters
EstimateParameters(const PolynomialFit &             line,
                   std::optional<double>             offsetDn,
                   std::optional<double>             darkestDn,
                   const std::optional<FitQuality> & quality)
{
  NoiseParameters found;
  found.line = line;
  found.quality = quality;
  found.offsetDn = offsetDn;
  found.darkestDn = darkestDn;
  found.verdict = !line.isDetermined    ? LineVerdict::OneIntensity
                  : !(line.slope > 0.0) ? LineVerdict::NotRising
                                        : LineVerdict::Identified;
  if (found.verdict == LineVerdict::Identified)
  {
    FillOffset(found);
    FillBounds(found);
    found.gain = Quantity::Identified(line.slope);
    found.intercept = Quantity::Identified(line.intercept);
  }
  if (found.IsScattered())
  {
    found.gain = found.intercept = found.offset = found.readNoise = found.readNoiseElectrons =
      Quantity::Without(EstimateStatus::Failed);
  }
  return found;
}

} // namespace sensornoise
