// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/LocalFlicker.h"

#include "pixels/PixelCoordinates.h"
#include "pixels/IlluminationResponses.h"
#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"

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
SumLocalFlicker(const IlluminationResponses & data)
{
  const ReferenceFrame & frame = data.frame;
  const std::size_t      light = data.factors;
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
        sums.energy += std::pow(data.coordinates.At(p, j), 2) / noise - 1.0;
      }
      sums.w += 1.0 / noise;
      sums.wI += centred / noise;
      sums.wII += centred * centred / noise;
    }
  }
  return sums;
}

} // namespace sensornoise
