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

struct IlluminationResponses;

/** Dark offset from the responses of the pixels to the illumination components. */
struct LocalOffset
{
  double offset{ 0.0 };                                            ///< offset minus the centre [DN]
  double standardError{ std::numeric_limits<double>::infinity() }; ///< standard error of the offset [DN]
  /** Lower end of the 95 % interval, minus the centre [DN]; infinite: not bounded. */
  double low{ -std::numeric_limits<double>::infinity() };
  /** Upper end of the 95 % interval, minus the centre [DN]; infinite: not bounded. */
  double high{ std::numeric_limits<double>::infinity() };
  /** Dispersion of the lines about the common zero, over their noise [1]; 1 if only noise separates them. */
  double      phi{ 1.0 };
  std::size_t tiles{ 0 }; ///< number of tiles that determine a line
};

/** Estimates the dark offset where the illumination is local. The response of a pixel to an illumination component is
 * S_j = rho_j (mean - mu), with rho_j nearly constant over a tile. The lines of all tiles and components therefore
 * cross zero at mu. Tiles of 8 to 64 pixels and strips of rows are tried, and the partition of the smallest standard
 * error is used. The dispersion of the lines widens the error. Null if no tile determines a line. Estimator.md, 3.7. */
SensorNoise_EXPORT std::optional<LocalOffset>
FindLocalOffset(const IlluminationResponses & data, const ParallelFor & parallelFor = SerialFor);

} // namespace sensornoise

#endif
