// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_FrameGeometry_h
#define sensornoise_FrameGeometry_h

#include <cstddef>

namespace sensornoise
{

/** Size of a frame and the axis along which its rows are exposed one after the other. */
struct FrameGeometry
{
  std::size_t  width{ 0 };
  std::size_t  height{ 0 };
  unsigned int shutterAxis{ 1 }; ///< 1: the shutter travels along y, row by row; 0: along x, column by column

  std::size_t
  Pixels() const
  {
    return width * height;
  }
  /** Rows as the shutter sees them: columns of the frame where it travels along x. */
  std::size_t
  Rows() const
  {
    return shutterAxis == 0 ? width : height;
  }
  /** Row of pixel \a p as the shutter sees it. */
  std::size_t
  RowOf(std::size_t p) const
  {
    return shutterAxis == 0 ? p % width : p / width;
  }
};

} // namespace sensornoise

#endif
