// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_SampleTiles_h
#define sensornoise_correlation_SampleTiles_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** The axis of lines of a frame whose pixels have noise or illumination in common. */
enum class LineAxis : std::uint8_t
{
  Rows,
  Columns
};

/** \class SampleTiles
 * \brief Square tiles, spread evenly over the frame without overlap, and the first frames of the stack, in which the
 * noise is sampled.
 *
 * They depend on the size of the stack alone. Pairs of pixels lie within a tile. The tiles are the blocks of the
 * jackknife. */
struct SensorNoise_EXPORT SampleTiles
{
  /** Largest number of pixels in all tiles (estimator.md, 3.12): the error of coefficients is 0.0004 for 100 frames.
   * Chosen empirically: half and twice the number change the errors by its square root, and the cost in proportion. */
  static constexpr std::size_t MostPixels = std::size_t{ 1 } << 17;
  /** Largest number of values in all tiles, of 2 or 4 bytes: 16 or 32 MiB, see MostValuesOf(). */
  static constexpr std::size_t MostValues = std::size_t{ 1 } << 23;
  /** Number of values for each pixel of a frame, and the number that a small frame may always have. Chosen empirically,
   * so that the four planes of a mosaic need no more memory than one frame of its size. With half the number, errors
   * are 1.4 times as large; with twice the number, a mosaic of 1.4 megapixels needs a tenth more memory than one
   * frame. */
  static constexpr std::size_t MostValuesPerPixel = 8;
  static constexpr std::size_t MostValuesOfSmall = std::size_t{ 1 } << 22;
  /** Largest number of frames. More frames would leave too few tiles to cover all levels, and would not improve the
   * temporal correlation. */
  static constexpr std::size_t MostFrames = 256;
  /** Number of tiles that a jackknife needs for an error to 20 %. */
  static constexpr std::size_t EnoughTiles = 16;
  /** Side of a tile [pixels], and its value where fewer than EnoughTiles tiles would fit. */
  static constexpr std::size_t Side = 32;
  static constexpr std::size_t SmallSide = 16;

  struct Origin
  {
    std::size_t x;
    std::size_t y;
  };

  /** Returns the largest number of values in all tiles, for frames of \a pixels pixels. */
  static constexpr std::size_t
  MostValuesOf(std::size_t pixels)
  {
    return std::clamp(MostValuesPerPixel * pixels, MostValuesOfSmall, MostValues);
  }

  std::size_t         side{ 0 };   ///< [pixels]
  std::size_t         frames{ 0 }; ///< number of frames, which are the first of the stack
  std::vector<Origin> origins;     ///< upper left pixels of the tiles

  /** Returns the number of pixels of one tile. */
  std::size_t
  Pixels() const
  {
    return side * side;
  }
  /** Returns the number of values of all tiles and frames. */
  std::size_t
  Values() const
  {
    return origins.size() * frames * this->Pixels();
  }
  /** Returns the index of the first value of tile \a i in frame \a t. Values are ordered by tile, frame and row. */
  std::size_t
  PlaceOf(std::size_t i, std::size_t t) const
  {
    return (i * frames + t) * this->Pixels();
  }
  /** Returns the index in its tile of pixel \a k of line \a line. */
  std::size_t
  InTile(LineAxis axis, std::size_t line, std::size_t k) const
  {
    return axis == LineAxis::Rows ? line * side + k : k * side + line;
  }
  /** Returns the index, in a frame of \a width columns, of pixel \a p of tile \a i. */
  std::size_t
  PixelOf(std::size_t i, std::size_t p, std::size_t width) const
  {
    return (origins[i].y + p / side) * width + origins[i].x + p % side;
  }
};

/** Returns the tiles for a stack of \a frames frames; none if the frame is smaller than a tile. */
SensorNoise_EXPORT SampleTiles
MakeSampleTiles(const FrameGeometry & geometry, std::size_t frames);

/** Returns the tiles that lie in one line, group by group: the indices of the tiles at the same rows or columns. */
SensorNoise_EXPORT std::vector<std::vector<std::size_t>>
TilesInLine(const SampleTiles & tiles, LineAxis axis);

} // namespace sensornoise

#endif
