// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/StartingLine.h"

#include "base/Constants.h"
#include "base/Quantiles.h"
#include "single/BandTile.h"
#include "single/Constants.h"
#include "single/ImageNoise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{
namespace
{
struct SamplePosition
{
  float level;
  float roughness;
  float diagonal;
};

std::vector<SamplePosition>
SortedPositions(const std::vector<BandTile> & sample)
{
  std::vector<SamplePosition> positions;
  for (const BandTile & tile : sample)
  {
    for (std::size_t i = 0; i < tile.Positions(); i += InSingle.sortedStride)
    {
      if (std::isfinite(tile.roughness[i]) && std::isfinite(tile.diagonal[i]))
      {
        positions.push_back({ tile.level[i], tile.roughness[i], tile.diagonal[i] });
      }
    }
  }
  std::sort(positions.begin(), positions.end(), [](const auto & a, const auto & b) { return a.level < b.level; });
  return positions;
}

StartingGroup
GroupOf(std::vector<SamplePosition> positions)
{
  const auto half = positions.begin() + static_cast<std::ptrdiff_t>((positions.size() - 1) / 2);
  std::nth_element(
    positions.begin(), half, positions.end(), [](const auto & a, const auto & b) { return a.roughness < b.roughness; });
  std::vector<double> squares;
  double              levels = 0.0;
  for (auto position = positions.begin(); position <= half; ++position)
  {
    squares.push_back(static_cast<double>(position->diagonal));
    levels += static_cast<double>(position->level);
  }
  const double level = levels / static_cast<double>(squares.size());
  return { level, Quantile(squares, 0.5) / (MedianOfNormal * MedianOfNormal) };
}
} // namespace

StartingGroups
MakeStartingGroups(const std::vector<BandTile> & sample)
{
  StartingGroups                    starting;
  const std::vector<SamplePosition> positions = SortedPositions(sample);
  if (positions.size() < InSingle.startingGroups)
  {
    return starting;
  }
  constexpr double outermost = 0.0005; // share of the positions beyond an end, so that no defect is one
  const auto       at = [&](double share) {
    return static_cast<double>(
      positions[static_cast<std::size_t>(share * static_cast<double>(positions.size() - 1))].level);
  };
  starting.low = at(outermost);
  starting.high = at(1.0 - outermost);
  std::vector<double> variances;
  for (std::size_t k = 0; k < InSingle.startingGroups; ++k)
  {
    const auto place = [&](std::size_t group) {
      return positions.begin() + static_cast<std::ptrdiff_t>(group * positions.size() / InSingle.startingGroups);
    };
    starting.groups.push_back(GroupOf({ place(k), place(k + 1) }));
    variances.push_back(starting.groups.back().variance);
  }
  starting.medianVariance = Quantile(variances, 0.5);
  return starting;
}

CentredLine
FitStartingLine(const StartingGroups & groups, const LevelLimits & limits, double originDn, double unitDn)
{
  constexpr double farFromClip = 2.0; // standard deviations
  double           w = 0.0;
  double           wx = 0.0;
  double           wy = 0.0;
  double           wxx = 0.0;
  double           wxy = 0.0;
  std::size_t      used = 0;
  for (const StartingGroup & group : groups.groups)
  {
    const double level = originDn + unitDn * group.level;
    const double variance = unitDn * unitDn * group.variance;
    const double margin = farFromClip * std::sqrt(variance) + limits.stepDn;
    if (!(level - limits.clip.lowDn > margin && limits.clip.highDn - level > margin && variance > 0.0 &&
          variance > InCommon.hiddenVariance * limits.stepDn * limits.stepDn))
    {
      continue;
    }
    const double weight = 1.0 / (group.variance * group.variance);
    w += weight;
    wx += weight * group.level;
    wy += weight * group.variance;
    wxx += weight * group.level * group.level;
    wxy += weight * group.level * group.variance;
    ++used;
  }
  const double     centre = w > 0.0 ? wx / w : 0.0;
  const double     spread = w > 0.0 ? wxx / w - centre * centre : 0.0;
  const double     middle = w > 0.0 ? wy / w : groups.medianVariance;
  constexpr double leastSpread = 1e-6; // of the levels, squared: below, rounding makes the slope
  const double     slope = used >= 2 && spread > leastSpread ? (wxy / w - centre * middle) / spread : 0.0;
  return { originDn + unitDn * centre, unitDn * slope, unitDn * unitDn * middle };
}

} // namespace sensornoise
