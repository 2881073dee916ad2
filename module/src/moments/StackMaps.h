// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackMaps_h
#define sensornoise_moments_StackMaps_h

#include "sensornoise/StepResults.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "moments/TemporalMaps.h"
#include "moments/TemporalMoments.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Summarises a stack with these \a maps. The codes and clip levels are given or found, see FindCodes() and
 * FindLevels().
 * \param valid has room for the pixels of a frame; it receives 1 where a pixel is finite and never at a clip level,
 * else 0
 *
 * Throws std::invalid_argument if the data exceed the given bit depth. */
template <typename TPixel>
SensorNoise_EXPORT StackSummary
SummariseStack(const TemporalMaps<TPixel> & maps,
               const CodeSettings &         settings,
               const ParallelFor &          parallelFor,
               std::uint8_t *               valid);

/** Maps of a stack, of a frame's size, and their summary. */
struct StackMaps
{
  StackSummary              summary;
  std::vector<double>       mean;     ///< mean over time [DN]; NaN where a pixel was not finite in a frame
  std::vector<double>       variance; ///< unbiased variance over time [DN^2]; 0 for a single frame
  std::vector<std::uint8_t> valid;    ///< see SummariseStack()
};

/** Makes the maps from the moments, which are consumed: mean and variance take the memory of the sums. */
template <typename TPixel>
SensorNoise_EXPORT StackMaps
MakeStackMaps(TemporalMoments<TPixel> moments, const CodeSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
