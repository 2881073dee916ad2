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

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ReadNoiseSettings & settings);

/** Read noise of every pixel in units of the median of those that are not in the tail. Empty if all are alike. */
SensorNoise_EXPORT std::vector<double>
DrawReadNoisePattern(const ReadNoiseSettings & settings, std::uint64_t seed, std::size_t pixels);

} // namespace sensornoise

#endif
