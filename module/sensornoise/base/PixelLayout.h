// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_PixelLayout_h
#define sensornoise_base_PixelLayout_h

#include "sensornoise/base/FrameGeometry.h"

#include <cstddef>

namespace sensornoise
{

/** Where the pixels of frames stand in memory: one after the other, or every second one, as a plane of a mosaic. */
struct PixelLayout
{
  std::size_t first{ 0 }; ///< place of the first pixel
  std::size_t step{ 1 };  ///< from a pixel to the next one of its row: 1 or 2
  std::size_t row{ 0 };   ///< from a row to the next one
  std::size_t frame{ 0 }; ///< from a frame to the next one

  /** Frames one after the other. */
  static PixelLayout
  OfFrames(const FrameGeometry & geometry)
  {
    return { 0, 1, geometry.width, geometry.Pixels() };
  }

  /** Place of a pixel of the first frame. */
  std::size_t
  At(std::size_t x, std::size_t y) const
  {
    return first + y * row + x * step;
  }
};

} // namespace sensornoise

#endif
