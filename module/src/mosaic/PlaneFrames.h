// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_PlaneFrames_h
#define sensornoise_mosaic_PlaneFrames_h

#include "base/Eigen.h"
#include "base/Simd.h"
#include "sensornoise/Parallel.h"
#include "mosaic/MosaicGeometry.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sensornoise
{

/** \class PlaneFrames
 * \brief Copies the frames of a mosaic plane by plane, a few at a time, for functions that read scattered pixels.
 *
 * Each part of the mosaic is read once for all planes. */
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

  /** Calls function(k, frames, count) for each plane k, in the order of BayerPlanes, with \a count frames of that plane
   * that were copied together. Repeats this until all \a count frames of \a mosaics have been copied. */
  template <typename TFunction>
  void
  ForPlanes(const TPixel * mosaics, std::size_t count, const ParallelFor & parallelFor, TFunction function)
  {
    const std::size_t pixels = m_Geometry.Plane().Pixels();
    const std::size_t most = std::max(FramesTogether, BytesTogether / (pixels * sizeof(TPixel)));
    for (std::size_t first = 0; first < count; first += most)
    {
      const std::size_t       now = std::min(most, count - first);
      const std::size_t       size = BayerPlanes.size() * pixels * now;
      std::array<TPixel *, 4> planes{};
      m_Buffer.resize(std::max(m_Buffer.size(), static_cast<Eigen::Index>(size)));
      for (std::size_t k = 0; k < planes.size(); ++k)
      {
        planes[k] = m_Buffer.data() + k * pixels * now;
      }
      m_Geometry.TakeFrames(mosaics + first * m_Geometry.frame.Pixels(), now, planes, parallelFor);
      for (std::size_t k = 0; k < planes.size(); ++k)
      {
        function(k, planes[k], now);
      }
    }
  }

private:
  /** Bytes of each plane that are copied together. Chosen empirically with the published method, when it still copied
   * its planes: with half of them it took a tenth longer, with twice as many as long and more memory. */
  static constexpr std::size_t BytesTogether = std::size_t{ 8 } << 20;

  MosaicGeometry                          m_Geometry;
  Eigen::Array<TPixel, Eigen::Dynamic, 1> m_Buffer; // unlike std::vector, not filled by one thread
};

} // namespace sensornoise

#endif
