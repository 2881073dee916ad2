// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef NoiseModelFile_h
#define NoiseModelFile_h

#include "sensornoise/NoiseModel.h"

#include <optional>
#include <string>

namespace sensornoise::tools
{

/** What a report says to whoever transforms images: the noise model, and on which scale its levels are. */
struct NoiseModelFile
{
  std::string           name;
  NoiseModel            model;
  std::optional<double> codeStepDn; ///< spacing of the sensor's codes; none for floating-point frames
  std::optional<double> clipLowDn;  ///< lowest level that the sensor attains
  std::optional<double> clipHighDn; ///< highest level
  std::optional<double> lowestDn;   ///< mean level of the darkest 1/256 of the pixels that were measured
  std::optional<double> highestDn;  ///< of the brightest

  /** The level at which the model has no variance [DN]: no light, and no read noise. */
  double
  ZeroLevelDn() const
  {
    return -model.totalInterceptDn2 / model.varianceSlopeDn;
  }
};

/** Reads a report of estimate-sensor-noise. Only `variance_slope` and `total_intercept` have to have a value: gain,
 * offset and read noise may lack. Throws std::runtime_error if \a file cannot be read or is no JSON, and UnfitReport if
 * it is no such report, of several channels, or without such a model. */
NoiseModelFile
ReadNoiseModel(const std::string & file);

} // namespace sensornoise::tools

#endif
