// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FlawsJson_h
#define sensornoise_simulation_FlawsJson_h

#include "SensorNoiseExport.h"
#include "report/JsonWriter.h"
#include "sensornoise/SensorFlaws.h"

namespace sensornoise
{

/** Writes the settings of the flaws, a member for each of them. The members have the names of the settings without the
 * units, which are DN, electrons, pixels and rows as there. */
SensorNoise_EXPORT void
WriteJson(JsonWriter & json, const SensorFlaws & flaws);

} // namespace sensornoise

#endif
