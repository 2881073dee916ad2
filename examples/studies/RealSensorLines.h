// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorLines_h
#define RealSensorLines_h

#include "studies/RealSensorSetting.h"

#include <functional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Settings whose results form one line of the tables. */
struct RealSensorLine
{
  std::string                                     name;
  std::string                                     what; ///< one-line description
  std::function<std::vector<RealSensorSetting>()> makeSettings;
};

/** Returns all lines, in the order in which they are reported. */
std::vector<RealSensorLine>
GetRealSensorLines();

/** Appends non-linear responses, over the whole range of the scene and over parts of it. */
void
AppendResponseLines(std::vector<RealSensorLine> & lines);

/** Appends flat fields with fixed-pattern noise, and sCMOS sensors, each with and without dark frames. */
void
AppendPixelLines(std::vector<RealSensorLine> & lines);

/** Appends sensors with spatial or temporal noise correlation and cameras that process their frames, together with
 * unprocessed ones. */
void
AppendProcessedLines(std::vector<RealSensorLine> & lines);

/** Appends bounds of the offset, and a moving object that crosses the frame. */
void
AppendSceneLines(std::vector<RealSensorLine> & lines);

/** Returns a setting with camera B in condition 3 and 50 frames of \a scene. */
RealSensorSetting
MakeRealSensorSetting(RealSensorScene scene, std::string name);

/** Returns a number as the names of settings contain it: "0.3". */
std::string
ShortText(double number);

} // namespace sensornoise::tools

#endif
