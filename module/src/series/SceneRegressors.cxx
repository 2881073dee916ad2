// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/SceneRegressors.h"

#include "scene/OutlierPixels.h"
#include "series/ShiftInstruments.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

FrameRegressors
MakeSceneRegressors(const StaticScene & scene, const ParallelFor & parallelFor)
{
  const std::vector<std::uint8_t> unexplained = FindOutlierPixels(scene.frame, scene.model, parallelFor);
  const std::size_t               pixels = unexplained.size();
  std::vector<std::uint8_t>       take(pixels);
  std::vector<std::uint8_t>       whole(pixels); // missing single pixels would roughen the instruments
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    const std::uint8_t * const why = unexplained.data();
    const std::uint8_t * const usable = scene.frame.usable.data() + begin;
    std::transform(why + begin, why + end, usable, take.data() + begin, [](std::uint8_t own, std::uint8_t use) {
      return own == 0 ? use : std::uint8_t{ 0 };
    });
    std::transform(why + begin, why + end, usable, whole.data() + begin, [](std::uint8_t own, std::uint8_t use) {
      return own == 2 ? std::uint8_t{ 0 } : use;
    });
  });
  ShiftInstruments instruments = MakeShiftInstruments(scene.frame, scene.model, whole, parallelFor);
  return FrameRegressors(scene.frame, scene.model, take, std::move(instruments), parallelFor);
}

} // namespace sensornoise
