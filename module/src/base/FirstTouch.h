// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_FirstTouch_h
#define sensornoise_base_FirstTouch_h

#include "sensornoise/Parallel.h"

#include <cstddef>
#include <type_traits>
#include <vector>

namespace sensornoise
{

/** Makes a map, for which memory is reserved, \a count pixels long, not shorter than it is; the new ones are \a value.
 * The system makes a page of memory when it is first written to, which takes longer than all that is written to it
 * later: here the threads share that. */
template <typename TNumber>
void
GrowMap(std::vector<TNumber> & map, std::size_t count, const ParallelFor & parallelFor, TNumber value = TNumber{})
{
  static_assert(std::is_arithmetic_v<TNumber>);
  constexpr std::size_t    page = 4096 / sizeof(TNumber);
  volatile TNumber * const numbers = map.data() + map.size();
  ForBlocks(count - map.size(), parallelFor, [numbers](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += page)
    {
      numbers[i] = TNumber{};
    }
  });
  map.resize(count, value);
}

/** A map of \a count pixels, all of them \a value. */
template <typename TNumber>
std::vector<TNumber>
MakeMap(std::size_t count, const ParallelFor & parallelFor, TNumber value = TNumber{})
{
  std::vector<TNumber> map;
  map.reserve(count);
  GrowMap(map, count, parallelFor, value);
  return map;
}

} // namespace sensornoise

#endif
