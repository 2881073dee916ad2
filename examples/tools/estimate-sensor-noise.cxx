// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Measures the noise of a camera from files of a burst of raw frames. See --help and README.md.

#include "sensornoise/ReportText.h"
#include "sensornoise/Report.h"
#include "page/Comparison.h"
#include "tools/ErrorSentence.h"
#include "tools/CompanionFiles.h"
#include "tools/ComparedFiles.h"
#include "tools/EmvaRun.h"
#include "tools/EmvaList.h"
#include "tools/EstimateOptions.h"
#include "tools/FilesHash.h"
#include "tools/ExposureList.h"
#include "tools/FilesInUse.h"
#include "tools/MapFiles.h"
#include "tools/ModelCheck.h"
#include "tools/PendingFile.h"
#include "tools/ProfileFile.h"
#include "tools/StackEstimate.h"
#include "tools/SvgAsPng.h"
#include "tools/SweepRun.h"
#include "tools/TerminalText.h"
#include "tools/ItkThreads.h"
#include "itkSensorNoiseFrameFiles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace
{
using namespace sensornoise::tools;

constexpr int ExitDone = 0;
constexpr int ExitWrongUse = 2;
constexpr int ExitNothingEstimated = 3;
constexpr int ExitSomeSettings = 4;

/** Writes the report. A file is completed first, so that it exists even if standard output fails. The table follows,
 * then JSON on standard output. */
void
WriteReport(const MeasuredStack &        measured,
            const ModelChecks &          checks,
            const ModelChecks &          profileChecks,
            const EstimateOptions &      options,
            std::optional<PendingFile> & json)
{
  const std::string text = ToJson(measured, checks, profileChecks);
  const bool        isFile = json && json->Target().kind == OutputTarget::Kind::File;
  if (json)
  {
    json->Write(text);
  }
  if (isFile)
  {
    json->Commit();
  }
  if (!options.quiet)
  {
    std::cout << ForStandardOutput(MakeTable(measured, checks, profileChecks));
  }
  if (options.json == "-")
  {
    std::cout << text;
  }
  if (!std::cout.flush())
  {
    throw std::runtime_error(
      "cannot write the result to standard output: it is full or closed. Write a file: --json FILE");
  }
  if (json && !isFile)
  {
    json->Commit();
  }
}

/** Returns whether --frames counts the frames of stacks and not files. In a list of files, only the first selected file
 * is opened, or the first file if --frames ends beyond the list. */
bool
AreStacks(const EstimateOptions & options)
{
  if (!options.frames)
  {
    return false;
  }
  const auto isStack = [&options](std::size_t file) {
    return sensornoise::OpenFrames({ options.files[file] }, {}, options.raw, options.choice).isStack;
  };
  const std::size_t files = options.files.size();
  return isStack(std::min(options.frames->first, files - 1)) || (options.frames->second > files && isStack(0));
}

/** Throws if an output is also an input or another output. It must be called before anything is read, when the
 * folder of the maps exists. */
void
RequireOutputsApart(const EstimateOptions & options)
{
  FilesInUse files;
  const auto read = [&files](const std::vector<std::string> & names, const char * role) {
    for (const std::string & name : names)
    {
      files.Read(name, role);
    }
  };
  read(options.files, "the frame");
  read(options.dark, "the dark frame");
  read(options.check, "the frame to be checked");
  if (!options.checkProfile.empty())
  {
    files.Read(options.checkProfile, "the profile");
  }
  if (!options.mask.empty())
  {
    files.Read(options.mask, "the mask");
  }
  if (!options.exposuresText.empty() && !IsExposureList(options.exposuresText))
  {
    files.Read(options.exposuresText, "--exposures");
  }
  if (options.HasReportFile())
  {
    files.Write(options.json, "--json");
  }
  if (!options.plot.empty())
  {
    files.Write(options.plot, "--plot");
  }
  if (!options.maps.empty())
  {
    for (const std::string & map : MapFiles::NamesIn(options.maps, true))
    {
      files.Write(map, "--maps");
    }
  }
}

void
PrintWarnings(const MeasuredStack & measured)
{
  const auto * const channels = std::get_if<sensornoise::ChannelReports>(&measured);
  const auto warnings = channels != nullptr ? WarningsOf(*channels) : std::get<sensornoise::Report>(measured).warnings;
  for (const sensornoise::Warning & warning : warnings)
  {
    std::cerr << ForStandardError(sensornoise::TextOf(warning));
  }
}

/** Throws std::runtime_error if an option needs a library that this program was built without. */
void
RequireAbilities(const EstimateOptions & options)
{
  if (options.Plot() == PlotKind::Png)
  {
    RequirePng(options.plot);
  }
  if (options.hash && !HasHash())
  {
    throw std::runtime_error(
      "--hash: this program was built without OpenSSL, which computes the SHA-256; leave it out, "
      "or build with OpenSSL (Debian: libssl-dev)");
  }
}

std::string
DrawComparison(PlotKind kind, const sensornoise::Comparison & comparison)
{
  if (kind == PlotKind::Page)
  {
    return ToHtml(comparison);
  }
  const std::string svg = ToSvg(comparison);
  return kind == PlotKind::Png ? SvgAsPng(svg) : svg;
}

int
RunComparison(const EstimateOptions & options)
{
  RequireAbilities(options);
  std::optional<PendingFile> plot;
  if (!options.plot.empty())
  {
    plot.emplace(options.plot);
  }
  FilesInUse files;
  for (const std::string & report : options.compare)
  {
    files.Read(report, "the report");
  }
  if (plot)
  {
    files.Write(options.plot, "--plot");
  }
  const sensornoise::Comparison comparison = sensornoise::MakeComparison(ReadComparedReports(options.compare));
  if (plot)
  {
    plot->Write(DrawComparison(options.Plot(), comparison));
    plot->Commit();
  }
  if (!options.quiet && !(std::cout << ForStandardOutput(MakeText(comparison)) << std::flush))
  {
    throw std::runtime_error(
      "cannot write the result to standard output: it is full or closed. Write a file: --plot FILE");
  }
  const bool isUsable =
    std::any_of(comparison.rows.begin(), comparison.rows.end(), [](const auto & row) { return row.report.IsUsable(); });
  return isUsable ? ExitDone : ExitNothingEstimated;
}

int
MeasureSweep(const EstimateOptions & options)
{
  SetItkThreads(options.threads);
  const SweepOutcome outcome = RunSweep(options);
  return outcome == SweepOutcome::All    ? ExitDone
         : outcome == SweepOutcome::Some ? ExitSomeSettings
                                         : ExitNothingEstimated;
}

bool
HasAny(const ModelChecks & checks)
{
  return checks.empty() ||
         std::any_of(checks.begin(), checks.end(), [](const auto & check) { return check.has_value(); });
}

int
Run(EstimateOptions & options)
{
  SetItkThreads(options.threads);
  if (options.method == "emva1288")
  {
    return RunEmva1288(options) ? ExitDone : ExitNothingEstimated;
  }
  if (options.raw.empty() && IsEmvaList(options.files.front()))
  {
    throw std::invalid_argument(options.files.front() +
                                " is text, and no image; if it is a list of exposures, add --method emva1288");
  }
  RequireAbilities(options);
  std::optional<sensornoise::NoiseProfile> profile;
  if (!options.checkProfile.empty())
  {
    profile = ReadProfileFile(options.checkProfile);
  }
  WarnOfSharedDarkFrames(options.dark, options.files);
  // throws before the work begins if an output cannot be written
  std::optional<PendingFile> json;
  if (options.HasReportFile())
  {
    RequireReportName(options.json, "--json");
    json.emplace(options.json);
  }
  std::optional<PendingFile> plot;
  if (!options.plot.empty())
  {
    plot.emplace(options.plot);
  }
  std::optional<MapFiles> maps;
  if (!options.maps.empty())
  {
    maps.emplace(options.maps, !options.dark.empty());
  }
  RequireOutputsApart(options);
  const std::size_t listed = options.files.size();
  options.SelectFiles(listed == 1 || AreStacks(options));
  const sensornoise::FrameList frames = sensornoise::OpenFrames(options.files, {}, options.raw, options.choice);
  options.SelectExposures(listed == 1 || frames.isStack ? frames.frames : listed);
  PrintWarningOf(frames);
  std::optional<sensornoise::FrameList> others; // frames of --check
  if (!options.check.empty())
  {
    others = OpenFramesToCheck(options);
  }

  std::string         plotText;
  const MeasuredStack measured = EstimateStack(options, frames, maps ? &*maps : nullptr, plot ? &plotText : nullptr);
  const ModelChecks   checks =
    options.hasCheck ? CheckModel(options, measured, others ? *others : frames) : ModelChecks();
  const ModelChecks profileChecks = profile ? CheckProfile(*profile, measured, options.profileLevels) : ModelChecks();
  if (plot)
  {
    plot->Write(plotText);
    plot->Commit();
  }
  WriteReport(measured, checks, profileChecks, options, json);
  PrintWarnings(measured);
  const bool isUsable = std::visit([](const auto & reports) { return reports.IsUsable(); }, measured);
  return isUsable && HasAny(checks) && HasAny(profileChecks) ? ExitDone : ExitNothingEstimated;
}
} // namespace

int
main(int argc, char * argv[])
{
  try
  {
    EstimateOptions options;
    if (const auto finished = options.Parse(argc, argv))
    {
      return *finished;
    }
    return !options.sweep.empty()    ? MeasureSweep(options)
           : options.compare.empty() ? Run(options)
                                     : RunComparison(options);
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << ForStandardError(SentenceOf(error)) << '\n';
  }
  return ExitWrongUse;
}
