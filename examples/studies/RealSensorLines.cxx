// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorLines.h"

#include <array>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace sensornoise::tools
{
namespace
{
constexpr std::array<RealSensorScene, 2> Scenes{ RealSensorScene::Target, RealSensorScene::Texture };

/** Returns settings of cameras A, B and C with the vibrations of conditions 1, 2 and 3, without and with flicker. In
 * some of them the offset is not identifiable. */
std::vector<RealSensorSetting>
MakeBracketSettings()
{
  std::vector<RealSensorSetting> all;
  for (const bool flickers : { false, true })
  {
    for (const RealSensorScene scene : Scenes)
    {
      for (const char camera : { 'A', 'B', 'C' })
      {
        for (const int condition : { 1, 2, 3 })
        {
          const std::string experiment = camera + std::to_string(condition);
          auto              setting = MakeRealSensorSetting(scene, experiment + (flickers ? "" : " without flicker"));
          setting.settings.camera = PaperCamera(camera);
          setting.settings.conditions = PaperConditions(condition);
          if (!flickers)
          {
            setting.settings.conditions.flickerSd = 0.0;
          }
          all.push_back(std::move(setting));
        }
      }
    }
  }
  return all;
}

std::vector<RealSensorSetting>
MakeCrossingSettings()
{
  std::vector<RealSensorSetting> all;
  for (const std::size_t frames : { 20, 50, 100 }) // with fewer frames the block moves faster
  {
    for (const RealSensorScene scene : Scenes)
    {
      all.push_back(MakeRealSensorSetting(scene, "a block crosses two thirds of the rows"));
      all.back().settings.frames = frames;
      all.back().isCrossed = true;
    }
  }
  return all;
}
} // namespace

RealSensorSetting
MakeRealSensorSetting(RealSensorScene scene, std::string name)
{
  RealSensorSetting setting;
  setting.name = std::move(name);
  setting.scene = scene;
  setting.settings.camera = PaperCamera('B');
  setting.settings.conditions = PaperConditions(3);
  setting.settings.frames = 50;
  return setting;
}

std::string
ShortText(double number)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%g", number);
  return text;
}

void
AppendSceneLines(std::vector<RealSensorLine> & lines)
{
  lines.push_back({ "brackets", "physical limits of the offset, without and with flicker", MakeBracketSettings });
  lines.push_back({ "crossing", "a textured block as wide as a third of the frame passes", MakeCrossingSettings });
}

std::vector<RealSensorLine>
GetRealSensorLines()
{
  std::vector<RealSensorLine> lines;
  AppendResponseLines(lines);
  AppendPixelLines(lines);
  AppendSceneLines(lines);
  AppendProcessedLines(lines);
  return lines;
}

} // namespace sensornoise::tools
