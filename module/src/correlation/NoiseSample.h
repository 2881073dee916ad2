// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_NoiseSample_h
#define sensornoise_correlation_NoiseSample_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/SampleTiles.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class NoiseSample
 * \brief Time series of the sampled pixels above their means, on which the noise correlation is measured.
 *
 * FrameSample gathers it. Memory: at most 32 MiB. */
class SensorNoise_EXPORT NoiseSample
{
public:
  NoiseSample() = default;
  /** Makes a sample of frames of \a width columns. \a values are in the order of SampleTiles::PlaceOf() [DN above the
   * pixel's mean]. */
  NoiseSample(SampleTiles tiles, std::size_t width, Eigen::ArrayXf values)
    : m_Tiles(std::move(tiles))
    , m_Width(width)
    , m_Values(std::move(values))
  {}

  /** Leaves out the first \a frames frames. */
  void
  DropFirst(std::size_t frames);

  /** Leaves out all frames except \a frames, which must be in increasing order. */
  void
  KeepFrames(const std::vector<std::size_t> & frames);

  const SampleTiles &
  GetTiles() const
  {
    return m_Tiles;
  }
  /** Returns the values of tile \a i: frame by frame, row by row in each frame [DN above the pixel's mean]. */
  float *
  OfTile(std::size_t i)
  {
    return m_Values.data() + m_Tiles.PlaceOf(i, 0);
  }
  const float *
  OfTile(std::size_t i) const
  {
    return m_Values.data() + m_Tiles.PlaceOf(i, 0);
  }
  /** Returns the index in the frame of pixel \a p of tile \a i. */
  std::size_t
  PixelOf(std::size_t i, std::size_t p) const
  {
    return m_Tiles.PixelOf(i, p, m_Width);
  }

private:
  SampleTiles    m_Tiles;
  std::size_t    m_Width{ 0 };
  Eigen::ArrayXf m_Values;
};

} // namespace sensornoise

#endif
