// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_CodeSettings_h
#define sensornoise_moments_CodeSettings_h

#include "SensorNoiseExport.h"

#include <optional>

namespace sensornoise
{

/** The largest level that a setting may name, without its sign [DN]: its powers, up to the fourth, are finite. */
inline constexpr double LargestLevelDn = 1e30;
/** The largest spacing of codes that may be given [DN]: it fits into 32 bits. */
inline constexpr double LargestStepDn = 1e9;

/** What the user says about the codes of the data; what is not said is found. */
struct CodeSettings
{
  std::optional<int>    bitDepth;           ///< bits of the sensor's codes, 1 to 16
  std::optional<double> clipLowDn;          ///< lowest level that the sensor attains [DN]
  std::optional<double> clipHighDn;         ///< highest level that the sensor attains [DN]
  std::optional<double> quantisationStepDn; ///< spacing of the codes [DN]
};

/** Settings from plain numbers: a bit depth or step of 0, and a clip level of NaN, is to be found. */
SensorNoise_EXPORT CodeSettings
MakeCodeSettings(unsigned int bitDepth, double clipLowDn, double clipHighDn, double quantisationStepDn);

/** Throws std::invalid_argument if what the user says of the codes is out of range. */
SensorNoise_EXPORT void
ValidateCodeSettings(const CodeSettings & codes);

} // namespace sensornoise

#endif
