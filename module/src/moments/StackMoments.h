// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackMoments_h
#define sensornoise_moments_StackMoments_h

#include "SensorNoiseExport.h"
#include "base/BytesFingerprint.h"
#include "moments/StackFrames.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "sensornoise/FrameGeometry.h"
#include "moments/TemporalMoments.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <map>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class FrameFingerprints
 * \brief Fingerprints of the frames of a stack, which identify frames that are equal bit by bit: NaN are compared as
 * bits, and 0 and -0 differ.
 *
 * A recorder that runs faster than its camera writes equal frames. They have the same noise; if each was counted, the
 * estimated errors would be too small. Two exposures of a camera are never equal in all pixels by chance.
 *
 * Memory: about 90 bytes per frame. */
class SensorNoise_EXPORT FrameFingerprints
{
public:
  explicit FrameFingerprints(std::size_t frames);

  /** Marks frames that another process counts. Frames with a nonzero value in \a areCountedElsewhere are registered and
   * not counted: they equal a frame that another process counts. Throws std::invalid_argument if there are not as many
   * values as frames. */
  void
  SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere);

  /** Registers the fingerprints of frame \a first and of the following frames. Returns 1 for the frames that are
   * counted, because they differ from all frames that were counted before, and 0 for the others. */
  std::vector<std::uint8_t>
  Add(std::size_t first, const std::vector<BytesFingerprint> & fingerprints);

  /** Throws std::runtime_error if both this object and \a other have counted the same frame, or equal frames. */
  void
  RequireApart(const FrameFingerprints & other) const;

  /** Registers the frames of \a other, of the same stack. */
  void
  Merge(const FrameFingerprints & other);

  /** Writes the registered frames and their fingerprints, see BinaryStream. */
  void
  Save(std::ostream & out) const;
  /** Returns the fingerprints that a stream holds, of the same stack. Throws std::runtime_error if it ends early or
   * does not hold them. */
  FrameFingerprints
  ReadOther(std::istream & in) const;

  /** Returns the registered fingerprints by frame number. */
  const std::map<std::size_t, BytesFingerprint> &
  GetAll() const
  {
    return m_OfFrame;
  }

  /** Returns which frames are equal, after all have been registered. The result does not depend on which process
   * registered which frame. Throws std::logic_error if a frame was left to another process, and no process counted it.
   */
  DistinctFrames
  FindDistinct() const;

private:
  /** Frames that are equal: the number of the first frame, and whether one of these frames is counted. */
  struct Equal
  {
    std::size_t first;
    bool        isCounted;
  };

  void
  TakeUp(std::size_t t, const BytesFingerprint & fingerprint, bool isCounted);

  std::size_t                             m_Frames;
  std::map<std::size_t, BytesFingerprint> m_OfFrame;
  std::map<BytesFingerprint, Equal>       m_Equal;
  std::vector<std::uint8_t>               m_CountedElsewhere; // one value for each frame; empty: none
};

/** \class StackMoments
 * \brief Result of the first pass: the temporal moments of every pixel, the mean of every frame, and the frames that
 * are equal.
 *
 * A frame that equals an earlier frame is not summed: the moments are over the distinct frames.
 *
 * Frames may be added in parts, in several processes, and the parts merged. Integers are summed exactly, in any order.
 * Parts with floating-point pixels are kept and merged in the order of their first frames, so that the result has the
 * same bits for any order of merges. */
template <typename TPixel>
class StackMoments
{
public:
  StackMoments(std::size_t pixels, std::size_t frames, const ParallelFor & parallelFor = SerialFor);

  /** Adds frames first ... first + count - 1, stored one after the other. */
  void
  AddFrames(const TPixel * frames, std::size_t first, std::size_t count, const ParallelFor & parallelFor)
  {
    AddFrames({ { this, PixelLayout::OfPixels(m_Pixels, m_Pixels), nullptr } }, frames, first, count, parallelFor);
  }

  /** The moments of one of the planes of a mosaic, the layout of its pixels, and its mask, which is 0 at the pixels
   * that the means of the frames leave out; null: they leave out none. */
  struct Plane
  {
    StackMoments *       moments;
    PixelLayout          layout;
    const std::uint8_t * mask{ nullptr };
  };
  /** Adds the frames to all \a planes, of one size. A row is read for all planes while it is in the cache. */
  static void
  AddFrames(const std::vector<Plane> & planes,
            const TPixel *             frames,
            std::size_t                first,
            std::size_t                count,
            const ParallelFor &        parallelFor);

  /** Marks the frames that another process counts, see FrameFingerprints. To be called before they are added. */
  void
  SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere)
  {
    m_Fingerprints.SetCountedElsewhere(areCountedElsewhere);
  }

  /** Merges the parts with floating-point pixels, which releases their memory. From then on the bits of the result
   * depend on the order of merges. */
  void
  Fold();

  const FrameFingerprints &
  GetFingerprints() const
  {
    return m_Fingerprints;
  }

  /** Writes the moments and means, see BinaryStream. */
  void
  Save(std::ostream & out) const;

  /** Adds the moments and means of other frames from a stream. Throws std::runtime_error, and changes nothing, if the
   * stream ends early or holds something else. The same happens if both parts have summed the same frame or equal
   * frames, because a frame cannot be subtracted. */
  void
  Merge(std::istream & in);

  /** Returns the moments of the distinct frames. The object is empty afterwards. */
  TemporalMoments<TPixel>
  Take();

  /** Means over the finite pixels of all frames, also of the frames that were not summed [DN]. */
  const std::vector<double> &
  GetFrameMeans() const
  {
    return m_FrameMeans;
  }
  /** Returns which frames are equal, after all have been added. */
  DistinctFrames
  FindDistinct() const
  {
    return m_Fingerprints.FindDistinct();
  }

private:
  /** Adds frames that are not repeated. */
  static void
  AddDistinct(const std::vector<Plane> & planes,
              const TPixel *             frames,
              std::size_t                count,
              const ParallelFor &        parallelFor);

  std::size_t             m_Pixels;
  std::vector<double>     m_FrameMeans; // means of the frames [DN]; 0 where a frame was not added
  FrameFingerprints       m_Fingerprints;
  TemporalMoments<TPixel> m_Own;
  std::size_t             m_First{ std::numeric_limits<std::size_t>::max() }; // number of the first frame in m_Own

  std::map<std::size_t, TemporalMoments<TPixel>> m_Others; // keys: numbers of their first frames
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT StackMoments<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
