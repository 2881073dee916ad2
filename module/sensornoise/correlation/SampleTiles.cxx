/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "sensornoise/correlation/SampleTiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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
    std::min(SampleTiles::MostPixels, SampleTiles::MostValues / std::max<std::size_t>(1, tiles.frames)) /
    tiles.Pixels();
  if (columns * rows > most)
  {
    const double ratio = static_cast<double>(columns) / static_cast<double>(rows);
    const auto   wanted = static_cast<std::size_t>(std::sqrt(static_cast<double>(most) * ratio));
    columns = std::clamp<std::size_t>(wanted, 1, std::min(columns, most));
    rows = std::min(rows, most / columns);
  }
  for (std::size_t j = 0; j < rows; ++j)
  {
    for (std::size_t i = 0; i < columns; ++i)
    {
      // The middle of its share of the frame.
      tiles.origins.push_back({ ((2 * i + 1) * geometry.width / columns - tiles.side) / 2,
                                ((2 * j + 1) * geometry.height / rows - tiles.side) / 2 });
    }
  }
  return tiles;
}

} // namespace sensornoise
