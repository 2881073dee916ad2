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
#include "sensornoise/pixels/PixelCoordinates.h"

#include "sensornoise/base/Parallel.h"
#include "sensornoise/pixels/ProjectionSums.h"
#include "sensornoise/series/TemporalBasis.h"

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
  if (basis.Size() == 0)
  {
    return;
  }
  ForBlocks(mean.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; p += BlockPixels)
    {
      basis.ToCoordinates(&m_Coordinates.At(p, 0), BlockPixels, mean.data() + p, std::min(BlockPixels, end - p));
    }
  });
}

} // namespace sensornoise
