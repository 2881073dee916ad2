// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_Illumination_h
#define sensornoise_simulation_Illumination_h

#include "sensornoise/SimulationSettings.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** \throws std::invalid_argument that names the first setting that cannot be used for a stack of `frames` frames. */
SensorNoise_EXPORT void
CheckSettings(const IlluminationSettings & illumination, std::size_t frames);

/** Returns the illumination factor of a frame [1]. A random factor depends on the seed and on the frame alone. */
SensorNoise_EXPORT double
IlluminationFactor(const IlluminationSettings & illumination,
                   std::size_t                  frame,
                   std::size_t                  frames,
                   std::uint64_t                seed);

} // namespace sensornoise

#endif
