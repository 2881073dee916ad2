/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_base_FrameGeometry_h
#define sensornoise_base_FrameGeometry_h

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
