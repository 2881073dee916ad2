// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
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
        const auto [gx, gy] = ApplyGradient(frame.mean.data(), frame.geometry.width, p);
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
