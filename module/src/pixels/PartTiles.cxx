// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/GainByParts.h"

#include "base/Constants.h"
#include "pixels/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sensornoise
{

namespace
{
std::size_t
Along(double place, std::size_t parts)
{
  return std::min(parts - 1, static_cast<std::size_t>(std::max(0.0, place) * static_cast<double>(parts)));
}

std::string
NameOfPhase(std::size_t part, std::size_t period)
{
  return "column " + std::to_string(part % period) + ", row " + std::to_string(part / period) + " of " +
         std::to_string(period) + " x " + std::to_string(period);
}
} // namespace

std::size_t
PartOf(Partition partition, double x, double y, std::size_t phase)
{
  const std::size_t column = phase % LargestPeriod;
  const std::size_t row = phase / LargestPeriod;
  switch (partition)
  {
    case Partition::LeftRight:
      return Along(x, 2);
    case Partition::UpperLower:
      return Along(y, 2);
    case Partition::Quadrants:
      return 2 * Along(y, 2) + Along(x, 2);
    case Partition::Blocks:
    case Partition::SmoothField:
      return BlocksAcross * Along(y, BlocksAcross) + Along(x, BlocksAcross);
    case Partition::Columns2:
      return column % 2;
    case Partition::Rows2:
      return row % 2;
    case Partition::Phases2:
      return 2 * (row % 2) + column % 2;
    case Partition::Columns4:
      return column;
    case Partition::Rows4:
      return row;
    case Partition::FrameHalves:
      return phase / 4;
    case Partition::FrameQuarters:
      return phase / 2;
    case Partition::FrameParities:
      return phase % 2;
    case Partition::Phases4:
      break;
  }
  return phase;
}

std::string
NameOfPart(Partition partition, std::size_t part)
{
  switch (partition)
  {
    case Partition::LeftRight:
      return part == 0 ? "left half" : "right half";
    case Partition::UpperLower:
      return part == 0 ? "upper half" : "lower half";
    case Partition::Quadrants:
      return std::string(part < 2 ? "upper " : "lower ") + (part % 2 == 0 ? "left" : "right");
    case Partition::Blocks:
    case Partition::SmoothField:
      return "block column " + std::to_string(part % BlocksAcross) + ", row " + std::to_string(part / BlocksAcross);
    case Partition::Columns2:
      return part == 0 ? "even columns" : "odd columns";
    case Partition::Rows2:
      return part == 0 ? "even rows" : "odd rows";
    case Partition::Phases2:
      return NameOfPhase(part, 2);
    case Partition::Columns4:
      return "column " + std::to_string(part) + " of 4";
    case Partition::Rows4:
      return "row " + std::to_string(part) + " of 4";
    case Partition::FrameHalves:
      return part == 0 ? "first half of the frames" : "last half of the frames";
    case Partition::FrameQuarters:
      return "quarter " + std::to_string(part + 1) + " of the frames";
    case Partition::FrameParities:
      return part == 0 ? "even frames" : "odd frames";
    case Partition::Phases4:
      break;
  }
  return NameOfPhase(part, LargestPeriod);
}

namespace
{
constexpr std::size_t Phases = LargestPeriod * LargestPeriod;

/** Returns the side of a tile, a multiple of the largest period [pixel]. */
std::size_t
SideOfTile(const FrameGeometry & geometry)
{
  const std::size_t side = geometry.Pixels() < InPattern.largeFramePixels ? InPattern.smallTileSide : InPixels.tileSide;
  const std::size_t longest = std::max(geometry.width, geometry.height);
  return side * std::max<std::size_t>(1, (longest + InParts.mostTiles * side - 1) / (InParts.mostTiles * side));
}

void
SumTile(const VarianceData &           data,
        const FrameGeometry &          geometry,
        const PartReference &          reference,
        std::size_t                    left,
        std::size_t                    top,
        std::size_t                    side,
        std::array<PartSums, Phases> & sums)
{
  const VarianceLine & line = reference.line;
  for (std::size_t y = top; y < std::min(top + side, geometry.height); ++y)
  {
    for (std::size_t x = left; x < std::min(left + side, geometry.width); ++x)
    {
      const std::size_t p = y * geometry.width + x;
      const double      expected = line.At(data.mean[p]);
      if (data.mask[p] != 0 && data.variance[p] < InParts.largestRatio * expected)
      {
        PartSums & own = sums[LargestPeriod * (y % LargestPeriod) + x % LargestPeriod];
        own.pixels += 1.0;
        own.level += data.mean[p];
        own.variance += data.variance[p];
        own.expected += expected;
        own.shot += std::clamp(line.gain * (data.mean[p] - reference.blackDn), 0.0, expected);
        own.chance += line.SamplingVariance(data.dof[p], expected) + line.noiseDispersionDn4;
      }
    }
  }
}

/** Returns the excess of each phase in larger tiles. A larger tile joins several tiles of \a side pixels; \a across is
 * the number of tiles in a row of the frame. Larger tiles suffice because phases do not differ from place to place, and
 * each tile has 16 of them. */
std::vector<TileExcess>
PhasesOf(const std::vector<std::array<PartSums, Phases>> & sums,
         std::size_t                                       across,
         std::size_t                                       side,
         const FrameGeometry &                             geometry,
         double                                            varianceInflation)
{
  const std::size_t down = sums.size() / across;
  const std::size_t together = (std::max(across, down) + InParts.mostPhaseTiles - 1) / InParts.mostPhaseTiles;
  const std::size_t largeAcross = (across + together - 1) / together;
  const std::size_t largeDown = (down + together - 1) / together;
  std::vector<std::array<PartSums, Phases>> large(largeAcross * largeDown);
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    auto & own = large[i / across / together * largeAcross + i % across / together];
    for (std::size_t phase = 0; phase < Phases; ++phase)
    {
      own[phase] += sums[i][phase];
    }
  }
  const auto              largeSide = static_cast<double>(side * together);
  std::vector<TileExcess> phases;
  for (std::size_t i = 0; i < large.size(); ++i)
  {
    for (std::size_t phase = 0; phase < Phases; ++phase)
    {
      if (large[i][phase].pixels >= 1.0)
      {
        phases.push_back(large[i][phase].Excess(varianceInflation));
        const double left = static_cast<double>(i % largeAcross) + 0.5;
        const double top = static_cast<double>(i / largeAcross) + 0.5;
        phases.back().x = std::min(1.0, left * largeSide / static_cast<double>(geometry.width));
        phases.back().y = std::min(1.0, top * largeSide / static_cast<double>(geometry.height));
        phases.back().phase = phase;
      }
    }
  }
  return phases;
}
} // namespace

