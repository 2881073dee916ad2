// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/SweepFiles.h"

#include "base/Text.h"
#include "tools/ErrorSentence.h"
#include "tools/EstimateOptions.h"
#include "tools/FileNames.h"
#include "tools/LowerCase.h"
#include "tools/SweepTable.h"
#include "tools/TextColumns.h"
#include "itkSensorNoiseFrameFiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
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
};

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
    const double iso = OpenFirst(found.burst.files.front(), options).camera.isoSpeed;
    if (std::isfinite(iso) && iso > 0.0)
    {
      found.recordedIso = iso;
    }
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

/** Makes a burst of each stack, and of all single frames of one ISO speed. */
std::vector<FoundBurst>
BurstsOfFiles(const std::vector<std::string> & files, const EstimateOptions & options)
{
  std::vector<FoundBurst>      found;
  std::map<double, FoundBurst> byIso;
  for (const std::string & file : files)
  {
    const FrameList opened = OpenFirst(file, options);
    const double    iso = opened.camera.isoSpeed;
    const bool      hasIso = std::isfinite(iso) && iso > 0.0;
    if (opened.isStack)
    {
      FoundBurst stack;
      stack.burst.name = NameOfPath(file);
      stack.burst.files = { file };
      stack.named = SettingInName(fs::path(file).stem().string());
      stack.recordedIso = hasIso ? std::optional<double>(iso) : std::nullopt;
      found.push_back(stack);
      continue;
    }
    if (!hasIso)
    {
      throw std::invalid_argument(file + " records no ISO speed (--sweep), so that its burst is not known; expected a "
                                         "folder for each setting, for instance iso800, or a table (.csv)");
    }
    FoundBurst & burst = byIso[iso];
    burst.burst.name = "ISO " + Text(iso);
    burst.burst.files.push_back(file);
    burst.recordedIso = iso;
  }
  std::transform(byIso.begin(), byIso.end(), std::back_inserter(found), [](const auto & each) { return each.second; });
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

/** Returns whether the settings are ISO speeds. Throws std::invalid_argument if there are gains, too. */
bool
AreIso(const std::vector<FoundBurst> & bursts)
{
  const FoundBurst * gain = nullptr;
  const FoundBurst * iso = nullptr;
  for (const FoundBurst & each : bursts)
  {
    if (each.named)
    {
      (each.named->isIso ? iso : gain) = &each;
    }
  }
  if (gain != nullptr && iso != nullptr)
  {
    throw std::invalid_argument("--sweep: " + gain->burst.name + " has a gain and " + iso->burst.name +
                                " an ISO speed; expected settings of one kind");
  }
  return gain == nullptr;
}

/** Decides on the setting of a burst. */
void
SetSetting(FoundBurst & found, bool isIso)
{
  constexpr double sameIso = 0.01; // relative; ISO speeds are a quarter apart or more
  if (isIso && found.recordedIso)
  {
    found.burst.setting = found.recordedIso;
    if (found.named && std::abs(found.named->value / *found.recordedIso - 1.0) > sameIso)
    {
      found.burst.reason = "its files record ISO " + Text(*found.recordedIso) + ", but ISO " +
                           Text(found.named->value) + " was given; expected the same. Correct the name or the table";
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
                         "Name it for instance iso800 or gain2.5, or give a table (.csv)";
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

std::optional<NamedSetting>
SettingInName(const std::string & name)
{
  static const std::regex iso("(?:^|.*[^a-z])iso[ _-]*([0-9]+(?:\\.[0-9]+)?)(?:[^0-9.].*)?");
  static const std::regex gain("(?:^|.*[^a-z])gain[ _]*([+-]?[0-9]+(?:\\.[0-9]+)?)[ _]*(db)?(?:[^0-9.].*)?");
  static const std::regex number("[0-9]+(?:\\.[0-9]+)?");
  const std::string       text = LowerCase(name);
  std::smatch             found;
  NamedSetting            setting;
  if (std::regex_match(text, found, iso))
  {
    setting.value = NumberOf(found[1].str()).value_or(0.0);
  }
  else if (std::regex_match(text, found, gain))
  {
    setting.isIso = false;
    const double value = NumberOf(found[1].str()).value_or(0.0);
    setting.value = found[2].matched ? GainOfDecibels(value) : value;
  }
  else if (std::regex_match(text, number))
  {
    setting.value = NumberOf(text).value_or(0.0);
  }
  return std::isfinite(setting.value) && setting.value > 0.0 ? std::optional<NamedSetting>(setting) : std::nullopt;
}

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
  plan.isIso = AreIso(found);
  for (FoundBurst & each : found)
  {
    SetSetting(each, plan.isIso);
    plan.bursts.push_back(each.burst);
  }
  std::stable_sort(plan.bursts.begin(), plan.bursts.end(), [](const SweepBurst & a, const SweepBurst & b) {
    return a.setting && (!b.setting || *a.setting < *b.setting);
  });
  RefuseRepeated(plan.bursts);
  return plan;
}

} // namespace sensornoise::tools
