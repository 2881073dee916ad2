// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_ValueRange_h
#define sensornoise_base_ValueRange_h

#include "sensornoise/base/Parallel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace sensornoise
{

/** The lowest and the highest of some values, and how many there are. */
struct ValueRange
{
  double      lowest{ std::numeric_limits<double>::infinity() };
  double      highest{ -std::numeric_limits<double>::infinity() };
  std::size_t values{ 0 };

  void
  Add(double value)
  {
    this->Add(ValueRange{ value, value, 1 });
  }
  void
  Add(const ValueRange & other)
  {
    lowest = std::min(lowest, other.lowest);
    highest = std::max(highest, other.highest);
    values += other.values;
  }
};

/** The range of value(pixel) over those of \a count pixels that has(pixel) takes. */
template <typename THas, typename TValue>
ValueRange
RangeOverPixels(std::size_t count, const ParallelFor & parallelFor, THas has, TValue value)
{
  ValueRange range;
  for (const ValueRange & part :
       PartsOfBlocks<ValueRange>(count, parallelFor, [&](std::size_t begin, std::size_t end, ValueRange & own) {
         for (std::size_t p = begin; p < end; ++p)
         {
           if (has(p))
           {
             own.Add(value(p));
           }
         }
       }))
  {
    range.Add(part);
  }
  return range;
}

/** The same of the values of a map where \a mask is not 0, in vectors. */
inline ValueRange
RangeOfMap(const float * values, const std::uint8_t * mask, std::size_t count, const ParallelFor & parallelFor)
{
  constexpr std::size_t lanes = 8;
  constexpr float       infinity = std::numeric_limits<float>::infinity();
  ValueRange            range;
  for (const ValueRange & part :
       PartsOfBlocks<ValueRange>(count, parallelFor, [&](std::size_t begin, std::size_t end, ValueRange & own) {
         std::array<float, lanes> low{};
         std::array<float, lanes> high{};
         low.fill(infinity);
         high.fill(-infinity);
         for (std::size_t p = begin; p + lanes <= end; p += lanes)
         {
           for (std::size_t lane = 0; lane < lanes; ++lane)
           {
             const float value = values[p + lane];
             const bool  counts = mask[p + lane] != 0;
             const float below = counts ? value : infinity;
             const float above = counts ? value : -infinity;
             low[lane] = below < low[lane] ? below : low[lane];
             high[lane] = above > high[lane] ? above : high[lane];
           }
         }
         for (std::size_t p = end - (end - begin) % lanes; p < end; ++p)
         {
           low[0] = mask[p] != 0 ? std::min(low[0], values[p]) : low[0];
           high[0] = mask[p] != 0 ? std::max(high[0], values[p]) : high[0];
         }
         own.lowest = *std::min_element(low.begin(), low.end());
         own.highest = *std::max_element(high.begin(), high.end());
         own.values = end - begin - static_cast<std::size_t>(std::count(mask + begin, mask + end, std::uint8_t{ 0 }));
       }))
  {
    range.Add(part);
  }
  return range;
}

} // namespace sensornoise

#endif
