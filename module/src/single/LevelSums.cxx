// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/LevelSums.h"

#include "base/Constants.h"
#include "base/Quantiles.h"
#include "single/Constants.h"
#include "single/ImageNoise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

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
  constexpr double outermost =
    0.0005; // fraction of the positions beyond either end, so that no defective pixel is an end
  const auto at = [&](double fraction) {
    return static_cast<double>(
      positions[static_cast<std::size_t>(fraction * static_cast<double>(positions.size() - 1))].level);
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
  constexpr double leastSpread = 1e-6; // least variance of the levels: below it, rounding determines the slope
  const double     slope = used >= 2 && spread > leastSpread ? (wxy / w - centre * middle) / spread : 0.0;
  return { originDn + unitDn * centre, unitDn * slope, unitDn * unitDn * middle };
}

namespace
{
/** Mean of z^2 of standard normal numbers below \a limit in size. */
double
MeanSquareBelow(double limit)
{
  constexpr double rootOf2 = 1.4142135623730951;
  constexpr double twoOverRootOf2Pi = 0.79788456080286536;
  return 1.0 - twoOverRootOf2Pi * limit * std::exp(-0.5 * limit * limit) / std::erf(limit / rootOf2);
}
} // namespace

void
LevelSums::Add(const BandTile & tile, const LevelGrid & grid)
{
  sets.resize(grid.variance.size());
  const auto  largestRoughness = static_cast<float>(InSingle.largestRoughness);
  const auto  limit = static_cast<float>(Significance.oneTest * Significance.oneTest);
  std::size_t found = 0;
  for (std::size_t i = 0; i < tile.Positions(); ++i)
  {
    const float roughness = tile.roughness[i];
    const auto  k = grid.SetOf(tile.level[i]);
    const float variance = grid.variance[k];
    found += roughness >= 0.0F ? 1 : 0;
    if (!(roughness < largestRoughness * variance))
    {
      continue;
    }
    Set &       set = sets[k];
    const float perVariance = 1.0F / variance;
    const float squares[]{ tile.diagonal[i] * perVariance,
                           tile.horizontal[i] * perVariance,
                           tile.vertical[i] * perVariance };
    set.positions += 1.0;
    set.level += static_cast<double>(tile.level[i]);
    const bool isIn[]{ squares[0] < limit, squares[1] < limit, squares[2] < limit };
    set.diagonals += isIn[0] ? 1.0 : 0.0;
    set.diagonalSquares += static_cast<double>(isIn[0] ? squares[0] : 0.0F);
    set.sides += (isIn[1] ? 1.0 : 0.0) + (isIn[2] ? 1.0 : 0.0);
    set.sideSquares += static_cast<double>((isIn[1] ? squares[1] : 0.0F) + (isIn[2] ? squares[2] : 0.0F));
  }
  finite += static_cast<double>(found);
  even = 0.0;
  for (const Set & set : sets)
  {
    even += set.positions;
  }
}

void
LevelSums::Add(const LevelSums & other)
{
  sets.resize(other.sets.size());
  for (std::size_t k = 0; k < sets.size(); ++k)
  {
    sets[k].positions += other.sets[k].positions;
    sets[k].level += other.sets[k].level;
    sets[k].diagonals += other.sets[k].diagonals;
    sets[k].diagonalSquares += other.sets[k].diagonalSquares;
    sets[k].sides += other.sets[k].sides;
    sets[k].sideSquares += other.sets[k].sideSquares;
  }
  finite += other.finite;
  even += other.even;
}

double
VarianceOfTruncated(double square, double limit)
{
  // The mean square below the limit rises with the variance, to a third of the limit's square.
  constexpr int steps = 60;
  double        low = 1e-3 * limit;
  double        high = 1e3 * limit;
  if (!(square < high * high * MeanSquareBelow(limit / high)))
  {
    return std::numeric_limits<double>::infinity();
  }
  for (int i = 0; i < steps; ++i)
  {
    const double middle = std::sqrt(low * high);
    (middle * middle * MeanSquareBelow(limit / middle) < square ? low : high) = middle;
  }
  return low * high;
}

std::vector<LevelSet>
MakeLevelSets(const LevelSums & sums, const LevelGrid & grid, DetailBand band, double originDn, double unitDn)
{
  std::vector<LevelSet> levelSets;
  for (std::size_t k = 0; k < sums.sets.size(); ++k)
  {
    const LevelSums::Set & set = sums.sets[k];
    const double           number = band == DetailBand::Diagonal ? set.diagonals : set.sides;
    const double           squares = band == DetailBand::Diagonal ? set.diagonalSquares : set.sideSquares;
    if (!(number > 0.0))
    {
      levelSets.push_back({ originDn + unitDn * grid.CentreOf(k), 0.0, 0.0 });
      continue;
    }
    const double relative = VarianceOfTruncated(squares / number, Significance.oneTest);
    const double all = band == DetailBand::Diagonal ? set.positions : 2.0 * set.positions;
    levelSets.push_back({ originDn + unitDn * set.level / set.positions,
                          unitDn * unitDn * static_cast<double>(grid.variance[k]) * relative,
                          std::isfinite(relative) ? all : 0.0 });
  }
  return levelSets;
}

} // namespace sensornoise
