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
 * macro(TPixel) for each type of the pixels of frames, as a statement: with it templates are instantiated in the
 * library alone. */
#define SensorNoise_FOR_PIXEL_TYPES(macro) \
  macro(unsigned char);                    \
  macro(unsigned short);                   \
  macro(short);                            \
  macro(float);                            \
  macro(double)

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

/** The colours of the upper left 2 x 2 pixels of a mosaic, row by row. */
enum class BayerPattern : std::uint8_t
{
  RGGB,
  GRBG,
  GBRG,
  BGGR
};

/** A plane of a mosaic: its pixels of one place in each 2 x 2. G1 is the green in the rows of red, G2 that in the rows
 * of blue (Gr and Gb of others). */
enum class BayerPlane : std::uint8_t
{
  R,
  G1,
  G2,
  B
};

/** All planes, in the order in which records have them. */
inline constexpr std::array<BayerPlane, 4> BayerPlanes{
  { BayerPlane::R, BayerPlane::G1, BayerPlane::G2, BayerPlane::B }
};

SensorNoise_EXPORT const char *
NameOf(BayerPattern pattern);

SensorNoise_EXPORT const char *
NameOf(BayerPlane plane);

/** The pattern by its name, "RGGB" for example. Throws std::invalid_argument for any other. */
SensorNoise_EXPORT BayerPattern
BayerPatternOf(const std::string & name);

/** The plane by its name, "R", "G1", "G2" or "B". Throws std::invalid_argument for any other. */
SensorNoise_EXPORT BayerPlane
BayerPlaneOf(const std::string & name);

/** Column and row of the plane's first pixel in the mosaic, 0 or 1 each. */
SensorNoise_EXPORT std::array<std::size_t, 2>
CornerOf(BayerPattern pattern, BayerPlane plane);

/** The pattern of what is left of a mosaic when \a columns and \a rows were cut off its left and upper side. */
SensorNoise_EXPORT BayerPattern
CutPattern(BayerPattern pattern, std::size_t columns, std::size_t rows);

} // namespace sensornoise

#endif
