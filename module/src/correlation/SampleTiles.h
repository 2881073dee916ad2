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

/** The lines of a frame that have something in common: its rows, or its columns. */
enum class LineAxis : std::uint8_t
{
  Rows,
  Columns
};

/** \class SampleTiles
 * \brief Where the noise of neighbours is looked at: square tiles, spread evenly over the frame, that do not overlap,
 * and the first frames of the stack.
 *
 * They depend on the size of the stack alone. Pairs of pixels are made within a tile only; the tiles are the blocks of
 * the jackknife. */
struct SensorNoise_EXPORT SampleTiles
{
  /** Pixels of all tiles (estimator.md, 3.12): coefficients of 100 frames come out to 0.0004. Set by hand: half and
   * twice change errors and cost, as the square root and in proportion. */
  static constexpr std::size_t MostPixels = std::size_t{ 1 } << 17;
  /** Values of all tiles, of 2 or 4 bytes: 16 or 32 MiB, see MostValuesOf(). */
  static constexpr std::size_t MostValues = std::size_t{ 1 } << 23;
  /** Values for each pixel of a frame, and what a small frame may have however few it is. Set by hand, so that the four
   * planes of a mosaic have no more memory than one frame of its size: with half of it the errors are 1.4 times as
   * large, with twice, a mosaic of 1.4 megapixels takes a tenth more memory than that frame. */
  static constexpr std::size_t MostValuesPerPixel = 8;
  static constexpr std::size_t MostValuesOfSmall = std::size_t{ 1 } << 22;
  /** Frames; more would leave too few tiles to see all levels, and tell no more of what frames share. */
  static constexpr std::size_t MostFrames = 256;
  /** Tiles that a jackknife needs for an error to 20 %. */
  static constexpr std::size_t EnoughTiles = 16;
  /** Side of a tile [pixels], and where fewer than EnoughTiles of them would fit. */
  static constexpr std::size_t Side = 32;
  static constexpr std::size_t SmallSide = 16;

  struct Origin
  {
    std::size_t x;
    std::size_t y;
  };

  /** Values of all tiles in frames of \a pixels pixels. */
  static constexpr std::size_t
  MostValuesOf(std::size_t pixels)
  {
    return std::clamp(MostValuesPerPixel * pixels, MostValuesOfSmall, MostValues);
  }

  std::size_t         side{ 0 };   ///< [pixels]
  std::size_t         frames{ 0 }; ///< of the stack's first
  std::vector<Origin> origins;     ///< upper left pixels

  /** Of one tile. */
  std::size_t
  Pixels() const
  {
    return side * side;
  }
  /** Of all tiles and frames. */
  std::size_t
  Values() const
  {
    return origins.size() * frames * this->Pixels();
  }
  /** Where the values of tile \a i in frame \a t begin: tile by tile, frame by frame, row by row. */
  std::size_t
  PlaceOf(std::size_t i, std::size_t t) const
  {
    return (i * frames + t) * this->Pixels();
  }
  /** The number in its tile of pixel \a k of line \a line. */
  std::size_t
  InTile(LineAxis axis, std::size_t line, std::size_t k) const
  {
    return axis == LineAxis::Rows ? line * side + k : k * side + line;
  }
  /** The pixel of a frame of \a width columns that is pixel \a p of tile \a i. */
  std::size_t
  PixelOf(std::size_t i, std::size_t p, std::size_t width) const
  {
    return (origins[i].y + p / side) * width + origins[i].x + p % side;
  }
};

/** The tiles of a stack of \a frames frames; none if the frame is smaller than one. */
SensorNoise_EXPORT SampleTiles
MakeSampleTiles(const FrameGeometry & geometry, std::size_t frames);

/** The tiles whose lines continue each other, group by group. */
SensorNoise_EXPORT std::vector<std::vector<std::size_t>>
TilesInLine(const SampleTiles & tiles, LineAxis axis);

} // namespace sensornoise

#endif
