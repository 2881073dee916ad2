// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/FrameOffsets.h"

#include "base/Quantiles.h"
#include "base/Significance.h"
#include "series/Constants.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sensornoise
{

namespace
{
/** Levels of the frames without signal, for an assumed offset. */
struct DarkLevels
{
  Eigen::VectorXd stepDn; ///< difference of each frame to the middle of the densest half [DN]
  double          errorDn{ 0.0 };
  double          spread{ 0.0 }; ///< standard deviation of the densest half, in units of the error [1]

  double
  UnitDn() const
  {
    return errorDn * std::max(1.0, spread);
  }
};

DarkLevels
LevelsAbout(double offset, const Eigen::MatrixX2d & changes, const Eigen::Matrix2d & covariance)
{
  const Eigen::Vector2d dark(1.0, offset); // level at the centre, and slope
  DarkLevels            levels;
  levels.errorDn = std::sqrt(dark.dot(covariance * dark));
  levels.stepDn = changes * dark;
  std::vector<double> sorted(levels.stepDn.data(), levels.stepDn.data() + levels.stepDn.size());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = (sorted.size() + 1) / 2;
  const std::size_t begin = FindDensestHalf(sorted);
  levels.stepDn.array() -= sorted[begin + half / 2];
  levels.spread = 0.5 * (sorted[begin + half - 1] - sorted[begin]) / MedianOfNormal / levels.errorDn;
  return levels;
}

/** Returns the levels for the possible offsets: a grid over all, and two finer ones about the best. */
std::vector<DarkLevels>
LevelsOfOffsets(const ValueRange & offsets, const Eigen::MatrixX2d & changes, const Eigen::Matrix2d & covariance)
{
  std::vector<DarkLevels> found;
  double                  low = offsets.lowest;
  double                  high = offsets.highest;
  double                  best = high;
  double                  least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 3; ++round)
  {
    const double step = (high - low) / static_cast<double>(InSeries.offsetsTried);
    for (int i = 0; i <= InSeries.offsetsTried; ++i)
    {
      const double offset = low + step * static_cast<double>(i);
      found.push_back(LevelsAbout(offset, changes, covariance));
      if (found.back().spread < least)
      {
        least = found.back().spread;
        best = offset;
      }
    }
    low = std::max(offsets.lowest, best - 2.0 * step);
    high = std::min(offsets.highest, best + 2.0 * step);
  }
  return found;
}
} // namespace

FrameOffsets
FindFrameOffsets(const OffsetLine & line, const ValueRange & offsets, double leastStepDn)
{
  const Eigen::LLT<Eigen::Matrix2d> factor(line.light);
  if (line.isLevelMotion || !(line.contrast > InSeries.leastContrast) || factor.info() != Eigen::Success ||
      !(offsets.highest > offsets.lowest))
  {
    return {};
  }
  const Eigen::Matrix2d         covariance = factor.solve(Eigen::Matrix2d::Identity());
  const Eigen::MatrixX2d        changes = line.response * covariance;
  const std::vector<DarkLevels> all = LevelsOfOffsets(offsets, changes, covariance);
  double                        least = std::numeric_limits<double>::infinity();
  for (const DarkLevels & levels : all)
  {
    least = std::min(least, levels.spread);
  }
  Eigen::VectorXd smallest =
    Eigen::VectorXd::Constant(changes.rows(), std::numeric_limits<double>::infinity()); // smallest step over the
                                                                                        // offsets that fit
  Eigen::VectorXd far = smallest;
  for (const DarkLevels & levels : all)
  {
    if (levels.spread <= InSeries.likelyOffset * std::max(1.0, least))
    {
      for (Eigen::Index t = 0; t < smallest.size(); ++t)
      {
        smallest(t) = std::abs(levels.stepDn(t)) < std::abs(smallest(t)) ? levels.stepDn(t) : smallest(t);
      }
      far = far.cwiseMin(levels.stepDn.cwiseAbs() / levels.UnitDn());
    }
  }
  FrameOffsets        found;
  std::vector<double> steps;
  for (Eigen::Index t = 0; t < smallest.size(); ++t)
  {
    const double ofSignal = InSeries.leastStepOfChange * std::abs(changes(t, 1) * offsets.highest);
    if (far(t) > Significance.everyPixel && std::abs(smallest(t)) > std::max(leastStepDn, ofSignal))
    {
      found.unlike.push_back(static_cast<std::size_t>(t));
      steps.push_back(smallest(t));
    }
  }
  found.stepDn = steps.empty() ? 0.0 : QuantileOf(steps, 0.5);
  return found;
}

} // namespace sensornoise
