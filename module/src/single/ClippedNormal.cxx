// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/ClippedNormal.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{
namespace
{
/** Standard deviations from a clip level beyond which clipping changes no digit of the moments [1]: 1e-15 is cut off.
 */
constexpr double NoClipping = 8.0;

double
NormalDensity(double z)
{
  constexpr double rootOf2Pi = 2.5066282746310002;
  return std::exp(-0.5 * z * z) / rootOf2Pi;
}

double
NormalTail(double z)
{
  constexpr double rootOf2 = 1.4142135623730951;
  return 0.5 * std::erfc(z / rootOf2);
}
} // namespace

ClippedMoments
MomentsOfClipped(double meanDn, double sdDn, const ClipLevels & levels)
{
  // Beyond it the densities are 0, and an infinite level must not be multiplied with that.
  constexpr double farthest = 40.0;
  const double     low = std::clamp((levels.lowDn - meanDn) / sdDn, -farthest, farthest);
  const double     high = std::clamp((levels.highDn - meanDn) / sdDn, -farthest, farthest);
  if (low < -NoClipping && high > NoClipping)
  {
    return { meanDn, sdDn * sdDn, 1.0 };
  }
  const double below = NormalTail(-low);
  const double above = NormalTail(high);
  const double inside = 1.0 - below - above;
  const double densityLow = NormalDensity(low);
  const double densityHigh = NormalDensity(high);
  // In standard deviations from the mean before clipping.
  const double first = densityLow - densityHigh + low * below + high * above;
  const double second = inside + low * densityLow - high * densityHigh + low * low * below + high * high * above;
  return { meanDn + sdDn * first, sdDn * sdDn * std::max(0.0, second - first * first), std::max(0.0, inside) };
}

ClippedMoments
ClippedAtMean(double clippedMeanDn, const CentredLine & line, const ClipLevels & levels, double leastVarianceDn2)
{
  const auto sdAt = [&](double level) { return std::sqrt(std::max(line.At(level), leastVarianceDn2)); };
  // The mean of clipped values rises with the mean before clipping, by the probability of a value in between.
  constexpr int    steps = 60;
  constexpr double leastRise = 0.1;
  constexpr double enough = 1e-9; // standard deviations
  constexpr double farthest = 3.0;
  double           level = clippedMeanDn;
  ClippedMoments   moments{};
  for (int i = 0; i < steps; ++i)
  {
    const double sd = sdAt(level);
    moments = MomentsOfClipped(level, sd, levels);
    const double missing = clippedMeanDn - moments.meanDn;
    if (std::abs(missing) <= enough * sd)
    {
      break;
    }
    level = std::clamp(level + missing / std::max(moments.unclipped, leastRise),
                       levels.lowDn - farthest * sd,
                       levels.highDn + farthest * sd);
  }
  moments.varianceDn2 = std::max(moments.varianceDn2, leastVarianceDn2);
  return moments;
}

} // namespace sensornoise
