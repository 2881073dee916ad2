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

/** Settings that are judged together. */
struct RealSensorLine
{
  std::string                                     name;
  std::string                                     what; ///< one line for people
  std::function<std::vector<RealSensorSetting>()> makeSettings;
};

/** All lines, in the order in which they are reported. */
std::vector<RealSensorLine>
GetRealSensorLines();

/** Bent responses, over the whole range of the scene and over parts of it. */
void
AppendResponseLines(std::vector<RealSensorLine> & lines);

/** Flat fields with patterns of the pixels, and sCMOS sensors, each with and without dark frames. */
void
AppendPixelLines(std::vector<RealSensorLine> & lines);

/** Sensors whose pixels share noise, and cameras that process their frames, beside plain ones. */
void
AppendProcessedLines(std::vector<RealSensorLine> & lines);

/** Brackets of the offset, and an object that crosses the frame. */
void
AppendSceneLines(std::vector<RealSensorLine> & lines);

/** Camera B in condition 3, 50 frames of \a scene. */
RealSensorSetting
MakeRealSensorSetting(RealSensorScene scene, std::string name);

/** A number as names of settings have it: "0.3". */
std::string
ShortText(double number);

} // namespace sensornoise::tools

#endif
