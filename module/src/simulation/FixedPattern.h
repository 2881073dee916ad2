// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FixedPattern_h
#define sensornoise_simulation_FixedPattern_h

#include "SensorNoiseExport.h"
#include "sensornoise/SimulationSettings.h"

#include <cstddef>
#include <vector>

/** \file
 * What differs from pixel to pixel and stays the same from frame to frame, all causes together. The maps depend on the
 * seed, not on the frames or on the light; a map is empty where nothing differs. */

namespace sensornoise
{

/** Efficiency of every pixel in units of the camera's: prnuSd and columnEfficiencySd [1]. */
SensorNoise_EXPORT std::vector<double>
DrawEfficiency(const SimulationSettings & settings, std::size_t width, std::size_t height);

/** Offset of every pixel about the camera's: dsnuSdDn and columnOffsetSdDn [DN]. */
SensorNoise_EXPORT std::vector<double>
DrawOffsetDn(const SimulationSettings & settings, std::size_t width, std::size_t height);

/** Read noise of every pixel before its own gain and its response: hot pixels and ReadNoiseSettings [DN]. */
SensorNoise_EXPORT std::vector<double>
DrawReadNoiseDn(const SimulationSettings & settings, std::size_t width, std::size_t height);

} // namespace sensornoise

#endif
