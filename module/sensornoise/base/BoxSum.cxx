// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/base/BoxSum.h"

#include "sensornoise/base/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

namespace
{

/** Running sums of 2 \a radius + 1 neighbours along a row, cut at its ends. */
void
SumAlongRow(const std::vector<double> & in, std::size_t radius, double * out)
{
  const std::size_t width = in.size();
  double            sum = 0.0;
  for (std::size_t x = 0; x < std::min(width, radius); ++x)
  {
    sum += in[x];
  }
  for (std::size_t x = 0; x < width; ++x)
  {
    const double next = x + radius < width ? in[x + radius] : 0.0;
    sum += next - (x > radius ? in[x - radius - 1] : 0.0);
    out[x] = sum;
  }
}

} // namespace

template <typename TValue>
void
BoxSum(const std::vector<TValue> & map,
       std::size_t                 width,
       std::size_t                 height,
       std::size_t                 radius,
       const ParallelFor &         parallelFor,
       std::vector<double> &       result)
{
  result.resize(map.size());
  constexpr std::size_t band = 64; // rows that are summed together
  parallelFor((height + band - 1) / band, [&](std::size_t b) {
    const std::size_t   first = b * band;
    const std::size_t   last = std::min(height, first + band);
    std::vector<double> columns(width, 0.0);
    const auto          add = [&](std::size_t y, double sign) {
      const TValue * row = map.data() + y * width;
      for (std::size_t x = 0; x < width; ++x)
      {
        columns[x] += sign * static_cast<double>(row[x]);
      }
    };
    for (std::size_t y = first - std::min(first, radius); y < std::min(height, first + radius); ++y)
    {
      add(y, 1.0);
    }
    for (std::size_t y = first; y < last; ++y)
    {
      if (y + radius < height)
      {
        add(y + radius, 1.0);
      }
      if (y > first && y > radius)
      {
        add(y - radius - 1, -1.0);
      }
      SumAlongRow(columns, radius, result.data() + y * width);
    }
  });
}

template SensorNoise_EXPORT void
BoxSum(const std::vector<std::uint8_t> &,
       std::size_t,
       std::size_t,
       std::size_t,
       const ParallelFor &,
       std::vector<double> &);
template SensorNoise_EXPORT void
BoxSum(const std::vector<float> &, std::size_t, std::size_t, std::size_t, const ParallelFor &, std::vector<double> &);
template SensorNoise_EXPORT void
BoxSum(const std::vector<double> &, std::size_t, std::size_t, std::size_t, const ParallelFor &, std::vector<double> &);

} // namespace sensornoise
