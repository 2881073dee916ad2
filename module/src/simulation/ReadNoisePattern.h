// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ReadNoisePattern_h
#define sensornoise_simulation_ReadNoisePattern_h

#include "sensornoise/SensorFlaws.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ReadNoiseSettings & settings);

/** Returns the read noise of every pixel in units of the median of the pixels that are not in the tail [1]. Empty if
 * all pixels are equal. */
SensorNoise_EXPORT std::vector<double>
DrawReadNoisePattern(const ReadNoiseSettings & settings, std::uint64_t seed, std::size_t pixels);

} // namespace sensornoise

#endif
