// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_SettingNoise_h
#define sensornoise_sweep_SettingNoise_h

#include "SensorNoiseExport.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** A number with its standard error, which is 0 or more, in the same unit. */
struct NumberWithError
{
  double value{ 0.0 };
  double standardError{ 0.0 };
};

/** Quantity in which the settings of a sweep differ. */
enum class SettingKind : std::uint8_t
{
  Iso,     ///< ISO speeds
  Gain,    ///< gains of the amplifier as factors
  Exposure ///< exposure times [s] at one gain
};

/** Returns "iso", "gain" or "exposure". */
SensorNoise_EXPORT const char *
NameOf(SettingKind kind);

/** Returns the kind with this name. Throws std::invalid_argument for any other name. */
SensorNoise_EXPORT SettingKind
SettingKindOf(const std::string & name);

/** Returns "ISO 800", "gain 2" or "exposure 0.01 s". */
SensorNoise_EXPORT std::string
SettingText(SettingKind kind, double setting);

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
