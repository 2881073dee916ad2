// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef BurstChunks_h
#define BurstChunks_h

#include "browser/Burst.h"
#include "browser/BurstMemory.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise::browser
{

/** Reads the frames of a pass in chunks. function(frames, count) gets each. */
template <typename TPixel, typename TFunction>
void
ForChunks(const Burst & burst, unsigned int pass, const BurstProgress & progress, TFunction function)
{
  const std::size_t   most = FramesPerChunk(burst);
  std::vector<TPixel> frames(most * burst.geometry.Pixels());
  for (std::size_t first = 0; first < burst.frames; first += most)
  {
    progress(pass, static_cast<double>(first) / static_cast<double>(burst.frames));
    const std::size_t count = std::min(most, burst.frames - first);
    burst.read(first, count, frames.data());
    function(frames.data(), count);
  }
}

} // namespace sensornoise::browser

#endif
