// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_PlaneFrames_h
#define sensornoise_mosaic_PlaneFrames_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/FramesTogether.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/mosaic/MosaicGeometry.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

/** \class PlaneFrames
 * \brief Hands on the frames of a mosaic plane by plane, a few at a time.
 *
 * Holds those of two planes, which stand in the same rows of the mosaic. */
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

  /** Calls function(k, frames, count), for the planes k from \a firstPlane on and below \a lastPlane, both even, in the
   * order of BayerPlanes, for as many frames of that plane as are copied together, until all \a count frames of the
   * mosaic are through. */
  template <typename TFunction>
  void
  ForPlanes(const TPixel *      mosaics,
            std::size_t         count,
            std::size_t         firstPlane,
            std::size_t         lastPlane,
            const ParallelFor & parallelFor,
            TFunction           function)
  {
    const std::size_t pixels = m_Geometry.Plane().Pixels();
    const std::size_t most = std::max(FramesTogether, BytesOfPlane / (pixels * sizeof(TPixel)));
    for (std::size_t first = 0; first < count; first += most)
    {
      const std::size_t now = std::min(most, count - first);
      m_Buffer.resize(std::max(m_Buffer.size(), static_cast<Eigen::Index>(2 * pixels * now)));
      TPixel * const planes[2] = { m_Buffer.data(), m_Buffer.data() + pixels * now };
      for (std::size_t k = firstPlane; k < lastPlane; k += 2)
      {
        m_Geometry.TakeFrames(mosaics + first * m_Geometry.frame.Pixels(), now, k == 0, planes, parallelFor);
        function(k, planes[0], now);
        function(k + 1, planes[1], now);
      }
    }
  }

  /** Gives the memory back. */
  void
  Release()
  {
    m_Buffer.resize(0);
  }

private:
  /** At most so many bytes of a plane are copied together, or FramesTogether. Set by hand: what is made anew of the
   * pixels for each part makes an estimate with half of it 5 % slower; with twice it is not faster. */
  static constexpr std::size_t BytesOfPlane = std::size_t{ 16 } << 20;

  MosaicGeometry                          m_Geometry;
  Eigen::Array<TPixel, Eigen::Dynamic, 1> m_Buffer; // unlike std::vector, not filled by one thread
};

} // namespace sensornoise

#endif
