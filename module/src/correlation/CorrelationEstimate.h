// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_CorrelationEstimate_h
#define sensornoise_correlation_CorrelationEstimate_h

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

/** Noise at a level of the light: the mean of a quarter of the pixels. */
struct LightNoise
{
  double         lightDn{ 0.0 }; ///< above the level without light [DN]
  MeasuredNumber varianceDn2;    ///< of a pixel as it is, with the codes' noise [DN^2]
  Quantity       sumOverLags;    ///< as CorrelationEstimate's [1]
};

/** What neighbours and frames share of their noise, and what the variance has to be multiplied by. */
struct CorrelationEstimate
{
  std::size_t width{ 0 };
  std::size_t height{ 0 };
  std::size_t frames{ 0 };     ///< of the stack
  std::size_t framesUsed{ 0 }; ///< of the sample, equal ones counted once
  std::size_t pixelsUsed{ 0 }; ///< of the sample

  NoiseCorrelationRecord correlation;
  /** The sum of the noise's covariances over all lags, relative to the variance of a pixel [1]: after a linear filter
   * whose weights sum to 1, variance times this is the variance before it. The variance is that of the frames about
   * their own mean, which mixed frames make a little less than a value's own: by 1 - 2 (sum of coefficients) / T. 1
   * within its error where the noise is white: the variance is then better left alone. Its error is that of a block
   * jackknife, with what is beyond the last lag. `failed` where the noise is not linear or was not measured. */
  Quantity                sumOverLags{ Quantity::Without(EstimateStatus::Failed) };
  std::vector<LightNoise> lights; ///< from dark to bright; empty: not measured
};

/** Measures it on a sample of the whole stack, which it uses up. \a mean of every pixel [DN]; \a take: pixels of value
 * 0 are left out, and those whose mean is not finite; \a series of settings are of all frames. */
SensorNoise_EXPORT CorrelationEstimate
EstimateCorrelation(NoiseSample                       sample,
                    const std::vector<double> &       mean,
                    const std::vector<std::uint8_t> & take,
                    const CorrelationSettings &       settings,
                    const ParallelFor &               parallelFor = SerialFor);

/** The version of its JSON. */
inline constexpr const char * CorrelationSchema = "itk-sensornoise-correlation/1";

/** As JSON: one object, units in each quantity; noise_correlation as in the report's. */
SensorNoise_EXPORT std::string
ToJson(const CorrelationEstimate & estimate);

} // namespace sensornoise

#endif
