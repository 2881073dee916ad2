// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorSetting_h
#define RealSensorSetting_h

#include "sensornoise/SimulationSettings.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** What the camera looks at. */
enum class RealSensorScene
{
  Target,  ///< MakeTargetScene()
  Texture, ///< MakeTextureScene()
  Flat     ///< one level, with the lens's shading
};

/** The name as the table prints it: "target", "texture", "flat". */
inline const char *
NameOf(RealSensorScene scene)
{
  return scene == RealSensorScene::Target ? "target" : scene == RealSensorScene::Texture ? "texture" : "flat";
}

/** One setting of the study: a sensor with its flaws, in front of a scene. */
struct RealSensorSetting
{
  std::string        name; ///< what sets it apart from the others of its line
  RealSensorScene    scene{ RealSensorScene::Target };
  SimulationSettings settings; ///< the seed is that of the stack, set when it is made

  /** The light of the scene's darkest and brightest level in units of camera.electrons [1], 0 <= darkest < brightest
   * <= 1. A flat field has the brightest one. */
  double darkestLight{ 0.0 };
  double brightestLight{ 1.0 };
  /** Of a flat field: how much darker its corners are than its middle [1], 0 or more, below 1. */
  double shading{ 0.0 };

  bool hasDarkFrames{ false }; ///< as many as bright ones, from the same sensor, give the offset
  bool isCrossed{ false };     ///< a textured block moves through the frame
  /** Two lamps, each with flicker of conditions.flickerSd of its own, and with its own part of the scene. Such a stack
   * has no one flicker. */
  bool hasTwoLamps{ false };

  /** What the report may call the noise, as KindOf() has it; empty: any. */
  std::vector<std::string> kinds;

  bool
  HasPattern() const
  {
    const PatternSettings & pattern = settings.flaws.pattern;
    return settings.prnuSd > 0.0 || settings.dsnuSdDn > 0.0 || pattern.gainSd > 0.0 || pattern.columnGainSd > 0.0;
  }
};

} // namespace sensornoise::tools

#endif
