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
#ifndef SensorNoiseBoxMean_h
#define SensorNoiseBoxMean_h

#include "SensorNoiseStackMaps.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Sum of \a map over a square of 2 \a radius + 1 pixels about each pixel, cut at the frame's border.
 *
 * Running sums along the rows, then along the columns: the cost does not depend on the radius. */
template <typename TValue>
std::vector<double>
BoxSum(const std::vector<TValue> & map,
       std::size_t                 width,
       std::size_t                 height,
       std::size_t                 radius,
       const ParallelFor &         parallelFor = SerialFor)
{
  std::vector<double> rows(map.size());
  parallelFor(height, [&](std::size_t y) {
    const TValue * in = map.data() + y * width;
    double *       out = rows.data() + y * width;
    double         sum = 0.0;
    for (std::size_t x = 0; x < std::min(width, radius); ++x)
    {
      sum += static_cast<double>(in[x]);
    }
    for (std::size_t x = 0; x < width; ++x)
    {
      sum += x + radius < width ? static_cast<double>(in[x + radius]) : 0.0;
      sum -= x > radius ? static_cast<double>(in[x - radius - 1]) : 0.0;
      out[x] = sum;
    }
  });
  std::vector<double>   result(map.size());
  constexpr std::size_t strip = 64; // columns that are summed together
  parallelFor((width + strip - 1) / strip, [&](std::size_t s) {
    const std::size_t   first = s * strip;
    const std::size_t   last = std::min(width, first + strip);
    std::vector<double> sum(strip, 0.0);
    for (std::size_t y = 0; y < height + radius; ++y)
    {
      for (std::size_t x = first; x < last; ++x)
      {
        sum[x - first] += y < height ? rows[y * width + x] : 0.0;
        if (y >= radius)
        {
          sum[x - first] -= y > 2 * radius ? rows[(y - 2 * radius - 1) * width + x] : 0.0;
          result[(y - radius) * width + x] = sum[x - first];
        }
      }
    }
  });
  return result;
}

} // namespace sensornoise

#endif
