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
 * \brief The time series of the sampled pixels above their means: what frames and neighbours share is measured on them.
 *
 * FrameSample gathers it. Memory: at most 32 MiB. */
class SensorNoise_EXPORT NoiseSample
{
public:
  NoiseSample() = default;
  /** \a values: as SampleTiles::PlaceOf() tells [DN above the pixel's mean], of frames of \a width columns. */
  NoiseSample(SampleTiles tiles, std::size_t width, Eigen::ArrayXf values)
    : m_Tiles(std::move(tiles))
    , m_Width(width)
    , m_Values(std::move(values))
  {}

  /** Leaves out the first frames. */
  void
  DropFirst(std::size_t frames);

  /** Leaves out all frames but these, which grow. */
  void
  KeepFrames(const std::vector<std::size_t> & frames);

  const SampleTiles &
  GetTiles() const
  {
    return m_Tiles;
  }
  /** The values of tile \a i: frame by frame, each of them row by row [DN above the pixel's mean]. */
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
  /** The pixel of the frame that is pixel \a p of tile \a i. */
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
