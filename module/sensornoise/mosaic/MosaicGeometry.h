// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_mosaic_MosaicGeometry_h
#define sensornoise_mosaic_MosaicGeometry_h

#include "sensornoise/base/BayerPattern.h"
#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/Parallel.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Where the pixels of each plane stand in a frame behind a mosaic. All planes have the same size: half the frame's,
 * the last column or row left out where its number is odd. */
struct MosaicGeometry
{
  FrameGeometry frame;
  BayerPattern  pattern{ BayerPattern::RGGB };

  /** Of each plane. */
  FrameGeometry
  Plane() const
  {
    return { frame.width / 2, frame.height / 2, frame.shutterAxis };
  }

  /** Values of the frame's pixels that are the plane's; none of none. */
  template <typename T>
  std::vector<T>
  Take(const std::vector<T> & ofFrame, BayerPlane plane) const
  {
    std::vector<T> ofPlane(ofFrame.empty() ? 0 : this->Plane().Pixels());
    if (!ofPlane.empty())
    {
      this->ForPixels(
        plane, SerialFor, [&](std::size_t inPlane, std::size_t inFrame) { ofPlane[inPlane] = ofFrame[inFrame]; });
    }
    return ofPlane;
  }

  /** Writes the plane's values where they stand in the frame. Nothing, if there are none. */
  template <typename T>
  void
  Put(const std::vector<T> & ofPlane, BayerPlane plane, T * ofFrame, const ParallelFor & parallelFor = SerialFor) const
  {
    if (!ofPlane.empty())
    {
      this->ForPixels(
        plane, parallelFor, [&](std::size_t inPlane, std::size_t inFrame) { ofFrame[inFrame] = ofPlane[inPlane]; });
    }
  }

  /** Copies the two planes that stand in the same rows, of \a count frames that lie one after the other: those of the
   * red rows, R and G1, or of the blue ones, G2 and B. There must be room for each of them in \a to. */
  template <typename TPixel>
  void
  TakeFrames(const TPixel * frames,
             std::size_t    count,
             bool           areRedRows,
             TPixel * const (&to)[2],
             const ParallelFor & parallelFor) const
  {
    const FrameGeometry              size = this->Plane();
    const std::array<std::size_t, 2> corner = CornerOf(pattern, areRedRows ? BayerPlane::R : BayerPlane::G2);
    TPixel * const                   left = to[corner[0]];
    TPixel * const                   right = to[1 - corner[0]];
    parallelFor(count * size.height, [&](std::size_t row) {
      const std::size_t y = 2 * (row % size.height) + corner[1];
      const TPixel *    from = frames + row / size.height * frame.Pixels() + y * frame.width;
      TPixel *          toLeft = left + row * size.width;
      TPixel *          toRight = right + row * size.width;
      for (std::size_t x = 0; x < size.width; ++x)
      {
        toLeft[x] = from[2 * x];
        toRight[x] = from[2 * x + 1];
      }
    });
  }

private:
  template <typename TFunction>
  void
  ForPixels(BayerPlane plane, const ParallelFor & parallelFor, TFunction function) const
  {
    const FrameGeometry              size = this->Plane();
    const std::array<std::size_t, 2> corner = CornerOf(pattern, plane);
    parallelFor(size.height, [&](std::size_t y) {
      for (std::size_t x = 0; x < size.width; ++x)
      {
        function(y * size.width + x, (2 * y + corner[1]) * frame.width + 2 * x + corner[0]);
      }
    });
  }
};

} // namespace sensornoise

#endif
