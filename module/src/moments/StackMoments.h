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
 * \brief The first pass: the temporal moments of every pixel, the mean of every frame, and which frames are equal.
 *
 * A frame that equals one before is not summed: the moments are those of the distinct frames.
 *
 * Frames may be added in parts, here and in other processes, and the parts merged. Integers are summed exactly, in any
 * order. Parts with floating-point pixels are kept and merged in the order of their first frames: the same bits whoever
 * merges what first. */
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

  /** The moments of one of the planes of a mosaic, and how its pixels stand there. */
  struct Plane
  {
    StackMoments * moments;
    PixelLayout    layout;
  };
  /** Adds the frames to all \a planes, of one size: what one has read of a row is near when the next comes to it. */
  static void
  AddFrames(const std::vector<Plane> & planes,
            const TPixel *             frames,
            std::size_t                first,
            std::size_t                count,
            const ParallelFor &        parallelFor);

  /** What to do with frames that another process counts, see FrameFingerprints. Before they are added. */
  void
  SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere)
  {
    m_Fingerprints.SetCountedElsewhere(areCountedElsewhere);
  }

  /** Merges the parts with floating-point pixels that are kept, which gives back their memory: from now on the order of
   * merges counts. */
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

  /** Adds the moments and means of other frames from a stream. Throws std::runtime_error, and changes nothing, if it
   * ends early, does not hold them, or summed a frame that equals one summed here: that one cannot be taken off. */
  void
  Merge(std::istream & in);

  /** The moments of the distinct frames. What was added is given away. */
  TemporalMoments<TPixel>
  Take();

  /** Of all frames, also of those that were not summed. */
  const std::vector<double> &
  GetFrameMeans() const
  {
    return m_FrameMeans;
  }
  /** Which frames are equal, when all have been added. */
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
  std::vector<double>     m_FrameMeans; // 0 where a frame was not added
  FrameFingerprints       m_Fingerprints;
  TemporalMoments<TPixel> m_Own;
  std::size_t             m_First{ std::numeric_limits<std::size_t>::max() }; // frame of m_Own

  std::map<std::size_t, TemporalMoments<TPixel>> m_Others; // by their first frames
};

#define SensorNoise_EXTERN(TPixel) extern template class SensorNoise_EXPORT StackMoments<TPixel>
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_EXTERN);
#undef SensorNoise_EXTERN

} // namespace sensornoise

#endif
