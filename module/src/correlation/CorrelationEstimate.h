// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_CorrelationEstimate_h
#define sensornoise_correlation_CorrelationEstimate_h

#include "SensorNoiseExport.h"
#include "sensornoise/StepResults.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/FrameSample.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace sensornoise
{

/** Settings of a measurement of the noise correlation alone. */
struct SensorNoise_EXPORT CorrelationSettings
{
  /** Dark offset [DN]. NaN (default): not known; the signal is measured from the darkest level if that is below 0.3 of
   * the brightest level, else from 0. */
  double offsetDn{ std::numeric_limits<double>::quiet_NaN() };
  /** Quantization step [DN]; 0 (default): no quantization. At least 0 and finite. */
  double quantisationStepDn{ 0.0 };
  /** Temporal components: changes from frame to frame in proportion to a pattern of the scene (flicker, motion), with
   * one value for each frame. Every linear combination of them and of the constant is removed from every pixel. */
  std::vector<std::vector<double>> series;
  /** Whether the means of the frames are temporal components, too, both plain and weighted with the signal. They
   * describe flicker and a drifting offset. */
  bool frameMeans{ true };

  /** Throws std::invalid_argument if a setting is out of range, or if a series does not have \a frames finite values.
   */
  void
  Validate(std::size_t frames) const;
};

/** Measures the noise correlation on \a sample, which is used up. The sample must be from the whole stack. \a mean is
 * the mean of every pixel [DN]. Pixels whose \a take is 0 or whose mean is not finite are left out. The series of
 * \a settings have a value for each frame of the stack. */
SensorNoise_EXPORT CorrelationEstimate
EstimateCorrelation(NoiseSample                       sample,
                    const std::vector<double> &       mean,
                    const std::vector<std::uint8_t> & take,
                    const CorrelationSettings &       settings,
                    const ParallelFor &               parallelFor = SerialFor);

/** Returns the record of the spatial and temporal noise correlation. If it was not measured, only the noise class is
 * filled. */
SensorNoise_EXPORT NoiseCorrelationRecord
RecordOf(const NoiseCorrelation & correlation);

} // namespace sensornoise

#endif
