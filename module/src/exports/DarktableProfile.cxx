// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/DarktableProfile.h"

#include "base/LowerCase.h"
#include "base/Text.h"
#include "exports/DarktableExport.h"
#include "exports/ProfileValues.h"

#include <algorithm>
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
