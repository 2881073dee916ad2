// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_ForAll_h
#define sensornoise_base_ForAll_h

#include "sensornoise/Parallel.h"

#include <cstddef>
#include <exception>
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

} // namespace sensornoise

#endif
