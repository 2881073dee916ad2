// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_GainPattern_h
#define sensornoise_simulation_GainPattern_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const PatternSettings & settings);

/** Returns the gain of every pixel in units of the camera's gain [1]: 1 + gainSd normal, times 1 + columnGainSd normal
 * for its column. The map is divided by its mean, so that its mean is 1. Empty if both settings are 0. */
SensorNoise_EXPORT std::vector<double>
DrawGainPattern(const PatternSettings & settings, std::uint64_t seed, std::size_t width, std::size_t height);

/** Returns the efficiency of every column in units of the mean efficiency [1]: 1 + columnEfficiencySd normal, divided
 * by the mean over the columns. Empty if the setting is 0. */
SensorNoise_EXPORT std::vector<double>
DrawColumnEfficiency(const PatternSettings & settings, std::uint64_t seed, std::size_t width);

/** Returns the offset of every column relative to the camera's offset [DN]. The offsets are normal numbers, whose mean
 * is 0 to within its error. Empty if the setting is 0. */
SensorNoise_EXPORT std::vector<double>
DrawColumnOffsetDn(const PatternSettings & settings, std::uint64_t seed, std::size_t width);

} // namespace sensornoise

#endif
