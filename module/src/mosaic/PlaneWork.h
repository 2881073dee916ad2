// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_PlaneWork_h
#define sensornoise_mosaic_PlaneWork_h

#include "base/ForAll.h"
#include "sensornoise/Parallel.h"

#include <atomic>
#include <cstddef>
#include <memory>

namespace sensornoise
{

/** \class PlaneWork
 * \brief Spreads work on the planes of a mosaic over threads: plane after plane, or at the same time, each by a thread.
 */
class PlaneWork
{
public:
  /** \a parallelFor has \a threads threads. */
  PlaneWork(const ParallelFor & parallelFor, std::size_t threads)
    : m_ParallelFor(parallelFor)
    , m_Threads(threads)
    , m_State(std::make_shared<State>())
  {}

  /** What spreads the work within a plane, also when the object is gone. */
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
        // A single call: it is not spread, but whoever made parallelFor may stop the work there.
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

  /** Calls function(k) for the planes from \a first on and below \a last, at the same time unless there are more
   * threads. What one of them throws stops the others. */
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
      {} // for what another plane throws
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
    bool              isByPlane{ false }; // at the same time
    std::atomic<bool> isStopped{ false };
  };

  ParallelFor            m_ParallelFor;
  std::size_t            m_Threads;
  std::shared_ptr<State> m_State;
};

} // namespace sensornoise

#endif
