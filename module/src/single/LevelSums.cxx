// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/LevelSums.h"

#include "single/BandTile.h"
#include "single/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sensornoise
{
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
  const auto  last = static_cast<float>(sets.size() - 1);
  const auto  low = static_cast<float>(grid.low);
  const auto  perLevel = static_cast<float>(grid.perLevel);
  const auto  largestRoughness = static_cast<float>(InSingle.largestRoughness);
  const auto  limit = static_cast<float>(InSingle.largestDetail * InSingle.largestDetail);
  std::size_t found = 0;
  for (std::size_t i = 0; i < tile.Positions(); ++i)
  {
    const float roughness = tile.roughness[i];
    const float place = std::min(std::max(0.0F, (tile.level[i] - low) * perLevel), last);
    const auto  k = static_cast<std::size_t>(place); // of NaN, std::max makes 0
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
    const double relative = VarianceOfTruncated(squares / number, InSingle.largestDetail);
    const double all = band == DetailBand::Diagonal ? set.positions : 2.0 * set.positions;
    levelSets.push_back({ originDn + unitDn * set.level / set.positions,
                          unitDn * unitDn * static_cast<double>(grid.variance[k]) * relative,
                          std::isfinite(relative) ? all : 0.0 });
  }
  return levelSets;
}

} // namespace sensornoise
