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
#ifndef sensornoise_scene_GuardBand_h
#define sensornoise_scene_GuardBand_h

#include "sensornoise/base/BoxSum.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Stencils.h"
#include "sensornoise/moments/Codes.h"
#include "sensornoise/scene/ProvisionalModel.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Marks the pixels that clipping could touch, whether it did or not: those whose expected extreme, in the brightest
 * or darkest frame and \a sds standard deviations out, reaches a clip level.
 *
 * Leaving out only the pixels that happened to clip would select on the noise: the others' variance is too small
 * (estimator.md, 3.2). \a brightest and \a darkest are the extreme relative brightness of a frame, above -1; 0: the
 * mean's. */
inline std::vector<std::uint8_t>
FindGuardBand(const ReferenceFrame &   frame,
              const ProvisionalModel & model,
              const CodeRange &        codes,
              double                   brightest,
              double                   darkest,
              const ParallelFor &      parallelFor,
              double                   sds = 4.5)
{
  std::vector<std::uint8_t> guarded(frame.mean.size(), 0);
  if (!codes.clipLowDn && !codes.clipHighDn)
  {
    return guarded;
  }
  const double half = 0.5 * codes.quantisationStepDn;
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
        guarded[p] =
          (codes.clipHighDn && high >= *codes.clipHighDn - half) || (codes.clipLowDn && low <= *codes.clipLowDn + half)
            ? 1
            : 0;
      }
    }
  });
  return guarded;
}

/** Marks the pixels that are no part of a static scene, as far as one pass can tell: 1 if their variance is far above
 * the model's, 2 if that of many of their 7 x 7 neighbours is. */
inline std::vector<std::uint8_t>
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

#endif
