// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef NoiseModelFile_h
#define NoiseModelFile_h

#include "sensornoise/NoiseModel.h"

#include <optional>
#include <string>

namespace sensornoise::tools
{

/** Noise model of a report, and the scale of its grey values, for transforms of images. */
struct NoiseModelFile
{
  std::string           name;
  NoiseModel            model;
  std::optional<double> quantisationStepDn; ///< quantization step [DN]; none for floating-point frames
  std::optional<double> clipLowDn;          ///< lowest level that the sensor attains [DN]
  std::optional<double> clipHighDn;         ///< highest level that the sensor attains [DN]
  std::optional<double> lowestDn;           ///< lowest mean level of an intensity bin of the report [DN]
  std::optional<double> highestDn;          ///< highest mean level of an intensity bin of the report [DN]

  /** Returns the level at which the variance of the model is zero [DN]. */
  double
  ZeroLevelDn() const
  {
    return -model.totalInterceptDn2 / model.varianceSlopeDn;
  }
};

/** Reads a report of estimate-sensor-noise. Only `variance_slope` and `total_intercept` must have a value; gain,
 * offset and read noise may be missing. Throws std::runtime_error if \a file cannot be read or is not JSON. Throws
 * UnfitReport if it is not such a report, has several channels, or has no valid model. */
NoiseModelFile
ReadNoiseModel(const std::string & file);

} // namespace sensornoise::tools

#endif
