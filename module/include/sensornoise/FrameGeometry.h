// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_FrameGeometry_h
#define sensornoise_FrameGeometry_h

#include "SensorNoiseExport.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

/** \def SensorNoise_FOR_PIXEL_TYPES
 * Expands to the statement macro(TPixel) for each type of the pixels of a frame. Templates are instantiated with it, in
 * the library alone. */
#define SensorNoise_FOR_PIXEL_TYPES(macro) \
  macro(unsigned char);                    \
  macro(unsigned short);                   \
  macro(short);                            \
  macro(float);                            \
  macro(double)

namespace sensornoise
{

/** Size of a frame, and the axis along which its rows are exposed one after the other. */
struct FrameGeometry
{
  std::size_t  width{ 0 };       ///< columns of the frame [pixel]
  std::size_t  height{ 0 };      ///< rows of the frame [pixel]
  unsigned int shutterAxis{ 1 }; ///< 1: the shutter travels along y, row by row; 0: along x, column by column

  /** Returns the number of pixels of a frame. */
  std::size_t
  Pixels() const
  {
    return width * height;
  }
  /** Returns the number of lines that are exposed one after the other: columns if the shutter travels along x. */
  std::size_t
  Rows() const
  {
    return shutterAxis == 0 ? width : height;
  }
  /** Returns the number of the line of pixel \a p among Rows(), from 0. \a p counts the pixels row by row, from 0. */
  std::size_t
  RowOf(std::size_t p) const
  {
    return shutterAxis == 0 ? p % width : p / width;
  }
};

/** Colours of the upper left 2 x 2 pixels of a mosaic, row by row. */
enum class BayerPattern : std::uint8_t
{
  RGGB,
  GRBG,
  GBRG,
  BGGR
};

/** Planes of a mosaic. A plane consists of the pixels at one place of each 2 x 2 block. G1 is the green plane in the
 * rows of red, also called Gr. G2 is the green plane in the rows of blue, also called Gb. */
enum class BayerPlane : std::uint8_t
{
  R,
  G1,
  G2,
  B
};

/** All planes, in the order of the records. */
inline constexpr std::array<BayerPlane, 4> BayerPlanes{
  { BayerPlane::R, BayerPlane::G1, BayerPlane::G2, BayerPlane::B }
};

/** Returns the name of the pattern, for example "RGGB". */
SensorNoise_EXPORT const char *
NameOf(BayerPattern pattern);

/** Returns the name of the plane: "R", "G1", "G2" or "B". */
SensorNoise_EXPORT const char *
NameOf(BayerPlane plane);

/** Returns the pattern with this name, for example "RGGB". Throws std::invalid_argument for any other name. */
SensorNoise_EXPORT BayerPattern
BayerPatternOf(const std::string & name);

/** Returns the plane with this name: "R", "G1", "G2" or "B". Throws std::invalid_argument for any other name. */
SensorNoise_EXPORT BayerPlane
BayerPlaneOf(const std::string & name);

/** Returns column and row of the first pixel of the plane in the mosaic, 0 or 1 each. */
SensorNoise_EXPORT std::array<std::size_t, 2>
CornerOf(BayerPattern pattern, BayerPlane plane);

/** Returns the pattern of a mosaic after \a columns were cut off its left side and \a rows off its upper side. */
SensorNoise_EXPORT BayerPattern
CutPattern(BayerPattern pattern, std::size_t columns, std::size_t rows);

} // namespace sensornoise

#endif
