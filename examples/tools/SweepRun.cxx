// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/SweepRun.h"

#include "base/Text.h"
#include "sensornoise/Version.h"
#include "tools/CompanionFiles.h"
#include "tools/ErrorSentence.h"
#include "tools/EstimateOptions.h"
#include "tools/FilesHash.h"
#include "tools/FilesInUse.h"
#include "tools/ModelCheck.h"
#include "tools/PassportFile.h"
#include "tools/PendingFile.h"
#include "tools/StackEstimate.h"
#include "tools/SweepFiles.h"
#include "tools/TerminalText.h"
#include "itkSensorNoiseFrameFiles.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace sensornoise::tools
{
namespace
{
/** Returns the options of a measurement of one burst. */
EstimateOptions
OptionsOf(const EstimateOptions & options, const SweepBurst & burst)
{
  EstimateOptions one = options;
  one.files = burst.files;
  one.dark = burst.dark;
  one.plot.clear();
  one.hash = HasHash();
  return one;
}

/** Opens the frames that are measured, and applies --frames to the options. */
FrameList
OpenBurst(EstimateOptions & one)
{
  const bool areStacks = one.files.size() == 1 || OpenFrames({ one.files.front() }, {}, one.raw, one.choice).isStack;
  one.SelectFiles(areStacks);
  return OpenFrames(one.files, {}, one.raw, one.choice);
}

/** Throws std::runtime_error if the frames record different ISO speeds. */
void
RequireOneIso(const FrameList & list)
{
  for (const FrameFile & file : list.files)
  {
    const double first = list.files.front().camera.isoSpeed;
    if (file.camera.isoSpeed != first && file.camera.isoSpeed > 0.0 && first > 0.0)
    {
      throw std::runtime_error("the frames record different ISO speeds, " + Text(first) + " (" +
                               list.files.front().name + ") and " + Text(file.camera.isoSpeed) + " (" + file.name +
                               "); expected one setting");
    }
  }
}

template <typename T>
bool
HasMember(const nlohmann::json & record, const char * name, const T & value)
{
  const auto found = record.find(name);
  return found != record.end() && *found == value;
}

bool
IsSameInput(const InputFiles & files, const nlohmann::json & stored)
{
  return HasMember(stored, "of", "files") && HasMember(stored, "sha256", files.sha256) &&
         HasMember(stored, "files", files.files) && HasMember(stored, "bytes", files.bytes);
}

/** Returns whether a stored report is from these files. Reads them once. */
bool
IsOfFiles(const nlohmann::json & report, const EstimateOptions & one, const FrameList & list)
{
  const auto input = report.find("input");
  if (input == report.end() || !input->is_object() || input->contains("dark") == one.dark.empty() ||
      !HasMember(report, "version", GetModuleVersion()))
  {
    return false;
  }
  return IsSameInput(HashOf(list), *input) &&
         (one.dark.empty() || IsSameInput(HashOf(OpenFrames(one.dark, {}, one.raw, one.choice)), (*input)["dark"]));
}

/** Returns whether stored options are the options of this call. Python writes "{}" if there are none; it writes others
 * in another way, which are not compared. */
bool
AreSameOptions(const std::string & stored, const std::string & options)
{
  return stored == options || (stored == "{}" && options.empty());
}

/** Returns the stored report of a burst; none if it has to be measured. */
const PassportEntry *
StoredEntry(const Passport & stored, const PassportEntry & entry, const EstimateOptions & one, const FrameList & list)
{
  const auto found = std::find_if(stored.entries.begin(), stored.entries.end(), [&](const PassportEntry & each) {
    return each.reason.empty() && each.setting == entry.setting && AreSameOptions(each.options, entry.options);
  });
  const bool canBeUsed = found != stored.entries.end() && HasHash() && one.mask.empty();
  return canBeUsed && IsOfFiles(found->report, one, list) ? &*found : nullptr;
}

/** Returns the first error of a report without a result. */
std::string
ReasonOf(const MeasuredStack & measured)
{
  for (const Report * const report : ReportsOf(measured))
  {
    for (const Warning & warning : report->warnings)
    {
      if (KindOf(warning.code).severity == Severity::Error)
      {
        return warning.message;
      }
    }
  }
  return "neither its gain nor its intercept is identified";
}

void
PrintStep(const EstimateOptions & options, const PassportEntry & entry, const char * what)
{
  if (!options.quiet)
  {
    std::cerr << entry.name << ": " << what << '\n';
  }
}

PassportEntry
MeasureBurst(const EstimateOptions & options, const SweepBurst & burst, const Passport & stored)
{
  PassportEntry entry;
  entry.name = burst.name;
  entry.setting = burst.setting;
  entry.reason = burst.reason;
  entry.options = options.optionsText;
  if (!entry.reason.empty())
  {
    return entry;
  }
  try
  {
    EstimateOptions one = OptionsOf(options, burst);
    const FrameList list = OpenBurst(one);
    RequireOneIso(list);
    if (const PassportEntry * const same = StoredEntry(stored, entry, one, list))
    {
      PrintStep(options, entry, "the report in the passport is of these files; it is not measured again");
      entry.report = same->report;
      return entry;
    }
    PrintStep(options, entry, "is measured");
    const MeasuredStack measured = EstimateStack(one, list, nullptr);
    if (std::visit([](const auto & report) { return report.IsUsable(); }, measured))
    {
      entry.report = nlohmann::json::parse(ToJson(measured, {}, {}));
    }
    else
    {
      entry.reason = ReasonOf(measured);
    }
  }
  catch (const std::exception & error)
  {
    entry.reason = SentenceOf(error);
  }
  return entry;
}

void
WriteFile(const std::string & name, const std::string & text)
{
  PendingFile file(name);
  file.Write(text);
  file.Commit();
}

/** Registers all files. Throws std::runtime_error if an output is also an input. */
void
RequireOutputsApart(const EstimateOptions & options, const SweepPlan & plan)
{
  FilesInUse files;
  for (const SweepBurst & burst : plan.bursts)
  {
    for (const std::string & name : burst.files)
    {
      files.Read(name, "the frame");
    }
    for (const std::string & name : burst.dark)
    {
      files.Read(name, "the dark frame");
    }
  }
  if (options.HasReportFile())
  {
    files.Write(options.json, "--json");
  }
  if (!options.plot.empty())
  {
    files.Write(options.plot, "--plot");
  }
}

/** Returns the passport that --json names, if there is one. Throws std::exception if the file is something else. */
Passport
ReadStoredPassport(const EstimateOptions & options)
try
{
  std::error_code ignored;
  return options.HasReportFile() && std::filesystem::is_regular_file(options.json, ignored) ? ReadPassport(options.json)
                                                                                            : Passport();
}
catch (const std::exception & error)
{
  throw std::runtime_error(error.what() + std::string(". --json does not overwrite it: name another file"));
}

void
PrintResult(const EstimateOptions & options, const SweepSummary & summary, const std::string & json)
{
  if (!options.quiet)
  {
    std::cout << ForStandardOutput(MakeText(summary));
  }
  if (options.json == "-")
  {
    std::cout << json;
  }
  if (!std::cout.flush())
  {
    throw std::runtime_error(
      "cannot write the result to standard output: it is full or closed. Write a file: --json FILE");
  }
}

SweepOutcome
OutcomeOf(const Passport & passport)
{
  const auto measured = static_cast<std::size_t>(
    std::count_if(passport.entries.begin(), passport.entries.end(), [](const PassportEntry & entry) {
      return entry.reason.empty();
    }));
  return measured == 0                         ? SweepOutcome::None
         : measured == passport.entries.size() ? SweepOutcome::All
                                               : SweepOutcome::Some;
}
} // namespace

SweepOutcome
RunSweep(const EstimateOptions & options)
{
  if (options.HasReportFile())
  {
    RequireReportName(options.json, "--json");
  }
  const SweepPlan plan = FindBursts(options.sweep, options);
  RequireOutputsApart(options, plan);
  const Passport stored = ReadStoredPassport(options);
  // throws before the work begins if an output cannot be written
  std::optional<PendingFile> page;
  if (!options.plot.empty())
  {
    page.emplace(options.plot);
  }
  Passport     passport;
  SweepSummary summary;
  passport.kind = plan.kind;
  for (const SweepBurst & burst : plan.bursts)
  {
    passport.entries.push_back(MeasureBurst(options, burst, stored));
    summary = SummariseSweep(RangeOf(passport), UnmeasuredOf(passport));
    if (options.HasReportFile())
    {
      WriteFile(options.json, ToJson(passport, summary));
    }
  }
  if (page)
  {
    page->Write(ToHtml(summary));
    page->Commit();
  }
  PrintResult(options, summary, ToJson(passport, summary));
  return OutcomeOf(passport);
}

} // namespace sensornoise::tools
