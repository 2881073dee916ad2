// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_sweep_CommonGain_h
#define sensornoise_sweep_CommonGain_h

#include "SensorNoiseExport.h"
#include "sweep/SettingNoise.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** The gain that settings share which differ in the exposure time alone, and whether they share it. */
struct CommonGain
{
  std::string     channel{ "mono" };
  NumberWithError gain;               ///< weighted mean of the gains [DN/e-]
  std::size_t     settings{ 0 };      ///< settings with a gain and its error
  double          reducedChi2{ 0.0 }; ///< scatter of the gains over their errors, squared [1]
  bool            isSame{ true };     ///< whether no setting differs from the others
  double          setting{ 0.0 }; ///< setting that deviates most in standard errors, of those that differ if any does
  NumberWithError deviation;      ///< its gain over the weighted mean of the others, less 1 [1]
};

/** Tests whether the gains of settings are equal, and pools them as their mean, weighted by 1 / error squared.
 *
 * Each gain is compared with the weighted mean of all others. A setting differs if its deviation exceeds both
 * SweepConstants::leastCommonGainDeviation and Significance.severalTests standard errors. If the
 * gains scatter by more than their errors, the error of the mean is multiplied by the root of the reduced chi-square.
 * Returns none if fewer than two settings have a gain with an error above 0. Throws std::invalid_argument as
 * RequireSettings(). */
SensorNoise_EXPORT std::optional<CommonGain>
FindCommonGain(const std::vector<SettingNoise> & settings);

} // namespace sensornoise

#endif
