// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "browser/GainPlan.h"

#include "limits/CramerRaoBound.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace sensornoise::browser
{

namespace
{
constexpr double GoalPercent = 1.0; ///< standard error of the gain [%]
constexpr double GoalDn = 1.0;      ///< standard error of the offset [DN]

/** Least variances of gain and offset of two frames. */
struct PlannedVariance
{
  double gainPercent2; ///< [%^2]
  double offsetDn2;    ///< [DN^2]; infinity: the offset is not identifiable
};

PlannedVariance
VarianceOfTwoFrames(const PlannedBurst & burst)
{
  constexpr std::size_t side = 64; // grey values on a grid of side x side pixels, which stand for all pixels
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
  const auto           variance = [fewerPixels](double error) { return error * error * fewerPixels; };
  return { variance(100.0 * limit.gain / burst.gainDnPerElectron), variance(limit.offset) };
}

bool
IsGainKnown(const PlannedBurst & burst)
{
  return VarianceOfTwoFrames(burst).gainPercent2 <= GoalPercent * GoalPercent * (burst.frames - 1.0);
}

bool
IsOffsetKnown(const PlannedBurst & burst)
{
  return VarianceOfTwoFrames(burst).offsetDn2 <= GoalDn * GoalDn * (burst.frames - 1.0);
}

/** Returns the least value of a member between two limits, both above 0, for which \a isEnough(burst) is true. Bisects
 * the logarithm of the value. Returns infinity if \a isEnough(burst) is false at the upper limit. */
template <typename TFunction>
double
LeastOf(PlannedBurst burst, double PlannedBurst::* member, double low, double high, const TFunction & isEnough)
{
  const auto isEnoughAt = [&](double value) {
    burst.*member = value;
    return isEnough(burst);
  };
  if (!isEnoughAt(high))
  {
    return std::numeric_limits<double>::infinity();
  }
  constexpr double enough = 1e-9; // relative
  while (high / low - 1.0 > enough)
  {
    const double middle = std::sqrt(low * high);
    (isEnoughAt(middle) ? high : low) = middle;
  }
  return high;
}
} // namespace

GainPlan
PlanBurst(const PlannedBurst & burst)
{
  if (!(burst.megapixels > 0.0 && burst.frames >= 2.0 && burst.electrons > 0.0 && burst.contrast > 1.0 &&
        burst.flickerSd >= 0.0 && burst.gainDnPerElectron > 0.0 && burst.readNoiseDn >= 0.0))
  {
    throw std::invalid_argument("a value of the plan is out of its range; expected at least 2 frames, a contrast above "
                                "1, and positive numbers");
  }
  constexpr double      leastContrast = 1.0 + 1e-6;
  constexpr double      leastFlickerSd = 1e-9;
  const PlannedVariance variance = VarianceOfTwoFrames(burst);
  const auto            contrastFor = [&burst](bool (*isEnough)(const PlannedBurst &)) {
    return LeastOf(burst, &PlannedBurst::contrast, leastContrast, MostContrast, isEnough);
  };
  return { std::sqrt(variance.gainPercent2 / (burst.frames - 1.0)),
           std::sqrt(variance.offsetDn2 / (burst.frames - 1.0)),
           1.0 + std::ceil(variance.gainPercent2 / (GoalPercent * GoalPercent)),
           1.0 + std::ceil(variance.offsetDn2 / (GoalDn * GoalDn)),
           contrastFor(IsGainKnown),
           contrastFor(IsOffsetKnown),
           LeastOf(burst, &PlannedBurst::flickerSd, leastFlickerSd, MostFlickerSd, IsOffsetKnown) };
}

} // namespace sensornoise::browser
