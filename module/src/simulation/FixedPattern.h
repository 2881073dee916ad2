// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FixedPattern_h
#define sensornoise_simulation_FixedPattern_h

#include "SensorNoiseExport.h"
#include "sensornoise/SimulationSettings.h"

#include <cstddef>
#include <vector>

/** \file
 * Fixed-pattern noise of all causes together: maps that differ from pixel to pixel and stay the same from frame to
 * frame. They depend on the seed, not on the frames or on the illumination; a map is empty where all pixels are equal.
 */

namespace sensornoise
{

/** Returns the efficiency of every pixel in units of the camera's efficiency: prnuSd, columnEfficiencySd and the colour
 * filters [1]. */
SensorNoise_EXPORT std::vector<double>
DrawEfficiency(const SimulationSettings & settings, std::size_t width, std::size_t height);

/** Returns the offset of every pixel relative to the camera's offset: dsnuSdDn and columnOffsetSdDn [DN]. */
SensorNoise_EXPORT std::vector<double>
DrawOffsetDn(const SimulationSettings & settings, std::size_t width, std::size_t height);

/** Returns the read noise of every pixel before its relative gain and its response: hot pixels and ReadNoiseSettings
 * [DN]. */
SensorNoise_EXPORT std::vector<double>
DrawReadNoiseDn(const SimulationSettings & settings, std::size_t width, std::size_t height);

} // namespace sensornoise

#endif
