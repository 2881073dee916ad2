// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_PartTiles_h
#define sensornoise_pixels_PartTiles_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceLine.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** Ways to divide a burst into parts that may differ in their gain: the pixels by place or by phase, which is their
 * position in a repeating pattern, and the frames. */
enum class Partition : std::uint8_t
{
  LeftRight,
  UpperLower,
  Quadrants,
  Blocks,
  SmoothField, ///< a polynomial of the place; reported for the parts of Blocks
  Columns2,
  Rows2,
  Phases2,
  Columns4,
  Rows4,
  Phases4,
  FrameHalves,
  FrameQuarters,
  FrameParities
};

/** Objects that a partition divides. */
enum class Divided : std::uint8_t
{
  Places,
  Phases,
  Frames
};

/** Entry of the table of partitions. */
struct PartitionKind
{
  Partition    partition;
  const char * name;  ///< name in the record, stable for programs
  const char * words; ///< description of the parts in messages
  std::size_t  parts; ///< number of parts
  Divided      divided;
};

/** Blocks along either axis, and the longest period of a pattern of phases [pixel]. */
inline constexpr std::size_t BlocksAcross = 4;
inline constexpr std::size_t LargestPeriod = 4;
/** Groups of frames: the quarters of the burst, each divided into its even and its odd frames. */
inline constexpr std::size_t FrameGroups = 8;

inline constexpr std::array<PartitionKind, 14> PartitionTable{ {
  { Partition::LeftRight, "left-right", "the left and the right half", 2, Divided::Places },
  { Partition::UpperLower, "upper-lower", "the upper and the lower half", 2, Divided::Places },
  { Partition::Quadrants, "quadrants", "the quadrants", 4, Divided::Places },
  { Partition::Blocks, "blocks", "4 x 4 blocks", 16, Divided::Places },
  { Partition::SmoothField,
    "smooth-field",
    "a smooth field, as where vignetting was divided out",
    16,
    Divided::Places },
  { Partition::Columns2, "columns-2", "even and odd columns", 2, Divided::Phases },
  { Partition::Rows2, "rows-2", "even and odd rows", 2, Divided::Phases },
  { Partition::Phases2, "phases-2x2", "the pixels of a 2 x 2 mosaic", 4, Divided::Phases },
  { Partition::Columns4, "columns-4", "every fourth column", 4, Divided::Phases },
  { Partition::Rows4, "rows-4", "every fourth row", 4, Divided::Phases },
  { Partition::Phases4, "phases-4x4", "the pixels of a 4 x 4 mosaic", 16, Divided::Phases },
  { Partition::FrameHalves, "frame-halves", "the first and the last half of the frames", 2, Divided::Frames },
  { Partition::FrameQuarters, "frame-quarters", "the quarters of the burst", 4, Divided::Frames },
  { Partition::FrameParities, "frame-parities", "even and odd frames", 2, Divided::Frames },
} };

/** Returns the entry of \a partition. */
constexpr const PartitionKind &
KindOf(Partition partition)
{
  return PartitionTable[static_cast<std::size_t>(partition)];
}

/** Returns the part of a pixel or frame, from 0. \a x and \a y are in units of the frame's width and height, from 0 to
 * 1 [1]. \a phase is 4 (row mod 4) + (column mod 4) for a pixel, and 2 quarter + (frame mod 2) for a frame. */
SensorNoise_EXPORT std::size_t
PartOf(Partition partition, double x, double y, std::size_t phase);

/** Returns the part in words, such as "left half" or "column 1, row 0 of 2 x 2". */
SensorNoise_EXPORT std::string
NameOfPart(Partition partition, std::size_t part);

/** Mean excess of the variance over a line, of the pixels of a tile or of one phase in a tile. */
struct TileExcess
{
  double      x{ 0.0 };            ///< horizontal centre of the tile, in units of the frame's width [1]
  double      y{ 0.0 };            ///< vertical centre, in units of the frame's height [1]
  std::size_t phase{ 0 };          ///< see PartOf()
  double      pixels{ 0.0 };       ///< number of pixels
  double      levelDn{ 0.0 };      ///< mean level [DN]
  double      shotFraction{ 0.0 }; ///< fraction of the line's variance that is shot noise [1]
  double      excess{ 0.0 };       ///< mean variance over the line, relative to the line, minus 1 [1]
  double      error{ 0.0 };        ///< sampling error of the excess [1]
};

/** Sums over pixels, or over pixels in some frames. */
struct SensorNoise_EXPORT PartSums
{
  double pixels{ 0.0 };   ///< number of values
  double level{ 0.0 };    ///< sum of the means [DN]
  double variance{ 0.0 }; ///< sum of the variances [DN^2]
  double expected{ 0.0 }; ///< sum of the variances by the line [DN^2]
  double shot{ 0.0 };     ///< sum of the shot noise by the line [DN^2]
  double chance{ 0.0 };   ///< sampling variance of the sum of variances, without spatial noise correlation [DN^4]

  PartSums &
  operator+=(const PartSums & other);
  /** Returns the mean excess; the place is not set. \a varianceInflation: see RejectionModel [1]. */
  TileExcess
  Excess(double varianceInflation) const;
};

/** Line that the variance of the pixels is compared with. */
struct PartReference
{
  VarianceLine line;
  double       blackDn{ 0.0 };           ///< dark offset, or a level that it is not below [DN]
  double       varianceInflation{ 1.0 }; ///< variance inflation, see RejectionModel [1]
};

/** Excess variance of the pixels of a mask in tiles of the frame, at most 32 along each axis. */
struct SensorNoise_EXPORT PartTiles
{
  std::vector<TileExcess> places; ///< one entry per tile
  std::vector<TileExcess> phases; ///< one entry per larger tile and phase
};

/** Computes the excess variance in tiles of 16 x 16 pixels, of 8 x 8 pixels in small frames, and of a multiple of these
 * in large frames. */
SensorNoise_EXPORT PartTiles
MakePartTiles(const VarianceData &  data,
              const FrameGeometry & geometry,
              const PartReference & reference,
              const ParallelFor &   parallelFor);

} // namespace sensornoise

#endif
