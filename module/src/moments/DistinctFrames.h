// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_DistinctFrames_h
#define sensornoise_moments_DistinctFrames_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "moments/ChosenFrames.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sensornoise
{

/** \class DistinctFrames
 * \brief The frames of a stack that are counted. Of equal frames only the first one, the original, is counted; frames
 * that are left out are not.
 *
 * All later computations use the distinct frames only, numbered by their place among each other. */
class SensorNoise_EXPORT DistinctFrames
{
public:
  /** Place of a frame that is left out. */
  static constexpr std::size_t None = std::numeric_limits<std::size_t>::max();

  /** Constructs the distinct frames. \a originals holds, for each frame, the first frame that it equals: itself or an
   * earlier one. */
  explicit DistinctFrames(std::vector<std::size_t> originals = {});

  /** Returns the distinct frames without the frames \a leftOut and the frames that equal them. */
  DistinctFrames
  Without(const std::vector<std::size_t> & leftOut) const;

  /** Number of frames of the stack as given. */
  std::size_t
  Given() const
  {
    return m_Originals.size();
  }
  /** Number of frames that are counted. */
  std::size_t
  Count() const
  {
    return m_Count;
  }
  /** Number, from 0, of the first frame that frame \a t of the stack as given equals. */
  std::size_t
  OriginalOf(std::size_t t) const
  {
    return m_Originals[t];
  }
  /** Number of frames that equal an earlier one. */
  std::size_t
  Repeated() const
  {
    return m_Repeated;
  }
  /** Returns whether frame \a t itself is counted. */
  bool
  IsCounted(std::size_t t) const
  {
    return m_Originals[t] == t && m_Places[t] != None;
  }
  /** Returns the numbers of the frames that are counted, ascending. */
  std::vector<std::size_t>
  Counted() const
  {
    std::vector<std::size_t> counted;
    for (std::size_t t = 0; t < m_Originals.size(); ++t)
    {
      if (this->IsCounted(t))
      {
        counted.push_back(t);
      }
    }
    return counted;
  }
  /** Returns whether all of the frames first ... first + count - 1 are counted; frames beyond the end of the stack are
   * ignored. */
  bool
  AreDistinct(std::size_t first, std::size_t count) const
  {
    for (std::size_t t = first; t < std::min(first + count, m_Originals.size()); ++t)
    {
      if (!this->IsCounted(t))
      {
        return false;
      }
    }
    return true;
  }
  /** Returns the place of the original of frame \a t among the distinct frames, from 0; None: it is left out. */
  std::size_t
  PlaceOf(std::size_t t) const
  {
    return m_Places[t];
  }
  /** Returns the places of all given frames, see PlaceOf(). */
  const std::vector<std::size_t> &
  Places() const
  {
    return m_Places;
  }

  /** Selects the values of the distinct frames from values of all given frames. */
  template <typename TValue>
  std::vector<TValue>
  OfDistinct(const std::vector<TValue> & ofGiven) const
  {
    std::vector<TValue> values;
    for (std::size_t t = 0; t < m_Originals.size(); ++t)
    {
      if (this->IsCounted(t))
      {
        values.push_back(ofGiven[t]);
      }
    }
    return values;
  }

  /** Expands values of the distinct frames to all given frames: each frame has the value of its original. Frames that
   * are left out have \a ofLeftOut. */
  template <typename TValue>
  std::vector<TValue>
  OfGiven(const std::vector<TValue> & ofDistinct, const TValue & ofLeftOut) const
  {
    std::vector<TValue> values;
    for (const std::size_t place : m_Places)
    {
      values.push_back(place == None ? ofLeftOut : ofDistinct[place]);
    }
    return values;
  }

  /** Calls function(first, count) for the longest runs of counted frames among first ... first + count - 1. */
  template <typename TFunction>
  void
  ForRuns(std::size_t first, std::size_t count, TFunction function) const
  {
    for (std::size_t t = first; t < first + count;)
    {
      std::size_t end = t;
      while (end < first + count && this->IsCounted(end))
      {
        ++end;
      }
      if (end > t)
      {
        function(t, end - t);
      }
      t = end + 1;
    }
  }

  /** Calls function(frames, place of the first, number) with the counted frames among first ... first + count - 1,
   * contiguous in memory, see ForChosenFrames(). */
  template <typename TPixel, typename TFunction>
  void
  ForDistinct(const TPixel *      frames,
              std::size_t         pixels,
              std::size_t         first,
              std::size_t         count,
              const ParallelFor & parallelFor,
              TFunction           function) const
  {
    std::vector<std::uint8_t> isDistinct(count);
    std::size_t               place = m_Count;
    for (std::size_t k = count; k > 0; --k)
    {
      isDistinct[k - 1] = this->IsCounted(first + k - 1) ? 1 : 0;
      place = isDistinct[k - 1] != 0 ? m_Places[first + k - 1] : place;
    }
    ForChosenFrames(frames, pixels, isDistinct, parallelFor, [&](const TPixel * chosen, std::size_t number) {
      function(chosen, place, number);
      place += number;
    });
  }

private:
  std::vector<std::size_t> m_Originals;
  std::vector<std::size_t> m_Places;
  std::size_t              m_Count{ 0 };
  std::size_t              m_Repeated{ 0 };
};

} // namespace sensornoise

#endif
