// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackFrames_h
#define sensornoise_moments_StackFrames_h

#include "SensorNoiseExport.h"
#include "base/NothingToMeasure.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace sensornoise
{

struct FrameGeometry;

/** Least number of frames of a stack that the methods measure. */
inline constexpr std::size_t MinimumFrames = 5;

/** Largest number of frames: up to it all sums over integer pixels are exact. The moments are exact for up to 2^22
 * frames, see IntegerMoments::MostFrames, the projections of the refined method for 2^34. The illumination factors of
 * the published method are rounded so that their sums are exact. At 2^22 frames they keep 15 bits: the rounding, at
 * most 3e-5 of the flicker, is far below any noise. */
inline constexpr std::size_t MaximumFrames = std::size_t{ 1 } << 22;

/** Smallest width and height of a frame [pixel]: a pixel with its eight neighbours. */
inline constexpr std::size_t SmallestSide = 3;

/** Throws std::invalid_argument if a stack has fewer than MinimumFrames or more than MaximumFrames frames, frames of
 * fewer than 3 x 3 pixels, or a mask of another size than a frame. \a maskPixels is 0 without a mask. */
SensorNoise_EXPORT void
RequireStack(const FrameGeometry & geometry, std::size_t frames, std::size_t maskPixels);

/** Throws NothingToMeasure if fewer than MinimumFrames distinct frames are left. It does not if no pixel is \a valid:
 * then this is the reason why frames are equal, and it is reported instead. */
inline void
RequireDistinctFrames(std::size_t distinct, const std::vector<std::uint8_t> & valid)
{
  if (distinct < MinimumFrames && std::find(valid.begin(), valid.end(), std::uint8_t{ 1 }) != valid.end())
  {
    throw NothingToMeasure("only " + std::to_string(distinct) +
                           (distinct == 1 ? " distinct frame is" : " distinct frames are") +
                           " left, as equal frames are counted once; expected at least " +
                           std::to_string(MinimumFrames) + ". Record more frames");
  }
}

/** \class PassFrames
 * \brief The frames of the current pass over a stack that have been added, in this or another process. */
class SensorNoise_EXPORT PassFrames
{
public:
  explicit PassFrames(std::size_t frames);

  /** Number of the current pass, from 0. */
  unsigned int
  GetPass() const
  {
    return m_Pass;
  }

  /** Marks the next \a count frames as added and returns the first. Throws std::logic_error if fewer are left, or if
   * one has been added before. */
  std::size_t
  Add(std::size_t count);

  /** Passes over the next \a count frames, which another process adds. Throws std::logic_error if fewer are left. */
  void
  Skip(std::size_t count);

  /** Makes frame \a t the next one. Throws std::logic_error if there is no such frame. */
  void
  GoTo(std::size_t t);

  /** Marks all frames of the pass as not added, and goes to frame 0. */
  void
  Forget();

  /** Returns 1 for every frame that has been added, else 0. */
  const std::vector<std::uint8_t> &
  GetHas() const
  {
    return m_Has;
  }

  /** Throws std::runtime_error if a frame has been added both here and to \a other. */
  void
  RequireApart(const PassFrames & other) const;

  /** Marks the frames of \a other as added. Throws std::runtime_error if one has been added here, too. */
  void
  Merge(const PassFrames & other);

  /** Ends the pass. Throws std::logic_error if a frame is missing. */
  void
  EndPass();

  /** Writes the pass and its frames, see BinaryStream. */
  void
  Save(std::ostream & out) const;
  /** Reads the frames of a stream, of the same pass. Throws std::runtime_error if it is of another pass. */
  PassFrames
  ReadOther(std::istream & in) const;

private:
  std::vector<std::uint8_t> m_Has;
  std::size_t               m_Next{ 0 };
  unsigned int              m_Pass{ 0 };
};

/** Calls function(frames, number) with the frames that \a isChosen selects, in order and contiguous in memory. If all
 * frames are chosen, they are passed in place. Otherwise copies are passed, at most 32 MiB or one frame at a time.
 * \a frames holds as many frames as \a isChosen has flags. */
template <typename TPixel, typename TFunction>
void
ForChosenFrames(const TPixel *                    frames,
                std::size_t                       pixels,
                const std::vector<std::uint8_t> & isChosen,
                const ParallelFor &               parallelFor,
                TFunction                         function)
{
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < isChosen.size(); ++k)
  {
    if (isChosen[k] != 0)
    {
      chosen.push_back(k);
    }
  }
  if (chosen.empty() || chosen.size() == isChosen.size())
  {
    if (!chosen.empty())
    {
      function(frames, chosen.size());
    }
    return;
  }
  const std::size_t   together = std::max<std::size_t>(1, (std::size_t{ 32 } << 20) / (pixels * sizeof(TPixel)));
  std::vector<TPixel> copies(std::min(together, chosen.size()) * pixels);
  for (std::size_t first = 0; first < chosen.size(); first += together)
  {
    const std::size_t number = std::min(together, chosen.size() - first);
    parallelFor(number, [&](std::size_t k) {
      std::copy_n(frames + chosen[first + k] * pixels, pixels, copies.data() + k * pixels);
    });
    function(static_cast<const TPixel *>(copies.data()), number);
  }
}

/** \class DistinctFrames
 * \brief The frames of a stack that are counted: the first frame, the original, of each set of equal frames. Frames
 * that are left out are not counted.
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
  /** Number of frames that equal an earlier frame. */
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
  /** Returns the numbers of the frames that are counted among the frames that are not left out, ascending: repeated
   * frames are numbered, too. */
  std::vector<std::size_t>
  RecordedNumbers() const
  {
    std::vector<std::size_t> numbers;
    std::size_t              recorded = 0;
    for (std::size_t t = 0; t < m_Originals.size(); ++t)
    {
      if (this->IsCounted(t))
      {
        numbers.push_back(recorded);
      }
      recorded += m_Places[t] != None ? 1 : 0;
    }
    return numbers;
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
  ExpandToGiven(const std::vector<TValue> & ofDistinct, const TValue & ofLeftOut) const
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
