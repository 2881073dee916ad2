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
