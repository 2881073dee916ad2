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

/** What was found of a stack of these \a maps; to \a valid, which has room for a frame's pixels, goes 1 where a pixel
 * is finite and never at a clip level, else 0. Codes and clip levels are given or found, see FindCodes() and
 * FindLevels(). Throws std::invalid_argument if the data pass the given bit depth. */
template <typename TPixel>
SensorNoise_EXPORT StackSummary
SummariseStack(const TemporalMaps<TPixel> & maps,
               const CodeSettings &         settings,
               const ParallelFor &          parallelFor,
               std::uint8_t *               valid);

/** The maps of a stack, of a frame's size, and what was found of it. */
struct StackMaps
{
  StackSummary              summary;
  std::vector<double>       mean;     ///< [DN]; NaN where a pixel was not finite in a frame
  std::vector<double>       variance; ///< unbiased [DN^2]; of a single frame 0
  std::vector<std::uint8_t> valid;    ///< see SummariseStack()
};

/** Of the moments, which are given away: mean and variance take the memory of the sums. */
template <typename TPixel>
SensorNoise_EXPORT StackMaps
MakeStackMaps(TemporalMoments<TPixel> moments, const CodeSettings & settings, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
