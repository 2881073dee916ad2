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

/** Scene in front of the camera. */
enum class RealSensorScene
{
  Target,  ///< MakeTargetScene()
  Texture, ///< MakeTextureScene()
  Flat     ///< uniform field with the shading of the lens
};

/** Returns the name that the tables print: "target", "texture" or "flat". */
inline const char *
NameOf(RealSensorScene scene)
{
  return scene == RealSensorScene::Target ? "target" : scene == RealSensorScene::Texture ? "texture" : "flat";
}

/** Setting of the study: a sensor with its flaws in front of a scene. */
struct RealSensorSetting
{
  std::string        name; ///< name of the setting within its line
  RealSensorScene    scene{ RealSensorScene::Target };
  SimulationSettings settings; ///< settings of the simulator; the seed is set when the stack is made

  /** Signal at the darkest and the brightest level of the scene, in units of camera.electrons [1], 0 <= darkest <
   * brightest <= 1. A flat field uses only the brightest level. */
  double darkestSignal{ 0.0 };
  double brightestSignal{ 1.0 };
  /** Shading of a flat field: fraction by which its corners are darker than its centre [1], 0 or more, below 1. */
  double shading{ 0.0 };

  bool hasDarkFrames{ false }; ///< dark frames of the same sensor, as many as bright frames
  bool isCrossed{ false };     ///< a textured block crosses the frame
  /** There are two light sources, each with independent flicker of conditions.flickerSd and with its own part of the
   * scene. The true flicker of such a stack is not defined. */
  bool hasTwoSources{ false };

  /** Noise classes that the report may give; empty: any. */
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
