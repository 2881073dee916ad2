// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorSituations_h
#define RealSensorSituations_h

#include "studies/RealSensorSetting.h"

#include <functional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Appends ten settings, each changed by \a change and with \a name in its name. They are the test chart and the
 * texture in front of all three cameras, with 50 and 100 frames, with and without flicker and motion. \param kinds
 * noise classes that the reports may give */
void
AppendEverywhere(std::vector<RealSensorSetting> &                 all,
                 const std::string &                              name,
                 const std::vector<std::string> &                 kinds,
                 const std::function<void(RealSensorSetting &)> & change);

} // namespace sensornoise::tools

#endif
