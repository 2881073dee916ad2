// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_PlaneFrames_h
#define sensornoise_mosaic_PlaneFrames_h

#include "sensornoise/base/FramesTogether.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/mosaic/MosaicGeometry.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise
{

/** \class PlaneFrames
 * \brief Hands on the frames of a mosaic plane by plane, a few at a time.
 *
 * Holds those of one plane: at most 16 MiB, or FramesTogether. */
template <typename TPixel>
class PlaneFrames
{
public:
  explicit PlaneFrames(const MosaicGeometry & geometry)
    : m_Geometry(geometry)
  {}

  const MosaicGeometry &
  GetGeometry() const
  {
    return m_Geometry;
  }

  /** Calls function(k, frames, count), k from 0 to 3 in the order of BayerPlanes, for as many frames of that plane as
   * are copied together, until all \a count frames of the mosaic are through. */
  template <typename TFunction>
  void
  ForPlanes(const TPixel * mosaics, std::size_t count, const ParallelFor & parallelFor, TFunction function)
  {
    constexpr std::size_t bytesTogether = std::size_t{ 16 } << 20;
    const std::size_t     pixels = m_Geometry.Plane().Pixels();
    const std::size_t     most = std::max(FramesTogether, bytesTogether / (pixels * sizeof(TPixel)));
    for (std::size_t first = 0; first < count; first += most)
    {
      const std::size_t now = std::min(most, count - first);
      m_Buffer.resize(std::max(m_Buffer.size(), pixels * now));
      for (std::size_t k = 0; k < BayerPlanes.size(); ++k)
      {
        m_Geometry.TakeFrames(
          mosaics + first * m_Geometry.frame.Pixels(), now, BayerPlanes[k], m_Buffer.data(), parallelFor);
        function(k, m_Buffer.data(), now);
      }
    }
  }

  /** Gives the memory back. */
  void
  Release()
  {
    m_Buffer = {};
  }

private:
  MosaicGeometry      m_Geometry;
  std::vector<TPixel> m_Buffer;
};

} // namespace sensornoise

#endif
