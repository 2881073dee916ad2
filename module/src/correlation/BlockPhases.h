// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_BlockPhases_h
#define sensornoise_correlation_BlockPhases_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "correlation/NoiseResiduals.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sensornoise
{

/** \struct BlockPhases
 * \brief What nearest neighbours share, by where in a block of 8 pixels they lie: in frames that were compressed in
 * blocks (ITU T.81), neighbours in one block share what it was rounded to, and those in two do not.
 *
 * Blocks of 4 and of 16 pixels show, too. */
struct BlockPhases
{
  static constexpr std::size_t Period = 8;

  /** Sums over pairs at each phase of the frame's columns, then of its rows. */
  std::array<double, 2 * Period> covariance{}; ///< of y / V, as in PairSums
  std::array<double, 2 * Period> pairs{};

  BlockPhases &
  operator+=(const BlockPhases & other);
};

/** The sums of every tile. */
SensorNoise_EXPORT std::vector<BlockPhases>
SumBlockPhases(const NoiseResiduals & residuals, const ParallelFor & parallelFor);

/** The root mean square by which the phases' coefficients differ, without what chance makes of it [1]. */
SensorNoise_EXPORT double
SpreadOfPhases(const std::vector<BlockPhases> & tiles);

} // namespace sensornoise

#endif
