// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Text_h
#define sensornoise_base_Text_h

#include "SensorNoiseExport.h"

#include <string>

namespace sensornoise
{

/** A number as people read it. */
SensorNoise_EXPORT std::string
Text(double number);

} // namespace sensornoise

#endif
