// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_ParallelWork_h
#define sensornoise_base_ParallelWork_h

#include "sensornoise/Parallel.h"

#include <cstddef>
#include <exception>
#include <type_traits>
#include <vector>

namespace sensornoise
{

/** Calls function(k) for all of 0 ... count - 1 as \a parallelFor does. Then throws the exception of the smallest k
 * that has thrown one, so that the error does not depend on the threads. */
template <typename TFunction>
void
ForAll(std::size_t count, const ParallelFor & parallelFor, TFunction function)
{
  std::vector<std::exception_ptr> errors(count);
  parallelFor(count, [&](std::size_t k) {
    try
    {
      function(k);
    }
    catch (...)
    {
      errors[k] = std::current_exception();
    }
  });
  for (const std::exception_ptr & error : errors)
  {
    if (error)
    {
      std::rethrow_exception(error);
    }
  }
}

/** Extends a map, which has enough capacity, to \a count pixels; the new ones are \a value. The system allocates a page
 * of memory when it is first written to, which takes longer than later writes: here the threads do this in parallel. */
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

/** Returns a map of \a count pixels, all of them \a value. */
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
