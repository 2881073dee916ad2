// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_SettingNoise_h
#define sensornoise_sweep_SettingNoise_h

#include <optional>
#include <vector>

namespace sensornoise
{

/** A number with its standard error, which is 0 or more, in the same unit. */
struct NumberWithError
{
  double value{ 0.0 };
  double standardError{ 0.0 };
};

/** Gain and read noise of a camera at one setting of its amplification. */
struct SettingNoise
{
  double                         setting{ 0.0 };     ///< ISO speed, gain as a factor [1], or exposure time [s]; above 0
  std::optional<NumberWithError> gain;               ///< g [DN/e-], above 0; none: not identified
  std::optional<NumberWithError> readNoiseElectrons; ///< sigma / g [e-], above 0; none: not identified
};

/** Throws std::invalid_argument unless the settings are above 0, finite and in ascending order, all numbers are above
 * 0, and all errors 0 or more. */
void
RequireSettings(const std::vector<SettingNoise> & settings);

} // namespace sensornoise

#endif