PartSums &
PartSums::operator+=(const PartSums & other)
{
  pixels += other.pixels;
  level += other.level;
  variance += other.variance;
  expected += other.expected;
  shot += other.shot;
  chance += other.chance;
  return *this;
}

TileExcess
PartSums::Excess(double varianceInflation) const
{
  TileExcess tile;
  tile.pixels = pixels;
  tile.levelDn = level / pixels;
  tile.shotFraction = shot / expected;
  tile.excess = variance / expected - 1.0;
  tile.error = std::sqrt(varianceInflation * chance) / expected;
  return tile;
}

PartTiles
MakePartTiles(const VarianceData &  data,
              const FrameGeometry & geometry,
              const PartReference & reference,
              const ParallelFor &   parallelFor)
{
  const std::size_t                         side = SideOfTile(geometry);
  const std::size_t                         across = (geometry.width + side - 1) / side;
  const std::size_t                         down = (geometry.height + side - 1) / side;
  std::vector<std::array<PartSums, Phases>> sums(across * down);
  parallelFor(down, [&](std::size_t row) {
    for (std::size_t column = 0; column < across; ++column)
    {
      SumTile(data, geometry, reference, column * side, row * side, side, sums[row * across + column]);
    }
  });
  PartTiles tiles;
  tiles.phases = PhasesOf(sums, across, side, geometry, reference.varianceInflation);
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    const double x = (static_cast<double>((i % across) * side) + 0.5 * static_cast<double>(side)) /
                     static_cast<double>(geometry.width);
    const double y = (static_cast<double>((i / across) * side) + 0.5 * static_cast<double>(side)) /
                     static_cast<double>(geometry.height);
    PartSums all;
    for (const PartSums & phase : sums[i])
    {
      all += phase;
    }
    if (all.pixels >= InCommon.leastCoveredFraction * static_cast<double>(side * side))
    {
      tiles.places.push_back(all.Excess(reference.varianceInflation));
      tiles.places.back().x = std::min(1.0, x);
      tiles.places.back().y = std::min(1.0, y);
    }
  }
  return tiles;
}

} // namespace sensornoise
