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
#include "sensornoise/scene/GuardBand.h"

#include "sensornoise/base/Stencils.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

std::vector<std::uint8_t>
FindGuardBand(const ReferenceFrame &   frame,
              const ProvisionalModel & model,
              const CodeRange &        codes,
              double                   brightest,
              double                   darkest,
              const ParallelFor &      parallelFor,
              double                   sds)
{
  std::vector<std::uint8_t> guarded(frame.mean.size(), 0);
  if (!codes.clipLowDn && !codes.clipHighDn)
  {
    return guarded;
  }
  const double halfLow = 0.5 * codes.StepAt(codes.clipLowDn.value_or(0.0));
  const double halfHigh = 0.5 * codes.StepAt(codes.clipHighDn.value_or(0.0));
  ForBlocks(guarded.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (frame.usable[p] != 0)
      {
        const auto   derivatives = ApplyStencils(frame.mean.data(), frame.geometry.width, p);
        const double gx = derivatives[StencilX];
        const double gy = derivatives[StencilY];
        const double level = frame.neighbourMean[p];
        const double flux = std::max(0.0, level - model.darkestDn);
        const double noise = model.NoiseVariance(level);
        const double motion = model.MotionVariance(gx, gy);
        const double high = level + brightest * flux + sds * std::sqrt(noise * (1.0 + brightest) + motion);
        const double low = level + darkest * flux - sds * std::sqrt(noise + motion);
        guarded[p] = (codes.clipHighDn && high >= *codes.clipHighDn - halfHigh) ||
                         (codes.clipLowDn && low <= *codes.clipLowDn + halfLow)
                       ? 1
                       : 0;
      }
    }
  });
  return guarded;
}

} // namespace sensornoise
