// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0

#include "base/Text.h"
#include "exports/ExportFormats.h"
#include "exports/NoiseProfile.h"
#include "report/JsonWriter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
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
                                    ". Red and blue are the values for grey light; darktable does not use them. ";
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

namespace
{
std::string
PresetText(const StoredReport & record, const std::string & pointer)
{
  const auto found = record.texts.find(pointer);
  return found == record.texts.end() ? "" : found->second;
}

/** Returns a number of a preset. Throws ExportError if there is none. */
double
PresetNumber(const StoredReport & record, const std::string & pointer)
{
  const auto found = record.numbers.find(pointer);
  if (found == record.numbers.end() || !std::isfinite(found->second))
  {
    throw ExportError("the presets of darktable in " + record.name + " have no number " + pointer +
                      "; expected for each ISO speed iso, and a and b with three numbers each");
  }
  return found->second;
}

/** Adds the presets of the camera at a JSON Pointer. */
void
AddPresets(const StoredReport &            record,
           const std::string &             camera,
           const std::string &             at,
           std::vector<DarktableNumbers> & presets)
{
  for (std::size_t i = 0;; ++i)
  {
    const std::string preset = at + "/profiles/" + std::to_string(i);
    const auto        first = record.numbers.lower_bound(preset + "/");
    if (first == record.numbers.end() || first->first.compare(0, preset.size() + 1, preset + "/") != 0)
    {
      return;
    }
    presets.push_back({ camera,
                        PresetNumber(record, preset + "/iso"),
                        PresetNumber(record, preset + "/a/1"),
                        PresetNumber(record, preset + "/b/1") });
  }
}

/** Returns the presets of the burst's camera by rising ISO speed. Throws ExportError if there are none. */
std::vector<DarktableNumbers>
PresetsOfCamera(const NoiseProfile & profile, const CameraNoise & burst)
{
  std::set<std::string>         cameras;
  std::vector<DarktableNumbers> presets;
  for (const DarktableNumbers & preset : profile.darktable)
  {
    cameras.insert(preset.camera);
    if (LowerCase(preset.camera) == LowerCase(burst.camera))
    {
      presets.push_back(preset);
    }
  }
  presets = cameras.size() == 1 ? profile.darktable : presets;
  if (presets.empty())
  {
    throw ExportError("the file " + profile.file + " has presets of " + std::to_string(cameras.size()) +
                      " cameras, and none of " +
                      (burst.camera.empty() ? "the camera of the frames, whose files do not name it" : burst.camera) +
                      ". Give a file with the presets of this camera alone.");
  }
  std::stable_sort(presets.begin(), presets.end(), [](const DarktableNumbers & one, const DarktableNumbers & other) {
    return one.isoSpeed < other.isoSpeed;
  });
  return presets;
}
} // namespace

NoiseProfile
ReadDarktablePresets(const ProfileValues & values)
{
  const StoredReport & record = values.Record();
  NoiseProfile         profile;
  profile.form = ProfileForm::Normalised;
  profile.relativeError = darktableGreen.standardDeviation / darktableGreen.value;
  for (std::size_t i = 0;; ++i)
  {
    const std::string at = "/noiseprofiles/" + std::to_string(i);
    const std::string maker = PresetText(record, at + "/maker");
    if (maker.empty())
    {
      break;
    }
    for (std::size_t j = 0;; ++j)
    {
      const std::string model = PresetText(record, at + "/models/" + std::to_string(j) + "/model");
      if (model.empty())
      {
        break;
      }
      AddPresets(record, maker + ' ' + model, at + "/models/" + std::to_string(j), profile.darktable);
    }
  }
  if (profile.darktable.empty())
  {
    throw ExportError("the file " + record.name +
                      " has noiseprofiles, as darktable has them, but no preset; expected maker, models and profiles");
  }
  return profile;
}

ProfileChannel
DarktableChannelAt(const NoiseProfile & profile, const CameraNoise & burst)
{
  if (!burst.isoSpeed || !(*burst.isoSpeed > 0.0))
  {
    throw ExportError("the profile " + profile.file +
                      " depends on the ISO speed, and the frames' files do not have it; expected camera raw files");
  }
  const double iso = *burst.isoSpeed;
  const auto   presets = PresetsOfCamera(profile, burst);
  const auto   above = std::find_if(
    presets.begin(), presets.end(), [iso](const DarktableNumbers & preset) { return preset.isoSpeed >= iso; });
  if (above == presets.end() || (above == presets.begin() && above->isoSpeed > iso))
  {
    throw ExportError("the presets in " + profile.file + " have ISO speeds from " + Text(presets.front().isoSpeed) +
                      " to " + Text(presets.back().isoSpeed) + ", and the frames ISO " + Text(iso) +
                      "; expected a preset of this speed, or on either side of it");
  }
  const auto   below = above->isoSpeed > iso ? std::prev(above) : above;
  const double part = above == below ? 0.0 : (iso - below->isoSpeed) / (above->isoSpeed - below->isoSpeed);
  const double a = below->a + part * (above->a - below->a);
  const double b = below->b + part * (above->b - below->b);
  if (!(a > 0.0))
  {
    throw ExportError("the preset of ISO " + Text(iso) + " in " + profile.file + " has a = " + Text(a) +
                      " for green; expected a number above 0");
  }
  const double factor = (burst.channels.front().channel == "mono" ? darktableMono : darktableGreen).value;
  return { "mono", a / factor, b / factor, {} };
}

} // namespace sensornoise
