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
#ifndef sensornoise_scene_UsablePixels_h
#define sensornoise_scene_UsablePixels_h

#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/base/Stencils.h"
#include "sensornoise/moments/Codes.h"
#include "sensornoise/refined/RefinedFindings.h"
#include "sensornoise/report/Quantities.h"
#include "sensornoise/scene/GuardBand.h"
#include "sensornoise/scene/ProvisionalModel.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sensornoise
{

/** Whether pixel \a p of the maps can be used, or why not: before any model of the noise. */
inline PixelUse
UseOf(const ReferenceFrame &            frame,
      const std::vector<double> &       variance,
      const std::vector<std::uint8_t> & valid,
      std::size_t                       p)
{
  if (frame.usable[p] != 0)
  {
    return PixelUse::Used;
  }
  if (valid[p] == 0)
  {
    return std::isfinite(variance[p]) ? PixelUse::Clipped : PixelUse::NotFinite;
  }
  if (!(variance[p] > 0.0))
  {
    return PixelUse::Constant;
  }
  const std::size_t x = p % frame.geometry.width;
  const std::size_t y = p / frame.geometry.width;
  const bool        isInner = x >= StencilMargin && x + StencilMargin < frame.geometry.width && y >= StencilMargin &&
                       y + StencilMargin < frame.geometry.height;
  return isInner ? PixelUse::NearClip : PixelUse::Border;
}

/** Leaves out what clipping could touch (FindGuardBand), and pixels whose noise is below half a code step, where the
 * codes hide it. \a frameMeans are the frames' means, for the brightest and the darkest one. If more than 2 % are
 * hidden, the dark end goes with them, and the stack cannot be measured. */
inline void
LeaveOutCoarseAndGuarded(ReferenceFrame &            frame,
                         std::vector<std::uint8_t> & pixelUse,
                         RefinedFindings &           found,
                         const CodeRange &           codes,
                         const std::vector<double> & frameMeans,
                         const ParallelFor &         parallelFor)
{
  const ProvisionalModel & model = found.model;
  const double             step = codes.quantisationStepDn;
  const auto usable = static_cast<double>(std::count(frame.usable.begin(), frame.usable.end(), std::uint8_t{ 1 }));
  // The brightness of a frame relative to the average, from its mean or from the model of the variance.
  const double average = std::accumulate(frameMeans.begin(), frameMeans.end(), 0.0) / static_cast<double>(frame.frames);
  const double flux = std::max(1e-3, model.averageDn - model.darkestDn);
  const auto [lowest, highest] = std::minmax_element(frameMeans.begin(), frameMeans.end());
  const double typical = 1.5 * std::sqrt(model.flickerVariance);
  const double brightest = std::max((*highest - average) / flux, typical);
  const double darkest = std::max(-1.0, std::min((*lowest - average) / flux, -typical));
  const auto   guarded = FindGuardBand(frame, model, codes, brightest, darkest, parallelFor);
  for (std::size_t p = 0; p < guarded.size(); ++p)
  {
    if (frame.usable[p] != 0)
    {
      const bool isCoarse = step > 0.0 && model.NoiseVariance(frame.neighbourMean[p]) < 0.25 * step * step;
      if (isCoarse || guarded[p] != 0)
      {
        pixelUse[p] = static_cast<std::uint8_t>(isCoarse ? PixelUse::CoarseCodes : PixelUse::NearClip);
        frame.usable[p] = 0;
        ++(isCoarse ? found.coarse : found.nearClip);
      }
    }
  }
  found.usable = usable - static_cast<double>(found.coarse + found.nearClip);
  if (static_cast<double>(found.coarse) > 0.02 * usable)
  {
    found.Fail("codes-too-coarse",
               "the noise of " + Text(100.0 * static_cast<double>(found.coarse) / usable) +
                 " % of the pixels, the darkest, is below half a code step of " + Text(step) +
                 " DN, where the codes hide it: use more bits, or a higher analogue gain");
  }
}

} // namespace sensornoise

#endif
