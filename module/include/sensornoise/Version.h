// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_Version_h
#define sensornoise_Version_h

#include "SensorNoiseExport.h"

namespace sensornoise
{

/** The version of the module, that of its CMake project: "major.minor.patch". */
SensorNoise_EXPORT const char *
GetModuleVersion();

} // namespace sensornoise

#endif
