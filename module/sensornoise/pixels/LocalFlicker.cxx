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
#include "sensornoise/pixels/LocalFlicker.h"

#include "sensornoise/pixels/PixelCoordinates.h"
#include "sensornoise/pixels/PixelLight.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/scene/ReferenceFrame.h"
#include "sensornoise/series/TemporalBasis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

double
LocalFlicker::Sd(double offset) const
{
  const double flux = wII - 2.0 * offset * wI + offset * offset * w;
  return std::sqrt(std::max(0.0, energy / (flux * (frames - 1.0))));
}

LocalFlicker
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
