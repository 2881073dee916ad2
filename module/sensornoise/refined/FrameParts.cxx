// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/refined/FrameParts.h"

#include "sensornoise/pixels/Partition.h"
#include "sensornoise/refined/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sensornoise
{

namespace
{
/** Of the frames of a group at a tile. */
struct GroupSums
{
  double frames{ 0.0 };
  double level{ 0.0 };
  double squares{ 0.0 };
  double expected{ 0.0 };
  double shot{ 0.0 };
  double chance{ 0.0 };
};

std::size_t
GroupOfFrame(Eigen::Index frame, Eigen::Index frames)
{
  const auto quarter = static_cast<std::size_t>(4 * frame / frames);
  return 2 * quarter + static_cast<std::size_t>(frame % 2);
}
} // namespace

std::vector<TileExcess>
MakeFrameParts(const FrameEnergies & energies, const TileLevels & levels, const PartReference & reference)
{
  const VarianceLine &    line = reference.line;
  const Eigen::Index      frames = energies.Frames();
  std::vector<TileExcess> tiles;
  for (Eigen::Index i = 0; i < energies.Tiles(); ++i)
  {
    const Eigen::VectorXd              level = levels.Of(energies.LightDn()(i)).head(frames);
    const double                       least = InRefined.leastWeighedVariance * energies.SquaresDn2().row(i).mean();
    const Eigen::ArrayXd               variance = (line.intercept + line.gain * level.array()).max(least);
    const Eigen::ArrayXd               shot = (line.gain * (level.array() - reference.blackDn)).max(0.0).min(variance);
    const Eigen::VectorXd              expected = energies.ExpectedSquares(variance.matrix());
    const Eigen::VectorXd              ofShot = energies.ExpectedSquares(shot.matrix());
    std::array<GroupSums, FrameGroups> sums;
    for (Eigen::Index t = 0; t < frames; ++t)
    {
      if (energies.LeftShare()(t) > InRefined.leastLeftShare && expected(t) > 0.0)
      {
        GroupSums & own = sums[GroupOfFrame(t, frames)];
        own.frames += 1.0;
        own.level += level(t);
        own.squares += energies.SquaresDn2()(i, t);
        own.expected += expected(t);
        own.shot += ofShot(t);
        own.chance += 2.0 * expected(t) * expected(t) / energies.Pixels()(i);
      }
    }
    for (std::size_t group = 0; group < FrameGroups; ++group)
    {
      const GroupSums & own = sums[group];
      if (own.frames > 0.0)
      {
        TileExcess tile;
        tile.phase = group;
        tile.pixels = own.frames * energies.Pixels()(i);
        tile.levelDn = own.level / own.frames;
        tile.shotFraction = std::clamp(own.shot / own.expected, 0.0, 1.0);
        tile.excess = own.squares / own.expected - 1.0;
        tile.error = std::sqrt(reference.sharedSquares * own.chance) / own.expected;
        tiles.push_back(tile);
      }
    }
  }
  return tiles;
}

} // namespace sensornoise
