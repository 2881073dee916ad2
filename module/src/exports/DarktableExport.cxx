// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/DarktableExport.h"

#include "base/Text.h"
#include "exports/ExportInput.h"
#include "report/JsonWriter.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
/** The preset of one ISO speed. */
struct DarktablePreset
{
  std::string           name;
  double                isoSpeed{ 0.0 };
  std::array<double, 3> a{}; // R, G, B
  std::array<double, 3> b{};
};

/** The presets of one camera, and the cameras of one maker: the levels of noiseprofiles.json. */
struct DarktableModel
{
  std::string                  model;
  std::vector<DarktablePreset> presets;
};
struct DarktableMaker
{
  std::string                 maker;
  std::vector<DarktableModel> models;
};

void
WriteJson(JsonWriter & json, const DarktablePreset & preset)
{
  json.Object([&] {
    json.Member("name", preset.name).Member("iso", preset.isoSpeed);
    json.Member("a", preset.a).Member("b", preset.b);
  });
}
void
WriteJson(JsonWriter & json, const DarktableModel & model)
{
  json.Object([&] { json.Member("model", model.model).Member("profiles", model.presets); });
}
void
WriteJson(JsonWriter & json, const DarktableMaker & maker)
{
  json.Object([&] { json.Member("maker", maker.maker).Member("models", maker.models); });
}

DarktablePreset
PresetOf(const CameraNoise & noise, const std::string & model)
{
  const auto      pairs = NoiseProfileOf(noise);
  const bool      isMono = pairs.size() == 1;
  DarktablePreset preset{ model + " iso " + Text(*noise.isoSpeed), *noise.isoSpeed, {}, {} };
  for (std::size_t i = 0; i < preset.a.size(); ++i)
  {
    const DarktableFactor & factor = isMono ? darktableMono : i == 1 ? darktableGreen : darktableRedBlue;
    const auto &            pair = pairs[isMono ? 0 : i];
    preset.a[i] = factor.value * pair.first;
    preset.b[i] = factor.value * pair.second;
  }
  return preset;
}

/** Returns the presets by rising ISO speed. Throws ExportError if two have the same. */
std::vector<DarktablePreset>
PresetsOf(std::vector<CameraNoise> settings, const std::string & model)
{
  std::stable_sort(settings.begin(), settings.end(), [](const CameraNoise & one, const CameraNoise & other) {
    return *one.isoSpeed < *other.isoSpeed;
  });
  std::vector<DarktablePreset> presets;
  for (const CameraNoise & noise : settings)
  {
    if (!presets.empty() && presets.back().isoSpeed == *noise.isoSpeed)
    {
      throw ExportError("two reports have the ISO speed " + Text(*noise.isoSpeed) +
                        "; expected one for each ISO speed. Leave one of them out.");
    }
    presets.push_back(PresetOf(noise, model));
  }
  return presets;
}

std::string
NoteOf(const CameraNoise & noise)
{
  const std::string percent = Percent(darktableGreen.standardDeviation / darktableGreen.value);
  const std::string names =
    noise.camera.empty() ? "Replace maker and model by the names" : "Compare maker and model with the names";
  const std::string factors = noise.channels.size() == 1
                                ? "The numbers are a quarter of the variance, as darktable measures it. "
                                : "Green was calibrated on darktable 4.2.1 to " + percent +
                                    ". Red and blue are those of grey light; darktable does not use them. ";
  return factors + names + " that darktable's image information shows, and start darktable --noiseprofiles FILE.";
}
} // namespace

NoiseExport
ExportDarktable(const std::vector<CameraNoise> & settings)
{
  RequireIsoSpeeds(settings, "darktable");
  const std::string                 camera = settings.front().camera.empty() ? "Maker Model" : settings.front().camera;
  const std::size_t                 blank = std::min(camera.find(' '), camera.size());
  const std::string                 model = blank < camera.size() ? camera.substr(blank + 1) : camera;
  const std::vector<DarktableMaker> makers{ { camera.substr(0, blank), { { model, PresetsOf(settings, model) } } } };
  std::string                       text;
  JsonWriter                        json(text);
  json.Object([&] { json.Member("version", 0).Member("noiseprofiles", makers); });
  return OneFile("darktable_noiseprofiles.json", text + '\n', NoteOf(settings.front()));
}

} // namespace sensornoise
