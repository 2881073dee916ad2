// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/PixelCoordinates.h"

#include "sensornoise/Parallel.h"
#include "pixels/ProjectionSums.h"
#include "series/TemporalBasis.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sensornoise
{

PixelCoordinates::PixelCoordinates(ProjectionSums &&           sums,
                                   const TemporalBasis &       basis,
                                   const std::vector<double> & mean,
                                   const ParallelFor &         parallelFor)
  : m_Coordinates(std::move(sums))
{
  if (basis.Size() == 0 || mean.empty())
  {
    return;
  }
  const std::size_t offset = m_Coordinates.FirstPixel();
  ForBlocks(m_Coordinates.LastPixel() - offset, parallelFor, [&](std::size_t begin, std::size_t end) {
    end += offset;
    for (std::size_t p = begin + offset; p < end; p += BlockPixels)
    {
      basis.ToCoordinates(&m_Coordinates.At(p, 0), BlockPixels, mean.data() + p, std::min(BlockPixels, end - p));
    }
  });
}

PixelCoordinates::PixelCoordinates(ProjectionSums && coordinates)
  : m_Coordinates(std::move(coordinates))
{}

} // namespace sensornoise
