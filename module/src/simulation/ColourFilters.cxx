// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/ColourFilters.h"

#include <array>

namespace sensornoise
{

void
ApplyFilters(const ColourFilterSettings & settings,
             std::size_t                  width,
             std::size_t                  height,
             std::vector<double> &        efficiency)
{
  if (!settings.pattern)
  {
    return;
  }
  efficiency.resize(width * height, 1.0);
  for (const BayerPlane plane : BayerPlanes)
  {
    const double                     transmission = plane == BayerPlane::R   ? settings.transmissionR
                                                    : plane == BayerPlane::B ? settings.transmissionB
                                                                             : settings.transmissionG;
    const std::array<std::size_t, 2> corner = CornerOf(*settings.pattern, plane);
    for (std::size_t y = corner[1]; y < height; y += 2)
    {
      for (std::size_t x = corner[0]; x < width; x += 2)
      {
        efficiency[y * width + x] *= transmission;
      }
    }
  }
}

} // namespace sensornoise
