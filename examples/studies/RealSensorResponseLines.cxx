// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorLines.h"

#include "simulation/SimulatedSensor.h"

#include <array>
#include <string>
#include <utility>

namespace sensornoise::tools
{
namespace
{
constexpr std::array<RealSensorScene, 2> ResponseScenes{ RealSensorScene::Target, RealSensorScene::Texture };

const std::vector<ResponseSettings> &
GetNonlinearResponses()
{
  static const std::vector<ResponseSettings> responses = [] {
    std::vector<ResponseSettings> all;
    for (const ResponseShape shape : { ResponseShape::Quadratic, ResponseShape::Wave, ResponseShape::Shoulder })
    {
      for (const double size : { -0.04, -0.02, 0.02, 0.04 })
      {
        all.push_back({ shape, size });
      }
    }
    return all;
  }();
  return responses;
}

const std::vector<ResponseSettings> &
GetToneCurves()
{
  static const std::vector<ResponseSettings> curves{ { ResponseShape::Gamma, 1.3 },
                                                     { ResponseShape::Gamma, 2.2 },
                                                     { ResponseShape::SCurve, 0.5 },
                                                     { ResponseShape::SCurve, 1.0 } };
  return curves;
}

RealSensorSetting
MakeNonlinearSetting(RealSensorScene scene, const ResponseSettings & response)
{
  auto setting = MakeRealSensorSetting(scene, std::string(NameOf(response.shape)) + ' ' + ShortText(response.size));
  setting.settings.flaws.response = response;
  return setting;
}

std::vector<RealSensorSetting>
MakeFullRangeSettings(const std::vector<ResponseSettings> & responses)
{
  std::vector<RealSensorSetting> all;
  for (const RealSensorScene scene : ResponseScenes)
  {
    for (const ResponseSettings & response : responses)
    {
      all.push_back(MakeNonlinearSetting(scene, response));
    }
  }
  return all;
}

/** Returns settings with the same responses, in which the scene covers only a part of the range. */
std::vector<RealSensorSetting>
MakeNarrowSettings()
{
  std::vector<ResponseSettings> responses = GetNonlinearResponses();
  responses.insert(responses.end(), GetToneCurves().begin(), GetToneCurves().end());
  std::vector<RealSensorSetting> all;
  for (const auto & [low, high] : { std::pair{ 0.2, 0.8 }, std::pair{ 0.05, 0.25 }, std::pair{ 0.4, 1.0 } })
  {
    for (RealSensorSetting setting : MakeFullRangeSettings(responses))
    {
      setting.name += ", " + ShortText(100.0 * low) + " to " + ShortText(100.0 * high) + " %";
      setting.darkestSignal = low;
      setting.brightestSignal = high;
      all.push_back(std::move(setting));
    }
  }
  return all;
}
} // namespace

void
AppendResponseLines(std::vector<RealSensorLine> & lines)
{
  lines.push_back({ "bends", "local gain off by 2 and 4 %, full range", [] {
                     return MakeFullRangeSettings(GetNonlinearResponses());
                   } });
  lines.push_back({ "gamma", "tone curves, full range", [] { return MakeFullRangeSettings(GetToneCurves()); } });
  lines.push_back({ "narrow", "non-linear responses and tone curves, parts of the range", MakeNarrowSettings });
}

} // namespace sensornoise::tools
