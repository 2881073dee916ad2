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

/** Running sums of 2 \a radius + 1 neighbours along each of \a VRows rows, cut at their ends. Each sum waits for the
 * one before it: rows side by side fill the time. */
template <std::size_t VRows>
void
SumAlongRows(const double * in, std::size_t width, std::size_t radius, double * out)
{
  double sum[VRows] = {};
  for (std::size_t x = 0; x < std::min(width, radius); ++x)
  {
    for (std::size_t row = 0; row < VRows; ++row)
    {
      sum[row] += in[row * width + x];
    }
  }
  for (std::size_t x = 0; x < width; ++x)
  {
    const bool hasNext = x + radius < width;
    const bool hasLast = x > radius;
    for (std::size_t row = 0; row < VRows; ++row)
    {
      const double * const here = in + row * width + x;
      sum[row] += (hasNext ? here[radius] : 0.0) - (hasLast ? *(here - radius - 1) : 0.0);
      out[row * width + x] = sum[row];
    }
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
  constexpr std::size_t band = 64;    // rows that are summed together
  constexpr std::size_t together = 4; // along the rows
  parallelFor((height + band - 1) / band, [&](std::size_t b) {
    const std::size_t   first = b * band;
    const std::size_t   last = std::min(height, first + band);
    std::vector<double> columns(width, 0.0);
    std::vector<double> sums(together * width); // those of the last few rows
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
      const std::size_t row = (y - first) % together;
      std::copy(columns.begin(), columns.end(), sums.begin() + static_cast<std::ptrdiff_t>(row * width));
      if (row + 1 == together)
      {
        SumAlongRows<together>(sums.data(), width, radius, result.data() + (y - row) * width);
      }
    }
    for (std::size_t y = last - (last - first) % together; y < last; ++y)
    {
      SumAlongRows<1>(sums.data() + (y - first) % together * width, width, radius, result.data() + y * width);
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
