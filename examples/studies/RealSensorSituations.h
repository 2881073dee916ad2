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

/** Appends the test chart and the texture before all three cameras, 50 and 100 frames, with flicker and motion and
 * without: ten settings, each changed by \a change and called \a name. \param kinds what their noise may be called */
void
AppendEverywhere(std::vector<RealSensorSetting> &                 all,
                 const std::string &                              name,
                 const std::vector<std::string> &                 kinds,
                 const std::function<void(RealSensorSetting &)> & change);

} // namespace sensornoise::tools

#endif
