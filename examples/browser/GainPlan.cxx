// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "browser/GainPlan.h"

#include "limits/CramerRaoBound.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace sensornoise::browser
{

GainPlan
PlanBurst(const PlannedBurst & burst)
{
  if (!(burst.megapixels > 0.0 && burst.frames >= 2.0 && burst.electrons > 0.0 && burst.contrast > 1.0 &&
        burst.flickerSd >= 0.0 && burst.gainDnPerElectron > 0.0 && burst.readNoiseDn >= 0.0))
  {
    throw std::invalid_argument("a value of the plan is out of its range; expected at least 2 frames, a contrast above "
                                "1, and positive numbers");
  }
  constexpr std::size_t side = 64; // grey values on a grid of side x side pixels, which stand for all pixels
  constexpr double      goalPercent = 1.0;
  constexpr double      goalDn = 1.0;
  constexpr double      roundingDn2 = 1.0 / 12.0; // variance of rounding to whole numbers
  constexpr std::size_t twoFrames = 2;
  std::vector<double>   levelsDn(side * side);
  for (std::size_t i = 0; i < levelsDn.size(); ++i)
  {
    const double place = static_cast<double>(i) / static_cast<double>(levelsDn.size() - 1);
    const double dark = burst.electrons / burst.contrast;
    levelsDn[i] = burst.gainDnPerElectron * (dark + place * (burst.electrons - dark));
  }
  const PrecisionLimit limit = ComputePrecisionLimit({ levelsDn.data(),
                                                       nullptr,
                                                       side,
                                                       side,
                                                       burst.gainDnPerElectron,
                                                       0.0,
                                                       burst.readNoiseDn * burst.readNoiseDn + roundingDn2,
                                                       1.0,
                                                       twoFrames,
                                                       burst.flickerSd });
  const double         fewerPixels = static_cast<double>(levelsDn.size()) / (burst.megapixels * 1e6);
  const auto           variance = [fewerPixels](double ofTwoFrames) { return ofTwoFrames * ofTwoFrames * fewerPixels; };
  const double         gain = variance(100.0 * limit.gain / burst.gainDnPerElectron);
  const double         offset = variance(limit.offset);
  return { std::sqrt(gain / (burst.frames - 1.0)),
           std::sqrt(offset / (burst.frames - 1.0)),
           1.0 + std::ceil(gain / (goalPercent * goalPercent)),
           1.0 + std::ceil(offset / (goalDn * goalDn)) };
}

} // namespace sensornoise::browser
