// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_PositionDependence_h
#define sensornoise_correlation_PositionDependence_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "correlation/NoiseResiduals.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

/** \struct BlockPhases
 * \brief Noise covariance of nearest neighbours by their position in a block of 8 pixels.
 *
 * In frames that were compressed in blocks (ITU T.81), two neighbours in the same block have the rounding of that
 * block in common, and two neighbours in different blocks do not. Blocks of 4 and of 16 pixels are detected, too. */
struct BlockPhases
{
  static constexpr std::size_t Period = 8;

  /** Sums over pairs at each phase: first the 8 phases of the frame's columns, then the 8 phases of its rows. */
  std::array<double, 2 * Period> covariance{}; ///< of the relative covariance y / V, as in PairSums [1]
  std::array<double, 2 * Period> pairs{};      ///< number of pairs

  BlockPhases &
  operator+=(const BlockPhases & other);
};

/** Returns the sums of every tile. */
SensorNoise_EXPORT std::vector<BlockPhases>
SumBlockPhases(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

/** Returns the root mean square deviation of the phases' coefficients from the mean of their axis, without the part
 * that statistical scatter explains [1]. */
SensorNoise_EXPORT double
RmsOfPhases(const std::vector<BlockPhases> & tiles);

/** Oscillation of a noise correlation coefficient with the position in the frame. Frames with fewer samples than pixels
 * have it; after a filter the correlation is the same at every position (Popescu and Farid 2005). */
struct EnlargementTrace
{
  int    lag{ 0 };               ///< distance of the neighbours [pixels]
  bool   isAlongX{ false };      ///< whether the neighbours lie, and their coefficient oscillates, along x
  bool   isAlternating{ false }; ///< whether the sign alternates from line to line
  double cyclesPerPixel{ 0.0 };
  double amplitude{ 0.0 }; ///< amplitude of the coefficient [1]
};

/** Returns the largest oscillation, if it is significant and exceeds InCorrelation.leastOscillation, which only frames
 * with fewer samples than pixels do. */
SensorNoise_EXPORT std::optional<EnlargementTrace>
FindEnlargementTrace(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
