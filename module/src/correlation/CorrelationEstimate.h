// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_CorrelationEstimate_h
#define sensornoise_correlation_CorrelationEstimate_h

#include "sensornoise/StepResults.h"
#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseSample.h"
#include "sensornoise/Report.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace sensornoise
{

/** What is known when the correlation of the noise is measured by itself. */
struct SensorNoise_EXPORT CorrelationSettings
{
  /** The level without light [DN]; NaN (default): not known, light is measured from the darkest level if that is below
   * 0.3 of the brightest, else from 0. */
  double offsetDn{ std::numeric_limits<double>::quiet_NaN() };
  /** Spacing of the codes [DN]; 0: none. */
  double quantisationStepDn{ 0.0 };
  /** What changed from frame to frame in proportion to some pattern of the scene (flicker, motion), a value a frame
   * each. Any linear combination of them and of the constant is taken out of every pixel. */
  std::vector<std::vector<double>> series;
  /** Takes out the frames' own means, too, plain and weighted with the light: flicker and a drifting offset. */
  bool frameMeans{ true };

  /** Throws std::invalid_argument if a setting is out of range, or a series is not one of \a frames finite numbers. */
  void
  Validate(std::size_t frames) const;
};

/** Measures it on a sample of the whole stack, which it uses up. \a mean of every pixel [DN]; \a take: pixels of value
 * 0 are left out, and those whose mean is not finite; \a series of settings are of all frames. */
SensorNoise_EXPORT CorrelationEstimate
EstimateCorrelation(NoiseSample                       sample,
                    const std::vector<double> &       mean,
                    const std::vector<std::uint8_t> & take,
                    const CorrelationSettings &       settings,
                    const ParallelFor &               parallelFor = SerialFor);

} // namespace sensornoise

#endif
