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
    this->ForPixels(plane, [&](std::size_t inPlane, std::size_t inFrame) {
      if (!ofPlane.empty())
      {
        ofPlane[inPlane] = ofFrame[inFrame];
      }
    });
    return ofPlane;
  }

  /** Writes the plane's values where they stand in the frame. Nothing, if there are none. */
  template <typename T>
  void
  Put(const std::vector<T> & ofPlane, BayerPlane plane, T * ofFrame) const
  {
    this->ForPixels(plane, [&](std::size_t inPlane, std::size_t inFrame) {
      if (!ofPlane.empty())
      {
        ofFrame[inFrame] = ofPlane[inPlane];
      }
    });
  }

  /** Copies one plane of \a count frames, one after the other, to \a to, which has room for them. */
  template <typename TPixel>
  void
  TakeFrames(const TPixel * frames, std::size_t count, BayerPlane plane, TPixel * to, const ParallelFor & parallelFor)
    const
  {
    const FrameGeometry              size = this->Plane();
    const std::array<std::size_t, 2> corner = CornerOf(pattern, plane);
    parallelFor(count * size.height, [&](std::size_t row) {
      const std::size_t y = 2 * (row % size.height) + corner[1];
      const TPixel *    from = frames + row / size.height * frame.Pixels() + y * frame.width + corner[0];
      TPixel *          toRow = to + row * size.width;
      for (std::size_t x = 0; x < size.width; ++x)
      {
        toRow[x] = from[2 * x];
      }
    });
  }

private:
  template <typename TFunction>
  void
  ForPixels(BayerPlane plane, TFunction function) const
  {
    const FrameGeometry              size = this->Plane();
    const std::array<std::size_t, 2> corner = CornerOf(pattern, plane);
    for (std::size_t y = 0; y < size.height; ++y)
    {
      for (std::size_t x = 0; x < size.width; ++x)
      {
        function(y * size.width + x, (2 * y + corner[1]) * frame.width + 2 * x + corner[0]);
      }
    }
  }
};

} // namespace sensornoise

#endif
