// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_ParallelWork_h
#define sensornoise_base_ParallelWork_h

#include "sensornoise/Parallel.h"

#include <atomic>
#include <cstddef>
#include <exception>
#include <memory>
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

/** Extends a map, which has enough capacity, to \a count pixels; the new pixels are \a value. The system allocates a
 * page of memory when it is first written to, which takes longer than later writes: here the threads do this in
 * parallel. */
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

/** \class PlaneWork
 * \brief Distributes the work on the planes of a mosaic over threads: one plane after the other, or all planes at the
 * same time, with one thread for each. */
class PlaneWork
{
public:
  /** \a parallelFor uses \a threads threads. */
  PlaneWork(const ParallelFor & parallelFor, std::size_t threads)
    : m_ParallelFor(parallelFor)
    , m_Threads(threads)
    , m_State(std::make_shared<State>())
  {}

  /** Returns a loop that distributes the work within a plane. It remains valid when the object is destroyed. */
  ParallelFor
  WithinPlane() const
  {
    return [parallelFor = m_ParallelFor, state = m_State](std::size_t count, const auto & function) {
      if (!state->isByPlane)
      {
        parallelFor(count, function);
        return;
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        // A single call is not distributed, but parallelFor may throw here to stop the work.
        parallelFor(1, [&](std::size_t) {
          if (state->isStopped)
          {
            throw Stopped();
          }
          function(i);
        });
      }
    };
  }

  /** Calls function(k) for the planes first <= k < last, at the same time unless there are more threads than planes. An
   * exception of one call stops the other calls, and is thrown. */
  template <typename TFunction>
  void
  ForPlanes(std::size_t first, std::size_t last, TFunction function) const
  {
    m_State->isByPlane = m_Threads <= last - first;
    m_State->isStopped = false;
    const auto ofPlane = [&](std::size_t k) {
      try
      {
        function(first + k);
      }
      catch (const Stopped &)
      {} // the plane that failed throws its exception
      catch (...)
      {
        m_State->isStopped = true;
        throw;
      }
    };
    try
    {
      ForAll(last - first, m_State->isByPlane ? m_ParallelFor : SerialFor, ofPlane);
    }
    catch (...)
    {
      m_State->isByPlane = false;
      throw;
    }
    m_State->isByPlane = false;
  }

private:
  struct Stopped
  {};
  struct State
  {
    bool              isByPlane{ false }; // whether planes run at the same time
    std::atomic<bool> isStopped{ false };
  };

  ParallelFor            m_ParallelFor;
  std::size_t            m_Threads;
  std::shared_ptr<State> m_State;
};

} // namespace sensornoise

#endif
