// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_TruthJson_h
#define sensornoise_simulation_TruthJson_h

#include "SensorNoiseExport.h"
#include "simulation/SimulationTruth.h"

#include <cstddef>
#include <string>

namespace sensornoise
{

/** The truth of a simulated stack as JSON, schema "itk-sensornoise-truth/1": every parameter by the names of the
 * report, and the random series. Numbers that do not exist (a standard deviation of one frame) are null. */
SensorNoise_EXPORT std::string
ToJson(const SimulationTruth & truth, std::size_t width, std::size_t height);

} // namespace sensornoise

#endif
