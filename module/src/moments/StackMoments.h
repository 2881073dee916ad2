// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackMoments_h
#define sensornoise_moments_StackMoments_h

#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "sensornoise/FrameGeometry.h"
#include "moments/DistinctFrames.h"
#include "moments/FrameFingerprints.h"
#include "moments/TemporalMoments.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <istream>
#include <limits>
#include <map>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class StackMoments
 * \brief Result of the first pass: the temporal moments of every pixel, the mean of every frame, and the frames that
 * are equal.
 *
 * A frame that equals an earlier one is not summed: the moments are over the distinct frames.
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
    AddFrames({ { this, PixelLayout::OfPixels(m_Pixels, m_Pixels) } }, frames, first, count, parallelFor);
  }

  /** The moments of one of the planes of a mosaic, and the layout of its pixels. */
  struct Plane
  {
    StackMoments * moments;
    PixelLayout    layout;
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

  /** Means of all frames, also of the frames that were not summed [DN]. */
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

  std::map<std::size_t, TemporalMoments<TPixel>> m_Others; // by the numbers of their first frames
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT StackMoments<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
