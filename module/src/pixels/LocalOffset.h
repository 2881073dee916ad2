// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_LocalOffset_h
#define sensornoise_pixels_LocalOffset_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <limits>
#include <optional>

namespace sensornoise
{

struct PixelLight;

/** The offset from the pixels' responses to the series of light. */
struct LocalOffset
{
  double      offset{ 0.0 };                                            ///< [DN], minus the centre
  double      standardError{ std::numeric_limits<double>::infinity() }; ///< [DN]
  double      low{ -std::numeric_limits<double>::infinity() };          ///< 95 % interval [DN], minus the centre
  double      high{ std::numeric_limits<double>::infinity() };          ///< its other end [DN]
  double      phi{ 1.0 }; ///< dispersion of the lines about the common zero; 1 if they meet there but for noise
  std::size_t tiles{ 0 }; ///< that tell it
};

/** The offset where light is local. A pixel's response to any series of light is its own light's, S_j = rho_j (mean -
 * mu), with rho_j about constant over a tile: the lines of all tiles and series cross zero at mu. Tiles of 8 to 64
 * pixels and strips of rows are tried, and the one of the smallest standard error, which their dispersion widens,
 * serves. Estimator.md, 3.7. */
SensorNoise_EXPORT std::optional<LocalOffset>
FindLocalOffset(const PixelLight & data, const ParallelFor & parallelFor = SerialFor);

} // namespace sensornoise

#endif
