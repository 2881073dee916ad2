// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/OffsetLimits.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/Quantiles.h"
#include "refined/GainEstimate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the darkest quantile of the neighbours' means of the usable pixels [DN]. */
double
DarkestNeighbourhood(const ReferenceFrame & frame)
{
  std::vector<double> levels;
  for (const std::size_t p : SamplePixels(frame.usable))
  {
    levels.push_back(frame.neighbourMean[p]);
  }
  return Quantile(levels, InCommon.darkestQuantile);
}
} // namespace

OffsetLimits
LimitsOf(const RefinedResults & found, const GainEstimate & gain, double quantisationDn2)
{
  const VarianceLine & v = gain.line;
  const auto           frames = static_cast<double>(found.scene.frame.frames);
  const double         student = StudentQuantile(0.975, frames - 2.0);
  const double         slopeError = std::sqrt(gain.covariance(0, 0));
  const double         atPivot = v.intercept + v.gain * v.pivotDn;
  const double         slope = v.gain - gain.below - student * slopeError;
  OffsetLimits         limits;
  // The darkest pixels are dark also because of noise and their own offsets. Both are smaller in the means of eight
  // pixels.
  const double darkestDn = found.InDarkestFrame(DarkestNeighbourhood(found.scene.frame));
  const double spreadDn2 = (v.At(darkestDn) / frames + found.variance.pattern.OffsetVarianceDn2()) / 8.0;
  limits.rootDn = v.gain > 0.0 ? std::min(-v.intercept / v.gain, darkestDn) : darkestDn;
  if (slope > 0.0)
  {
    const Eigen::Vector2d pivot(v.pivotDn, 1.0);
    const double          pivotError = std::sqrt(std::max(0.0, pivot.dot(gain.covariance * pivot)));
    limits.lowestDn = std::min(v.pivotDn - (atPivot + student * pivotError) / slope, darkestDn);
  }
  limits.highestDn = darkestDn + Significance.oneTest * std::sqrt(spreadDn2);
  const Eigen::Vector2d design(limits.highestDn, 1.0);
  const double          error = std::sqrt(std::max(0.0, design.dot(gain.covariance * design)));
  limits.largestNoiseDn2 = std::max(0.0, v.intercept + v.gain * limits.highestDn + student * error - quantisationDn2);
  return limits;
}

} // namespace sensornoise
