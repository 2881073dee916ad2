// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_ValueRange_h
#define sensornoise_base_ValueRange_h

#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace sensornoise
{

/** The lowest and the highest of some values, and their number. */
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

/** Returns the range of value(pixel) over the pixels below \a count for which has(pixel) is true. */
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

} // namespace sensornoise

#endif
