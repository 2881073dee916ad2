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

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const PatternSettings & settings);

/** Gain of every pixel in units of the camera's: 1 + gainSd normal, times 1 + columnGainSd normal of its column,
 * divided by the map's mean, so that the mean of the map is 1. Empty if both are 0. */
SensorNoise_EXPORT std::vector<double>
DrawGainPattern(const PatternSettings & settings, std::uint64_t seed, std::size_t width, std::size_t height);

/** Efficiency of every column in units of the mean one: 1 + columnEfficiencySd normal, divided by the mean over the
 * columns. Empty if 0. */
SensorNoise_EXPORT std::vector<double>
DrawColumnEfficiency(const PatternSettings & settings, std::uint64_t seed, std::size_t width);

/** Offset of every column about the camera's [DN]: normal, as drawn; its mean is 0 to within its error. Empty if 0. */
SensorNoise_EXPORT std::vector<double>
DrawColumnOffsetDn(const PatternSettings & settings, std::uint64_t seed, std::size_t width);

} // namespace sensornoise

#endif
