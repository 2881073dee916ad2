// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_Interpolation_h
#define sensornoise_simulation_Interpolation_h

#include "SensorNoiseExport.h"

#include <string>

namespace sensornoise
{

/** How a camera takes a value between pixels. */
enum class Interpolation
{
  Nearest, ///< that of the nearest pixel
  Linear,  ///< of two pixels along each axis
  Cubic    ///< of four pixels along each axis, CubicShift
};

/** The name as options spell it: "nearest", "linear", "cubic". */
SensorNoise_EXPORT const char *
NameOf(Interpolation interpolation);

/** \throws std::invalid_argument for another name. */
SensorNoise_EXPORT Interpolation
InterpolationOf(const std::string & name);

} // namespace sensornoise

#endif
