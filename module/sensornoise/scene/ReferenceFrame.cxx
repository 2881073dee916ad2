// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/scene/ReferenceFrame.h"

#include "sensornoise/base/Stencils.h"

#include <cmath>

namespace sensornoise
{

ReferenceFrame
MakeReferenceFrame(const std::vector<double> &       mean,
                   const std::vector<double> &       variance,
                   const std::vector<std::uint8_t> & valid,
                   const FrameGeometry &             geometry,
                   std::size_t                       frames,
                   const ParallelFor &               parallelFor)
{
  const auto     width = static_cast<std::ptrdiff_t>(geometry.width);
  const auto     height = static_cast<std::ptrdiff_t>(geometry.height);
  ReferenceFrame frame;
  frame.geometry = geometry;
  frame.frames = frames;
  frame.mean = mean;
  frame.neighbourMean.resize(mean.size());
  frame.squares.resize(mean.size());
  frame.usable.assign(mean.size(), 0);
  parallelFor(geometry.height, [&](std::size_t row) {
    const auto y = static_cast<std::ptrdiff_t>(row);
    for (std::ptrdiff_t x = 0; x < width; ++x)
    {
      const auto p = static_cast<std::size_t>(y * width + x);
      double     sum = 0.0;
      int        count = 0;
      int        neighbours = 0;
      for (std::ptrdiff_t dy = -1; dy <= 1; ++dy)
      {
        for (std::ptrdiff_t dx = -1; dx <= 1; ++dx)
        {
          const bool isInside = x + dx >= 0 && x + dx < width && y + dy >= 0 && y + dy < height;
          if (isInside && (dx != 0 || dy != 0))
          {
            const auto n = static_cast<std::size_t>((y + dy) * width + x + dx);
            if (std::isfinite(mean[n]))
            {
              sum += mean[n];
              ++count;
            }
            neighbours += valid[n] != 0 ? 1 : 0;
          }
        }
      }
      frame.neighbourMean[p] = count > 0 ? sum / count : 0.0;
      frame.mean[p] = std::isfinite(mean[p]) ? mean[p] : frame.neighbourMean[p];
      frame.squares[p] = std::isfinite(variance[p]) ? variance[p] * static_cast<double>(frames - 1) : 0.0;
      const auto margin = static_cast<std::ptrdiff_t>(StencilMargin);
      const bool isInner = x >= margin && x + margin < width && y >= margin && y + margin < height;
      frame.usable[p] = isInner && valid[p] != 0 && neighbours == 8 && variance[p] > 0.0 ? 1 : 0;
    }
  });
  return frame;
}

} // namespace sensornoise
