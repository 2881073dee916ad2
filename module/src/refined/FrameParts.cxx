// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/FrameParts.h"

#include "pixels/PartTiles.h"
#include "refined/Constants.h"

#include <algorithm>
#include <array>

namespace sensornoise
{

namespace
{
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
    const Eigen::VectorXd             level = levels.Of(energies.LightDn()(i)).head(frames);
    const Eigen::ArrayXd              variance = VariancesOfFrames(energies, levels, line, i);
    const Eigen::ArrayXd              shot = (line.gain * (level.array() - reference.blackDn)).max(0.0).min(variance);
    const Eigen::VectorXd             expected = energies.ExpectedSquares(variance.matrix());
    const Eigen::VectorXd             ofShot = energies.ExpectedSquares(shot.matrix());
    const double                      pixels = energies.Pixels()(i);
    std::array<PartSums, FrameGroups> sums;
    for (Eigen::Index t = 0; t < frames; ++t)
    {
      if (energies.RemainingFraction()(t) > InRefined.leastRemainingFraction && expected(t) > 0.0)
      {
        sums[GroupOfFrame(t, frames)] += { pixels,
                                           pixels * level(t),
                                           pixels * energies.SquaresDn2()(i, t),
                                           pixels * expected(t),
                                           pixels * std::clamp(ofShot(t), 0.0, expected(t)),
                                           2.0 * pixels * expected(t) * expected(t) };
      }
    }
    for (std::size_t group = 0; group < FrameGroups; ++group)
    {
      if (sums[group].pixels > 0.0)
      {
        tiles.push_back(sums[group].Excess(reference.varianceInflation));
        tiles.back().phase = group;
      }
    }
  }
  return tiles;
}

} // namespace sensornoise
