// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/scene/UnexplainedPixels.h"

#include "sensornoise/base/BoxSum.h"
#include "sensornoise/base/Stencils.h"
#include "sensornoise/scene/Constants.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

std::vector<std::uint8_t>
FindUnexplained(const ReferenceFrame & frame, const ProvisionalModel & model, const ParallelFor & parallelFor)
{
  std::vector<std::uint8_t> unexplained(frame.mean.size(), 0);
  ForBlocks(unexplained.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (frame.usable[p] != 0)
      {
        const auto [gx, gy] = ApplyGradient(frame.mean.data(), frame.geometry.width, p);
        const double expected =
          std::max(InScene.leastShareOfDarkest * model.interceptDn2, model.RawVariance(frame.neighbourMean[p], gx, gy));
        unexplained[p] = frame.variance[p] > model.largestRatio * expected ? 1 : 0;
      }
    }
  });
  const std::size_t         width = frame.geometry.width;
  const auto                rows = [&] { return RowsOf(unexplained, width); };
  std::vector<std::uint8_t> crowded = unexplained;
  ForBoxRows(rows, width, frame.geometry.height, 3, parallelFor, [&](std::size_t y, const double * crowd) {
    for (std::size_t x = 0; x < width; ++x)
    {
      std::uint8_t & own = crowded[y * width + x];
      own = crowd[x] > InScene.largestFarShare * 49.0 ? 2 : own;
    }
  });
  return crowded;
}

} // namespace sensornoise
