// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorSituations.h"

#include "studies/RealSensorLines.h"

#include <cstddef>
#include <utility>

namespace sensornoise::tools
{
namespace
{
struct Situation
{
  char        camera;
  int         condition; ///< 0: no flicker and no vibration
  std::size_t frames;
};

constexpr Situation Situations[] = { { 'B', 3, 50 }, { 'B', 3, 100 }, { 'A', 2, 50 }, { 'C', 2, 100 }, { 'B', 0, 50 } };

std::string
TextOf(const Situation & situation)
{
  return std::string(1, situation.camera) +
         (situation.condition > 0 ? std::to_string(situation.condition) : std::string(" still"));
}
} // namespace

void
AppendEverywhere(std::vector<RealSensorSetting> &                 all,
                 const std::string &                              name,
                 const std::vector<std::string> &                 kinds,
                 const std::function<void(RealSensorSetting &)> & change)
{
  for (const RealSensorScene scene : { RealSensorScene::Target, RealSensorScene::Texture })
  {
    for (const Situation & situation : Situations)
    {
      auto setting = MakeRealSensorSetting(scene, TextOf(situation) + ", " + name);
      setting.settings.camera = PaperCamera(situation.camera);
      setting.settings.conditions =
        situation.condition > 0 ? PaperConditions(situation.condition) : SceneConditions{ 0.0, 0.0, 0.0 };
      setting.settings.frames = situation.frames;
      setting.kinds = kinds;
      change(setting);
      all.push_back(std::move(setting));
    }
  }
}

} // namespace sensornoise::tools
