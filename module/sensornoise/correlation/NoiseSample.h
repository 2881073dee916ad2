// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_NoiseSample_h
#define sensornoise_correlation_NoiseSample_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/correlation/SampleTiles.h"

#include <cstddef>
#include <istream>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class NoiseSample
 * \brief The whole series of some pixels, gathered in the third pass: what frames and neighbours share needs them.
 *
 * Values are held above the pixel's mean, in 4 bytes; what is not finite is held as 0. Frames may be added in any order
 * and parts merged in any order, with the same bits. Memory: at most 32 MiB. */
class SensorNoise_EXPORT NoiseSample
{
public:
  NoiseSample() = default;
  NoiseSample(const FrameGeometry & geometry, std::size_t frames);

  /** Adds frames firstFrame ... firstFrame + count - 1, stored one after the other; \a mean is that of every pixel. */
  template <typename TPixel>
  void
  AddFrames(const TPixel *              frames,
            std::size_t                 firstFrame,
            std::size_t                 count,
            const std::vector<double> & mean,
            const ParallelFor &         parallelFor = SerialFor);

  /** Leaves out the first frames. */
  void
  DropFirst(std::size_t frames);

  /** Leaves out all frames but these, which grow. */
  void
  KeepFrames(const std::vector<std::size_t> & frames);

  /** Adds the sample of other frames of the same stack. */
  void
  Merge(const NoiseSample & other);

  /** Writes the sample, see BinaryStream. */
  void
  Save(std::ostream & out) const;

  /** Replaces the sample by that of a stream. Throws std::runtime_error, and changes nothing, if it holds another one,
   * or ends early. */
  void
  Restore(std::istream & in);

  const SampleTiles &
  GetTiles() const
  {
    return m_Tiles;
  }
  /** The values of tile \a i: frame by frame, each of them row by row [DN above the pixel's mean]. */
  float *
  OfTile(std::size_t i)
  {
    return m_Values.data() + i * m_Tiles.frames * m_Tiles.Pixels();
  }
  const float *
  OfTile(std::size_t i) const
  {
    return m_Values.data() + i * m_Tiles.frames * m_Tiles.Pixels();
  }
  /** The pixel of the frame that is pixel \a p of tile \a i. */
  std::size_t
  PixelOf(std::size_t i, std::size_t p) const
  {
    const SampleTiles::Origin & origin = m_Tiles.origins[i];
    return (origin.y + p / m_Tiles.side) * m_Width + origin.x + p % m_Tiles.side;
  }

private:
  SampleTiles        m_Tiles;
  std::size_t        m_Width{ 0 };
  std::size_t        m_FramePixels{ 0 };
  std::vector<float> m_Values;
};

} // namespace sensornoise

#endif
