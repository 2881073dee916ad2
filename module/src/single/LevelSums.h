// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_LevelSums_h
#define sensornoise_single_LevelSums_h

#include "SensorNoiseExport.h"
#include "single/NoiseLine.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

class BandTile;
struct LevelLimits;

/** Positions of about one level of a sample: the half of them with the least roughness. In units of SingleFrame. */
struct StartingGroup
{
  double level{ 0.0 };
  double variance{ 0.0 }; ///< by the median of the squared diagonal details
};

/** Groups of a sample, made before any line is known. */
struct StartingGroups
{
  std::vector<StartingGroup> groups;     ///< of equal count, from dark to bright; empty: nothing is finite
  double                     low{ 0.0 }; ///< levels between which nearly all positions lie
  double                     high{ 0.0 };
  double                     medianVariance{ 0.0 };
};

SensorNoise_EXPORT StartingGroups
MakeStartingGroups(const std::vector<BandTile> & sample);

/** Returns the line through the groups that are no closer to a clip level than two standard deviations, by least
 * squares relative to the variance; a constant where there are fewer than two. [DN] */
SensorNoise_EXPORT CentredLine
FitStartingLine(const StartingGroups & groups, const LevelLimits & limits, double originDn, double unitDn);

/** Level sets of equal width, and the variance that is expected of each, in units of SingleFrame. Levels beyond the
 * ends belong to the first and the last set. */
struct LevelGrid
{
  double             low{ 0.0 };
  double             perLevel{ 1.0 }; ///< sets per unit of level
  std::vector<float> variance;        ///< expected, of each set

  double
  CentreOf(std::size_t set) const
  {
    return low + (static_cast<double>(set) + 0.5) / perLevel;
  }
};

/** Sums over the positions of each level set whose windows are even. Squares are relative to the expected variance. */
struct LevelSums
{
  struct Set
  {
    double positions{ 0.0 };
    double level{ 0.0 };
    double diagonals{ 0.0 };       ///< number of details that are not too large
    double diagonalSquares{ 0.0 }; ///< their squares
    double sides{ 0.0 };           ///< the same of horizontal and vertical details together
    double sideSquares{ 0.0 };
  };
  std::vector<Set> sets;
  double           finite{ 0.0 }; ///< positions, even or not, without a pixel that is not finite
  double           even{ 0.0 };   ///< positions in all sets

  /** Adds the positions of a tile. */
  void
  Add(const BandTile & tile, const LevelGrid & grid);

  void
  Add(const LevelSums & other);
};

/** Which details the variance is made of. */
enum class DetailBand
{
  Diagonal, ///< with the least texture, and free of noise of rows and columns
  Sides     ///< horizontal and vertical
};

/** Returns the level sets with their variances [DN^2]: the scale of the normal distribution whose squares, truncated at
 * InSingle.largestDetail expected standard deviations, have the mean that was found. All sets of the grid; empty ones
 * have no details. */
SensorNoise_EXPORT std::vector<LevelSet>
MakeLevelSets(const LevelSums & sums, const LevelGrid & grid, DetailBand band, double originDn, double unitDn);

/** Returns the variance of the normal distribution whose squares, of the values below \a limit, have the mean \a
 * square; infinite if no normal distribution has. */
SensorNoise_EXPORT double
VarianceOfTruncated(double square, double limit);

} // namespace sensornoise

#endif
