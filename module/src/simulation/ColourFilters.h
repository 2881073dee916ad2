// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ColourFilters_h
#define sensornoise_simulation_ColourFilters_h

#include "sensornoise/SensorFlaws.h"
#include "sensornoise/FrameGeometry.h"
#include "simulation/SettingChecks.h"

#include <cstddef>
#include <optional>
#include <vector>

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

} // namespace sensornoise

#endif
