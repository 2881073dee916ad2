// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/SweepFiles.h"

#include "base/Text.h"
#include "tools/ErrorSentence.h"
#include "tools/EstimateOptions.h"
#include "tools/FileNames.h"
#include "tools/LowerCase.h"
#include "tools/SweepTable.h"
#include "itkSensorNoiseFrameFiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

/** A burst with what its name or its table, and its first file, say of its setting. */
struct FoundBurst
{
  SweepBurst                  burst;
  std::optional<NamedSetting> named;
  std::optional<double>       recordedIso;
  std::optional<double>       recordedExposure; ///< [s]
};

std::optional<double>
IfPositive(double number)
{
  return std::isfinite(number) && number > 0.0 ? std::optional<double>(number) : std::nullopt;
}

std::string
NameOfPath(const fs::path & path)
{
  const fs::path clean = path.has_filename() ? path : path.parent_path();
  return clean.filename().string();
}

FrameList
OpenFirst(const std::string & file, const EstimateOptions & options)
{
  return OpenFrames({ file }, {}, options.raw, options.choice);
}

/** Fills in the files of a burst, and the ISO speed that the first one records. What is wrong becomes its reason. */
void
FillBurst(const std::vector<std::string> & frames,
          const std::vector<std::string> & dark,
          const EstimateOptions &          options,
          FoundBurst &                     found)
{
  try
  {
    found.burst.files = ExpandNames(frames, !options.raw.empty());
    found.burst.dark = ExpandNames(dark, !options.raw.empty());
    const CameraSettings camera = OpenFirst(found.burst.files.front(), options).camera;
    found.recordedIso = IfPositive(camera.isoSpeed);
    found.recordedExposure = IfPositive(camera.exposureSeconds);
  }
  catch (const std::exception & error)
  {
    found.burst.reason = SentenceOf(error);
  }
}

FoundBurst
BurstInFolder(const fs::path & folder, const EstimateOptions & options)
{
  FoundBurst found;
  found.burst.name = NameOfPath(folder);
  found.named = SettingInName(found.burst.name);
  std::error_code ignored;
  const fs::path  dark = folder / "dark";
  FillBurst({ folder.string() },
            fs::is_directory(dark, ignored) ? std::vector<std::string>{ dark.string() } : std::vector<std::string>{},
            options,
            found);
  return found;
}

std::vector<std::string>
FoldersIn(const std::string & folder)
{
  std::vector<std::string> folders;
  for (const fs::directory_entry & entry : fs::directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && name.front() != '.' && name != "dark")
    {
      folders.push_back(entry.path().string());
    }
  }
  std::sort(folders.begin(), folders.end(), IsBefore);
  return folders;
}

/** Makes a burst of each stack, and of all single frames of one ISO speed; of one exposure if all have one ISO speed.
 */
std::vector<FoundBurst>
BurstsOfFiles(const std::vector<std::string> & files, const EstimateOptions & options)
{
  std::vector<FoundBurst> found;
  std::vector<FoundBurst> single; // frames
  for (const std::string & file : files)
  {
    const FrameList opened = OpenFirst(file, options);
    FoundBurst      each;
    each.burst.name = NameOfPath(file);
    each.burst.files = { file };
    each.recordedIso = IfPositive(opened.camera.isoSpeed);
    each.recordedExposure = IfPositive(opened.camera.exposureSeconds);
    if (opened.isStack)
    {
      each.named = SettingInName(fs::path(file).stem().string());
      found.push_back(each);
      continue;
    }
    if (!each.recordedIso)
    {
      throw std::invalid_argument(file + " records no ISO speed (--sweep), so that its burst is not known; expected a "
                                         "folder for each setting, for instance iso800, or a table (.csv)");
    }
    single.push_back(each);
  }
  const bool areExposures = std::all_of(single.begin(), single.end(), [&single](const FoundBurst & each) {
    return each.recordedIso == single.front().recordedIso && each.recordedExposure;
  });
  std::map<double, FoundBurst> bySetting;
  for (const FoundBurst & each : single)
  {
    const double setting = areExposures ? *each.recordedExposure : *each.recordedIso;
    FoundBurst & burst = bySetting.emplace(setting, each).first->second;
    burst.burst.name = SettingText(areExposures ? SettingKind::Exposure : SettingKind::Iso, setting);
    if (burst.burst.files != each.burst.files)
    {
      burst.burst.files.push_back(each.burst.files.front());
    }
  }
  const bool isOneExposure = areExposures && bySetting.size() == 1;
  for (auto & [setting, burst] : bySetting)
  {
    burst.burst.name = isOneExposure ? SettingText(SettingKind::Iso, *burst.recordedIso) : burst.burst.name;
    found.push_back(burst);
  }
  return found;
}

std::vector<FoundBurst>
BurstsOfTable(const std::string & file, const EstimateOptions & options)
{
  std::vector<FoundBurst> found;
  for (const SweepTableRow & row : ReadSweepTable(file))
  {
    FoundBurst burst;
    burst.burst.name = NameOfPath(row.frames);
    burst.named = row.setting;
    FillBurst({ row.frames }, row.dark.empty() ? std::vector<std::string>{} : std::vector{ row.dark }, options, burst);
    found.push_back(burst);
  }
  return found;
}

