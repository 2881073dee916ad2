// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorLines.h"

#include <cstddef>
#include <string>
#include <utility>

namespace sensornoise::tools
{
namespace
{
/** Fixed-pattern noise of a flat field. */
struct NamedPattern
{
  const char * name;
  void (*apply)(SimulationSettings &);
};

constexpr NamedPattern FlatPatterns[] = {
  { "no pattern", [](SimulationSettings &) {} },
  { "gains 0.3 %", [](SimulationSettings & settings) { settings.flaws.pattern.gainSd = 0.003; } },
  { "gains 1 %", [](SimulationSettings & settings) { settings.flaws.pattern.gainSd = 0.01; } },
  { "efficiency 1 %", [](SimulationSettings & settings) { settings.prnuSd = 0.01; } },
  { "offsets 10 DN", [](SimulationSettings & settings) { settings.dsnuSdDn = 10.0; } },
  { "column gains 1 %", [](SimulationSettings & settings) { settings.flaws.pattern.columnGainSd = 0.01; } }
};

/** Illumination of a flat field: expected electrons [e-] and standard deviation of the flicker [1]. */
struct FlatIllumination
{
  double electrons;
  double flickerSd;
};

RealSensorSetting
MakeFlatSetting(const NamedPattern & pattern, double shading, const FlatIllumination & illumination, std::size_t frames)
{
  auto setting = MakeRealSensorSetting(RealSensorScene::Flat,
                                       std::string(pattern.name) + ", shading " + ShortText(100.0 * shading) + " %, " +
                                         ShortText(illumination.electrons) + " e-, flicker " +
                                         ShortText(100.0 * illumination.flickerSd) + " %");
  setting.shading = shading;
  setting.settings.camera.electrons = illumination.electrons;
  setting.settings.conditions = { illumination.flickerSd, 0.0, 0.0 };
  setting.settings.bitDepth = 14; // 7000 e- at 1 DN/e- exceed 12 bits
  setting.settings.frames = frames;
  pattern.apply(setting.settings);
  return setting;
}

std::vector<RealSensorSetting>
MakeFlatSettings(bool hasDarkFrames)
{
  std::vector<RealSensorSetting> all;
  for (const std::size_t frames : { 8, 50 })
  {
    for (const FlatIllumination & illumination :
         { FlatIllumination{ 3000.0, 0.0 }, { 3000.0, 0.003 }, { 7000.0, 0.003 } })
    {
      for (const double shading : { 0.001, 0.003, 0.03 })
      {
        for (const NamedPattern & pattern : FlatPatterns)
        {
          all.push_back(MakeFlatSetting(pattern, shading, illumination, frames));
          all.back().hasDarkFrames = hasDarkFrames;
        }
      }
    }
  }
  return all;
}

/** Returns an sCMOS sensor. The read noise of its pixels has a median of 1.4 e- and a root mean square of 1.6 to 2
 * e-. */
RealSensorSetting
MakeScmosSetting(RealSensorScene scene, double gain, double electrons, double flickerSd, bool hasLongTail)
{
  auto                 setting = MakeRealSensorSetting(scene,
                                       ShortText(gain) + " DN/e-, " + ShortText(electrons) + " e-, flicker " +
                                         ShortText(100.0 * flickerSd) + " %, " + (hasLongTail ? "long tail" : "wide"));
  SimulationSettings & settings = setting.settings;
  settings.camera = { electrons, gain, 100.0, 1.4 * gain };
  settings.conditions.flickerSd = flickerSd;
  settings.frames = 60;
  settings.dsnuSdDn = 2.0 * gain;
  settings.flaws.pattern.gainSd = 0.01;
  settings.flaws.readNoise = hasLongTail ? ReadNoiseSettings{ 0.35, 0.03, 1.0 } : ReadNoiseSettings{ 0.5, 0.05, 0.7 };
  return setting;
}

std::vector<RealSensorSetting>
MakeScmosSettings(bool hasDarkFrames)
{
  std::vector<RealSensorSetting> all;
  for (const RealSensorScene scene : { RealSensorScene::Target, RealSensorScene::Texture })
  {
    for (const double gain : { 1.0, 2.2 })
    {
      for (const double electrons : { 30.0, 200.0 })
      {
        for (const double flickerSd : { 0.05, 0.0 })
        {
          for (const bool hasLongTail : { true, false })
          {
            all.push_back(MakeScmosSetting(scene, gain, electrons, flickerSd, hasLongTail));
            all.back().hasDarkFrames = hasDarkFrames;
          }
        }
      }
    }
  }
  return all;
}
} // namespace

void
AppendPixelLines(std::vector<RealSensorLine> & lines)
{
  lines.push_back({ "flats", "flat fields with shading and patterns", [] { return MakeFlatSettings(false); } });
  lines.push_back({ "flats-dark", "the same, with as many dark frames", [] { return MakeFlatSettings(true); } });
  lines.push_back({ "scmos", "read noise, offset and gain of each pixel", [] { return MakeScmosSettings(false); } });
  lines.push_back({ "scmos-dark", "the same, with as many dark frames", [] { return MakeScmosSettings(true); } });
}

} // namespace sensornoise::tools
