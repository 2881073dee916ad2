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
#ifndef sensornoise_pixels_LocalFlicker_h
#define sensornoise_pixels_LocalFlicker_h

#include "sensornoise/pixels/PixelLight.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Whether the further series of light are one line a + b mean over the whole frame: then a common offset drifts, and
 * no second light changes. */
inline bool
IsOffsetDrift(const PixelLight & data)
{
  const ReferenceFrame & frame = data.projected.GetFrame();
  const std::size_t      width = frame.geometry.width;
  const std::size_t      light = data.projected.GetBasis().NumberOfLightFactors();
  const detail::Patches  patches{ 32, 32, (width + 31) / 32 };
  const std::size_t      count = patches.across * ((frame.geometry.height + 31) / 32);
  for (std::size_t j = 1; j < light; ++j)
  {
    struct Sums
    {
      double w{ 0.0 }, wI{ 0.0 }, wII{ 0.0 }, z{ 0.0 }, zI{ 0.0 };
    };
    std::vector<Sums> parts(count);
    Sums              whole;
    for (std::size_t p = 0; p < data.mask.size(); ++p)
    {
      if (data.mask[p] != 0)
      {
        const double w = 1.0 / data.line.At(frame.neighbourMean[p]);
        const double centred = frame.mean[p] - data.centreDn;
        const double z = data.projected.GetCoordinates().At(p, j);
        for (Sums * s : { &parts[patches.Of(p, width)], &whole })
        {
          s->w += w;
          s->wI += w * centred;
          s->wII += w * centred * centred;
          s->z += w * z;
          s->zI += w * centred * z;
        }
      }
    }
    const double determinant = whole.w * whole.wII - whole.wI * whole.wI;
    const double level = (whole.wII * whole.z - whole.wI * whole.zI) / determinant;
    const double slope = (whole.w * whole.zI - whole.wI * whole.z) / determinant;
    const double explained = level * whole.z + slope * whole.zI;
    double       chi2 = 0.0;
    double       used = 0.0;
    for (const Sums & s : parts)
    {
      if (s.w > 0.0)
      {
        chi2 += std::pow(s.z - level * s.w - slope * s.wI, 2) / s.w;
        used += 1.0;
      }
    }
    if (chi2 > 4.0 * std::max(1.0, used - 2.0) || explained < 10.0 * chi2)
    {
      return false;
    }
  }
  return light > 1;
}

/** Sums from which the spread of local light follows for any offset. */
struct LocalFlicker
{
  double energy{ 0.0 }; ///< sum of (sum_j S_j^2 - noise) / noise
  double w{ 0.0 };      ///< of w, w I and w I^2, I the mean minus the centre
  double wI{ 0.0 };
  double wII{ 0.0 };
  double frames{ 0.0 };

  /** Root mean square over the frame of the standard deviation over time of the light, relative to its mean:
   * sqrt(sum w (sum_j S_j^2 - noise) / ((T - 1) sum w q^2)), q the mean above the offset (minus the centre). */
  double
  Sd(double offset) const
  {
    const double flux = wII - 2.0 * offset * wI + offset * offset * w;
    return std::sqrt(std::max(0.0, energy / (flux * (frames - 1.0))));
  }
};

inline LocalFlicker
SumLocalFlicker(const PixelLight & data)
{
  const ReferenceFrame & frame = data.projected.GetFrame();
  const std::size_t      light = data.projected.GetBasis().NumberOfLightFactors();
  LocalFlicker           sums;
  sums.frames = static_cast<double>(frame.frames);
  for (std::size_t p = 0; p < data.mask.size(); ++p)
  {
    if (data.mask[p] != 0)
    {
      const double noise = data.line.At(frame.neighbourMean[p]);
      const double centred = frame.mean[p] - data.centreDn;
      for (std::size_t j = 0; j < light; ++j)
      {
        sums.energy += std::pow(data.projected.GetCoordinates().At(p, j), 2) / noise - 1.0;
      }
      sums.w += 1.0 / noise;
      sums.wI += centred / noise;
      sums.wII += centred * centred / noise;
    }
  }
  return sums;
}

} // namespace sensornoise

#endif