std::vector<FoundBurst>
BurstsOf(const std::vector<std::string> & names, const EstimateOptions & options)
{
  std::error_code ignored;
  if (names.size() == 1 && LowerCaseEnding(names.front()) == ".csv")
  {
    return BurstsOfTable(names.front(), options);
  }
  std::vector<std::string> folders;
  std::vector<std::string> files;
  for (const std::string & name : names)
  {
    (fs::is_directory(name, ignored) ? folders : files).push_back(name);
  }
  if (names.size() == 1 && !folders.empty())
  {
    folders = FoldersIn(names.front());
    files = folders.empty() ? names : files;
  }
  std::vector<FoundBurst> found = BurstsOfFiles(ExpandNames(files, !options.raw.empty()), options);
  for (const std::string & folder : folders)
  {
    found.push_back(BurstInFolder(folder, options));
  }
  return found;
}

/** Returns whether the bursts record one ISO speed and exposures that differ. */
bool
RecordExposures(const std::vector<FoundBurst> & bursts)
{
  std::set<double> exposures;
  for (const FoundBurst & each : bursts)
  {
    if (!each.recordedIso || each.recordedIso != bursts.front().recordedIso || !each.recordedExposure)
    {
      return false;
    }
    exposures.insert(*each.recordedExposure);
  }
  return exposures.size() > 1 && exposures.size() == bursts.size();
}

/** Returns what the settings are. Throws std::invalid_argument if they are of several kinds. */
SettingKind
KindOfSettings(const std::vector<FoundBurst> & bursts)
{
  const FoundBurst * first = nullptr;
  for (const FoundBurst & each : bursts)
  {
    if (each.named && first != nullptr && each.named->kind != first->named->kind)
    {
      throw std::invalid_argument("--sweep: " + first->burst.name + " is " +
                                  SettingText(first->named->kind, first->named->value) + " and " + each.burst.name +
                                  " is " + SettingText(each.named->kind, each.named->value) +
                                  "; expected settings of one kind");
    }
    first = each.named && first == nullptr ? &each : first;
  }
  return first != nullptr ? first->named->kind : RecordExposures(bursts) ? SettingKind::Exposure : SettingKind::Iso;
}

/** Decides on the setting of a burst. */
void
SetSetting(FoundBurst & found, SettingKind kind)
{
  constexpr double sameSetting = 0.01; // relative; ISO speeds and exposures are a quarter apart or more
  const auto       recorded = kind == SettingKind::Iso        ? found.recordedIso
                              : kind == SettingKind::Exposure ? found.recordedExposure
                                                              : std::nullopt;
  if (recorded)
  {
    found.burst.setting = recorded;
    if (found.named && std::abs(found.named->value / *recorded - 1.0) > sameSetting)
    {
      found.burst.reason = "its files record " + SettingText(kind, *recorded) + ", but " +
                           SettingText(kind, found.named->value) +
                           " was given; expected the same. Correct the name or the table";
    }
    return;
  }
  if (found.named)
  {
    found.burst.setting = found.named->value;
    return;
  }
  if (found.burst.reason.empty())
  {
    found.burst.reason = "its setting is not known: neither the files record an ISO speed, nor does the name hold one. "
                         "Name it for instance iso800, gain2.5 or 10ms, or give a table (.csv)";
  }
}

/** Gives the bursts of exposures that record another ISO speed than the first one a reason: their gain differs. */
void
RequireOneGain(std::vector<FoundBurst> & bursts)
{
  const auto first =
    std::find_if(bursts.begin(), bursts.end(), [](const FoundBurst & each) { return each.recordedIso.has_value(); });
  for (FoundBurst & each : bursts)
  {
    if (each.recordedIso && each.recordedIso != first->recordedIso && each.burst.reason.empty())
    {
      each.burst.reason = "its files record ISO " + Text(*each.recordedIso) + ", and the files of " +
                          first->burst.name + " ISO " + Text(*first->recordedIso) +
                          "; expected exposures at one ISO speed";
    }
  }
}

void
RefuseRepeated(std::vector<SweepBurst> & bursts)
{
  for (std::size_t i = 0; i < bursts.size(); ++i)
  {
    const auto same =
      std::find_if(bursts.begin(), bursts.begin() + static_cast<std::ptrdiff_t>(i), [&](const auto & each) {
        return each.setting && each.setting == bursts[i].setting && each.reason.empty();
      });
    if (same != bursts.begin() + static_cast<std::ptrdiff_t>(i) && bursts[i].reason.empty())
    {
      bursts[i].reason = "its setting is that of " + same->name +
                         ", which is measured; expected one burst for each "
                         "setting";
    }
  }
}
} // namespace

SweepPlan
FindBursts(const std::vector<std::string> & names, const EstimateOptions & options)
{
  std::vector<FoundBurst> found = BurstsOf(names, options);
  if (found.empty())
  {
    throw std::invalid_argument("--sweep: there is no burst in " + names.front() +
                                "; expected a folder with a folder for each setting, or a table (.csv)");
  }
  SweepPlan plan;
  plan.kind = KindOfSettings(found);
  if (plan.kind == SettingKind::Exposure)
  {
    RequireOneGain(found);
  }
  for (FoundBurst & each : found)
  {
    SetSetting(each, plan.kind);
    plan.bursts.push_back(each.burst);
  }
  std::stable_sort(plan.bursts.begin(), plan.bursts.end(), [](const SweepBurst & a, const SweepBurst & b) {
    return a.setting && (!b.setting || *a.setting < *b.setting);
  });
  RefuseRepeated(plan.bursts);
  return plan;
}

} // namespace sensornoise::tools
