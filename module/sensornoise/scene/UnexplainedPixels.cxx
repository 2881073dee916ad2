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
        unexplained[p] = frame.RawVariance(p) > model.largestRatio * expected ? 1 : 0;
      }
    }
  });
  const std::vector<double> crowd = BoxSum(unexplained, frame.geometry.width, frame.geometry.height, 3, parallelFor);
  for (std::size_t p = 0; p < unexplained.size(); ++p)
  {
    unexplained[p] = crowd[p] > InScene.largestFarShare * 49.0 ? 2 : unexplained[p];
  }
  return unexplained;
}

} // namespace sensornoise
