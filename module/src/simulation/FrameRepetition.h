// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_FrameRepetition_h
#define sensornoise_simulation_FrameRepetition_h

#include "sensornoise/SensorFlaws.h"
#include "simulation/SettingChecks.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

/** \throws std::invalid_argument if the setting cannot be used. */
inline void
CheckSettings(const RepetitionSettings & settings)
{
  RequireSetting(
    settings.count >= 1, "number of times that a frame is written", static_cast<double>(settings.count), "1 or more");
  RequireSetting(
    settings.period >= 1, "period of repeated frames", static_cast<double>(settings.period), "1 or more exposures");
}

} // namespace sensornoise

#endif
