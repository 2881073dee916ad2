// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef SweepSettings_h
#define SweepSettings_h

#include "tools/SweepFiles.h"

#include <optional>
#include <vector>

namespace sensornoise::tools
{

/** A burst with what its name or its table, and its first file, say of its setting. */
struct FoundBurst
{
  SweepBurst                  burst;
  std::optional<NamedSetting> named;
  std::optional<double>       recordedIso;
  std::optional<double>       recordedExposure; ///< [s]
};

/** Decides on the setting of each burst, and sorts the bursts by it. A burst whose setting is not known, contradicts
 * its files, or is the setting of another burst gets a reason. Throws std::invalid_argument if the names of \a found
 * give settings of several kinds. */
SweepPlan
PlanSweep(std::vector<FoundBurst> found);

} // namespace sensornoise::tools

#endif
