/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_correlation_BlockPhases_h
#define sensornoise_correlation_BlockPhases_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/correlation/NoiseResiduals.h"

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
