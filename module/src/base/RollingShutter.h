// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_RollingShutter_h
#define sensornoise_base_RollingShutter_h

#include "SensorNoiseExport.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

/** How the flicker may vary inside a frame. */
enum class RollingShutter : std::uint8_t
{
  Off,  ///< one gamma_t a frame
  Auto, ///< gamma_t(y) where the data show it, sigma_y by cross-validation
  Fixed ///< gamma_t(y) with the given sigma_y, section 3.5
};

/** The mode of a name: "off", "auto" or "fixed". Throws std::invalid_argument for others. */
SensorNoise_EXPORT RollingShutter
RollingShutterOf(const std::string & name);

/** The name of a mode. */
SensorNoise_EXPORT const char *
NameOf(RollingShutter mode);

} // namespace sensornoise

#endif
