// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FixedPattern_h
#define sensornoise_simulation_FixedPattern_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/SensorFlaws.h"
#include "sensornoise/SimulationSettings.h"
#include "simulation/SettingChecks.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file
 * Fixed-pattern noise of all causes together: maps that differ from pixel to pixel and stay the same from frame to
 * frame. They depend on the seed, not on the frames or on the illumination; a map is empty where all pixels are equal.
 */

namespace sensornoise
{

/** \throws std::invalid_argument if a transmission is not from 0 to 1. */
inline void
CheckSettings(const ColourFilterSettings & settings)
{
  RequireFraction(settings.transmissionR, "transmission of the red filter");
  RequireFraction(settings.transmissionG, "transmission of the green filter");
  RequireFraction(settings.transmissionB, "transmission of the blue filter");
}

/** Multiplies each pixel of \a efficiency by the transmission of its filter. An empty map stands for 1 everywhere, and
 * stays empty where there are no filters. */
SensorNoise_EXPORT void
ApplyFilters(const ColourFilterSettings & settings,
             std::size_t                  width,
             std::size_t                  height,
             std::vector<double> &        efficiency);

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

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ReadNoiseSettings & settings);

/** Returns the read noise of every pixel in units of the median of the pixels that are not in the tail [1]. Empty if
 * all pixels are equal. */
SensorNoise_EXPORT std::vector<double>
DrawReadNoisePattern(const ReadNoiseSettings & settings, std::uint64_t seed, std::size_t pixels);

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
