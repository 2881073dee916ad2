// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Version_h
#define sensornoise_Version_h

#include "SensorNoiseExport.h"

namespace sensornoise
{

/** Returns the version of the module, which is the version of its CMake project: "major.minor.patch". */
SensorNoise_EXPORT const char *
GetModuleVersion();

} // namespace sensornoise

#endif
