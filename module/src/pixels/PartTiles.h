// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_PartTiles_h
#define sensornoise_pixels_PartTiles_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceLine.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Mean excess of the variance of some pixels over a line: those of a tile, or those of one phase in it. */
struct TileExcess
{
  double      x{ 0.0 }; ///< centre of the tile, in units of the frame's width and height [1]
  double      y{ 0.0 };
  std::size_t phase{ 0 };
  double      pixels{ 0.0 };
  double      levelDn{ 0.0 };
  double      shotFraction{ 0.0 }; ///< part of the line's variance that is shot noise [1]
  double      excess{ 0.0 };       ///< of the mean variance over the line, relative to it [1]
  double      error{ 0.0 };        ///< its standard error, by sampling [1]
};

/** Sums over values: pixels, or pixels in some frames. */
struct SensorNoise_EXPORT PartSums
{
  double pixels{ 0.0 };
  double level{ 0.0 };
  double variance{ 0.0 };
  double expected{ 0.0 };
  double shot{ 0.0 };
  double chance{ 0.0 }; ///< variance of the sum of variances, if no two share noise [DN^4]

  PartSums &
  operator+=(const PartSums & other);
  /** Without a place. \a sharedSquares: see JudgingLine. */
  TileExcess
  Excess(double sharedSquares) const;
};

/** What the variance of the pixels is held against. */
struct PartReference
{
  VarianceLine line;
  double       blackDn{ 0.0 };       ///< level without signal, or one that it is not below
  double       sharedSquares{ 1.0 }; ///< see JudgingLine
};

/** Sums over tiles of the frame, at most 32 along each axis, of the pixels of a mask. */
struct SensorNoise_EXPORT PartTiles
{
  std::vector<TileExcess> places; ///< a tile each
  std::vector<TileExcess> phases; ///< a tile and a phase each
};

/** Sums the variance of the data over tiles of 16 x 16 pixels, of 8 x 8 in small frames, of more in large ones. */
SensorNoise_EXPORT PartTiles
MakePartTiles(const VarianceData &  data,
              const FrameGeometry & geometry,
              const PartReference & reference,
              const ParallelFor &   parallelFor);

} // namespace sensornoise

#endif
