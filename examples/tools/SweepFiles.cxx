// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/SweepFiles.h"

#include "tools/ErrorSentence.h"
#include "tools/EstimateOptions.h"
#include "tools/FileNames.h"
#include "tools/LowerCase.h"
#include "tools/SweepSettings.h"
#include "tools/SweepTable.h"
#include "itkSensorNoiseFrameFiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <utility>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

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

/** Fills in the files of a burst, and the ISO speed that the first one records. A failure becomes the reason of the
 * burst. */
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
    std::error_code ignored;
    if (!fs::exists(file, ignored))
    {
      throw std::invalid_argument("--sweep: " + file +
                                  " does not exist; expected a folder with a folder for each setting, stacks, frames "
                                  "that record their ISO speed, or a table (.csv)");
    }
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
  return PlanSweep(std::move(found));
}

} // namespace sensornoise::tools
