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
#include "sensornoise/scene/UnexplainedPixels.h"

#include "sensornoise/base/BoxSum.h"
#include "sensornoise/base/Stencils.h"

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
        const auto   derivatives = ApplyStencils(frame.mean.data(), frame.geometry.width, p);
        const double gx = derivatives[StencilX];
        const double gy = derivatives[StencilY];
        const double expected = std::max(0.2 * model.interceptDn2, model.RawVariance(frame.neighbourMean[p], gx, gy));
        unexplained[p] = frame.RawVariance(p) > model.largestRatio * expected ? 1 : 0;
      }
    }
  });
  const std::vector<double> crowd = BoxSum(unexplained, frame.geometry.width, frame.geometry.height, 3, parallelFor);
  for (std::size_t p = 0; p < unexplained.size(); ++p)
  {
    unexplained[p] = crowd[p] > 0.15 * 49.0 ? 2 : unexplained[p];
  }
  return unexplained;
}

} // namespace sensornoise
