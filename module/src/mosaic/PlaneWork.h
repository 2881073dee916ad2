// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_PlaneWork_h
#define sensornoise_mosaic_PlaneWork_h

#include "base/ParallelWork.h"
#include "sensornoise/Parallel.h"

#include <atomic>
#include <cstddef>
#include <memory>

namespace sensornoise
{

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
   * exception of one call stops the others, and is thrown. */
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
      {} // another plane throws the cause
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
    bool              isByPlane{ false }; // planes run at the same time
    std::atomic<bool> isStopped{ false };
  };

  ParallelFor            m_ParallelFor;
  std::size_t            m_Threads;
  std::shared_ptr<State> m_State;
};

} // namespace sensornoise

#endif
