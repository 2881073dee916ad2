// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/MedianFilter.h"

#include "simulation/SettingChecks.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise
{

void
CheckSettings(const MedianSettings & settings)
{
  RequireSetting(settings.radiusPixels <= 10, "radius of the median filter", settings.radiusPixels, "0 to 10 pixels");
}

DoubleFrame
FilterByMedian(const DoubleFrame & codesDn, const MedianSettings & settings, const ParallelFor & parallelFor)
{
  const auto  radius = static_cast<std::ptrdiff_t>(settings.radiusPixels);
  const auto  lastX = static_cast<std::ptrdiff_t>(codesDn.width) - 1;
  const auto  lastY = static_cast<std::ptrdiff_t>(codesDn.height) - 1;
  DoubleFrame out(codesDn.width, codesDn.height);
  parallelFor(codesDn.height, [&](std::size_t y) {
    std::vector<double> square;
    for (std::ptrdiff_t x = 0; x <= lastX; ++x)
    {
      square.clear();
      for (std::ptrdiff_t dy = -radius; dy <= radius; ++dy)
      {
        const auto     row = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(y) + dy, 0, lastY);
        const double * codes = codesDn.Row(static_cast<std::size_t>(row));
        for (std::ptrdiff_t dx = -radius; dx <= radius; ++dx)
        {
          square.push_back(codes[std::clamp<std::ptrdiff_t>(x + dx, 0, lastX)]);
        }
      }
      const auto middle = square.begin() + static_cast<std::ptrdiff_t>(square.size() / 2);
      std::nth_element(square.begin(), middle, square.end());
      out.Row(y)[x] = *middle;
    }
  });
  return out;
}

} // namespace sensornoise
