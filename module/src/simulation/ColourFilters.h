// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ColourFilters_h
#define sensornoise_simulation_ColourFilters_h

#include "base/BayerPattern.h"
#include "simulation/SettingChecks.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

/** A mosaic of colour filters in front of the pixels: of the light that a pixel would have without it, the electrons
 * of the scene, so much is left. The filters are the sensor's and do not move with the scene. */
struct ColourFilterSettings
{
  std::optional<BayerPattern> pattern;              ///< null: no filters
  double                      transmissionR{ 0.6 }; ///< [1], 0 to 1, under the light of the scene
  double                      transmissionG{ 1.0 }; ///< of both greens
  double                      transmissionB{ 0.5 };
};

/** \throws std::invalid_argument if a transmission is not from 0 to 1. */
inline void
CheckSettings(const ColourFilterSettings & settings)
{
  RequireFraction(settings.transmissionR, "transmission of the red filter");
  RequireFraction(settings.transmissionG, "transmission of the green filter");
  RequireFraction(settings.transmissionB, "transmission of the blue filter");
}

/** Multiplies each pixel of \a efficiency by the transmission of its filter; an empty map holds 1 everywhere, and stays
 * empty where there are no filters. */
SensorNoise_EXPORT void
ApplyFilters(const ColourFilterSettings & settings,
             std::size_t                  width,
             std::size_t                  height,
             std::vector<double> &        efficiency);

} // namespace sensornoise

#endif
