// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/OffsetDrift.h"

#include "pixels/Constants.h"
#include "pixels/PixelCoordinates.h"
#include "pixels/IlluminationResponses.h"
#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
/** Sums of the weight w times powers of I, the mean minus the centre, and times z, the response. */
struct LineSums
{
  double w{ 0.0 };
  double wI{ 0.0 };
  double wII{ 0.0 };
  double wZ{ 0.0 };
  double wIZ{ 0.0 };
};
} // namespace

bool
IsOffsetDrift(const IlluminationResponses & data)
{
  const std::size_t      side = InPattern.driftTileSide;
  const ReferenceFrame & frame = data.frame;
  const std::size_t      width = frame.geometry.width;
  const std::size_t      light = data.factors;
  const Tiles            tiles{ side, side, (width + side - 1) / side };
  const std::size_t      count = tiles.across * ((frame.geometry.height + side - 1) / side);
  for (std::size_t j = 1; j < light; ++j)
  {
    std::vector<LineSums> parts(count);
    LineSums              whole;
    for (std::size_t p = 0; p < data.mask.size(); ++p)
    {
      if (data.mask[p] != 0)
      {
        const double w = 1.0 / data.line.At(frame.neighbourMean[p]);
        const double centred = frame.mean[p] - data.centreDn;
        const double z = data.coordinates.At(p, j);
        for (LineSums * s : { &parts[tiles.Of(p, width)], &whole })
        {
          s->w += w;
          s->wI += w * centred;
          s->wII += w * centred * centred;
          s->wZ += w * z;
          s->wIZ += w * centred * z;
        }
      }
    }
    const double determinant = whole.w * whole.wII - whole.wI * whole.wI;
    const double level = (whole.wII * whole.wZ - whole.wI * whole.wIZ) / determinant;
    const double slope = (whole.w * whole.wIZ - whole.wI * whole.wZ) / determinant;
    const double explained = level * whole.wZ + slope * whole.wIZ;
    double       chi2 = 0.0;
    double       used = 0.0;
    for (const LineSums & s : parts)
    {
      if (s.w > 0.0)
      {
        chi2 += std::pow(s.wZ - level * s.w - slope * s.wI, 2) / s.w;
        used += 1.0;
      }
    }
    if (chi2 > InPattern.largestDriftChi2 * std::max(1.0, used - 2.0) ||
        explained < InPattern.leastDriftExplained * chi2)
    {
      return false;
    }
  }
  return light > 1;
}

} // namespace sensornoise
