// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/NarrowSums.h"

#include "base/Quantiles.h"
#include "pixels/Constants.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

namespace
{
/** Returns the largest power of 2, at most TemporalBasis::Unit, whose sums are within 2^31 for pixels with the sum of
 * squares \a squaresDn2 about a whole number near the mean. The rounding lengthens a series by half the square root of
 * the number of \a frames at most. */
double
LargestUnit(double squaresDn2, double frames)
{
  constexpr double most = 2147483647.0;
  const double     norm = most / std::sqrt(squaresDn2) - 0.5 * std::sqrt(frames) - 1.0;
  return norm < 1.0 ? 0.0 : std::min(TemporalBasis::Unit, std::exp2(std::floor(std::log2(norm))));
}
} // namespace

std::optional<double>
UnitOfNarrowSums(const ReferenceFrame & frame, const InitialNoiseModel & model, const ParallelFor & parallelFor)
{
  const auto       frames = static_cast<double>(frame.frames);
  const auto       isUsable = [&frame](std::size_t p) { return frame.usable[p] != 0; };
  const auto       varianceOf = [&frame](std::size_t p) { return frame.variance[p]; };
  const ValueRange variances = RangeOverPixels(frame.usable.size(), parallelFor, isUsable, varianceOf);
  if (variances.values == 0)
  {
    return std::nullopt;
  }
  const auto sums =
    SumOverBlocks<1>(frame.usable.size(), parallelFor, [&](std::size_t p, std::array<double, 1> & ratios) {
      ratios[0] += isUsable(p) ? frame.variance[p] / model.NoiseVariance(frame.mean[p]) : 0.0;
    });
  const auto   pixels = static_cast<double>(variances.values);
  const double unit = LargestUnit((frames - 1.0) * variances.highest + frames, frames);
  // The error of a rounded number is uniform, with the variance 1/12.
  const double left = (frames - 1.0) * sums[0] / pixels / (12.0 * unit * unit);
  const double standardError = std::sqrt(2.0 / (frames * pixels));
  return left <= InPixels.largestRoundingError * standardError ? std::optional(unit) : std::nullopt;
}

} // namespace sensornoise
