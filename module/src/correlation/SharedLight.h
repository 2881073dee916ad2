// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_SharedLight_h
#define sensornoise_correlation_SharedLight_h

#include "SensorNoiseExport.h"
#include "correlation/NoiseResiduals.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Products of sums over pixels that are at least a quarter of a tile apart, and what would make them: y a covariance,
 * w = 1 / V, z the light. */
struct DistantSums
{
  double covariance{ 0.0 };      ///< of w w' y
  double constant{ 0.0 };        ///< of w w'
  double light{ 0.0 };           ///< of w z w' z'
  double lightCovariance{ 0.0 }; ///< of w z w' z' y
  double lightSquare{ 0.0 };     ///< of w z^2 w' z'^2

  DistantSums &
  operator+=(const DistantSums & other);
};

/** \struct SharedLight
 * \brief What pixels far apart share, in a tile: noise of whole rows and columns, and light that the series did not
 * take out.
 *
 * None of it falls off with the distance, as what neighbours share does. The noise of rows and columns does not grow
 * with the level, light that is left grows with its square. */
struct SharedLight
{
  /** Rows, or columns, between two pixels up to which what lines share is looked at. */
  static constexpr std::size_t Lines = 7;

  std::array<DistantSums, Lines> rows;    ///< pixels as many rows apart, and far along them
  std::array<DistantSums, Lines> columns; ///< pixels as many columns apart, and far along them
  DistantSums                    far;     ///< pixels far apart along both axes

  SharedLight &
  operator+=(const SharedLight & other);
};

/** The sums of tile \a i. */
SensorNoise_EXPORT SharedLight
SharedLightOfTile(const NoiseResiduals & residuals, std::size_t i);

} // namespace sensornoise

#endif
