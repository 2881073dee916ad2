// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/SampleTiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace sensornoise
{

SampleTiles
MakeSampleTiles(const FrameGeometry & geometry, std::size_t frames)
{
  SampleTiles tiles;
  tiles.frames = std::min(frames, SampleTiles::MostFrames);
  tiles.side = SampleTiles::Side;
  if ((geometry.width / tiles.side) * (geometry.height / tiles.side) < SampleTiles::EnoughTiles)
  {
    tiles.side = SampleTiles::SmallSide;
  }
  std::size_t       columns = geometry.width / tiles.side;
  std::size_t       rows = geometry.height / tiles.side;
  const std::size_t most =
    std::min(SampleTiles::MostPixels,
             SampleTiles::MostValuesOf(geometry.Pixels()) / std::max<std::size_t>(1, tiles.frames)) /
    tiles.Pixels();
  if (columns * rows > most)
  {
    const double ratio = static_cast<double>(columns) / static_cast<double>(rows);
    const auto   square = static_cast<std::size_t>(std::sqrt(static_cast<double>(most) * ratio));
    const auto   fewer = std::clamp<std::size_t>(square, 1, std::min(columns, most));
    const auto   more = std::min(fewer + 1, std::min(columns, most));
    const auto   rowsOf = [rows, most](std::size_t across) { return std::min(rows, most / across); };
    columns = more * rowsOf(more) > fewer * rowsOf(fewer) ? more : fewer;
    rows = rowsOf(columns);
  }
  for (std::size_t j = 0; j < rows; ++j)
  {
    for (std::size_t i = 0; i < columns; ++i)
    {
      // The tile lies in the middle of its part of the frame.
      tiles.origins.push_back({ ((2 * i + 1) * geometry.width / columns - tiles.side) / 2,
                                ((2 * j + 1) * geometry.height / rows - tiles.side) / 2 });
    }
  }
  return tiles;
}

std::vector<std::vector<std::size_t>>
TilesInLine(const SampleTiles & tiles, LineAxis axis)
{
  std::map<std::size_t, std::vector<std::size_t>> lines;
  for (std::size_t i = 0; i < tiles.origins.size(); ++i)
  {
    lines[axis == LineAxis::Rows ? tiles.origins[i].y : tiles.origins[i].x].push_back(i);
  }
  std::vector<std::vector<std::size_t>> groups;
  groups.reserve(lines.size());
  for (auto & line : lines)
  {
    groups.push_back(std::move(line.second));
  }
  return groups;
}

} // namespace sensornoise
