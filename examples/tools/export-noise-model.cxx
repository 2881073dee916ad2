// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Writes the noise model of a report of estimate-sensor-noise in the format of another program:
//   export-noise-model report.json --format dng --output noise_profile.txt

#include "sweep/Setting.h"
#include "tools/ErrorSentence.h"
#include "tools/ExportOptions.h"
#include "tools/FilesInUse.h"
#include "tools/PassportFile.h"
#include "tools/PendingFile.h"
#include "tools/ReportFile.h"
#include "tools/StoredReportFile.h"
#include "tools/TerminalText.h"

#include <algorithm>
#include <deque>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using namespace sensornoise::tools;
using sensornoise::CameraNoise;
using sensornoise::ExportedFile;
using sensornoise::NoiseExport;

constexpr int ExitDone = 0;
constexpr int ExitWrongUse = 2;
constexpr int ExitUnfitReport = 3;

std::string
ReadBytes(const std::string & file)
{
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file))
  {
    throw std::runtime_error("the DNG file " + file + " cannot be read (--into); expected a file");
  }
  return { std::istreambuf_iterator<char>(stream), {} };
}

/** Returns the settings that are exported: one of each report, or the settings of a passport. */
std::vector<CameraNoise>
ReadSettings(const ExportOptions & options, std::string & note)
{
  const bool isPassport = options.reports.size() == 1 && IsPassport(ReadJsonFile(options.reports.front()));
  if (isPassport)
  {
    const auto range = RangeOf(ReadPassport(options.reports.front()), options.settings);
    return sensornoise::ChooseSettings(range, options.format, options.setting, options.reports.front(), note);
  }
  if (options.setting)
  {
    throw std::runtime_error("--setting chooses a setting of a passport; expected the file that estimate-sensor-noise "
                             "--sweep --json wrote, alone");
  }
  std::vector<CameraNoise> settings;
  for (const std::string & report : options.reports)
  {
    settings.push_back(sensornoise::ReadCameraNoise(ReadStoredReport(report), options.settings));
  }
  return settings;
}

/** Calls \a work, on the bytes of the DNG file of --into. Throws std::runtime_error with its name if they are none. */
template <typename TWork>
auto
OnDng(const std::string & file, TWork work)
{
  try
  {
    return work();
  }
  catch (const sensornoise::ExportError & error)
  {
    throw std::runtime_error(file + " (--into): " + error.what());
  }
}

NoiseExport
MakeExport(ExportOptions options)
{
  std::string dng;
  if (!options.into.empty())
  {
    dng = ReadBytes(options.into);
    OnDng(options.into, [&] { sensornoise::SetLevelsOfDng(dng, options.settings); });
  }
  std::string              note;
  std::vector<CameraNoise> settings = ReadSettings(options, note);
  if (!options.maps.empty())
  {
    settings.front().maps = ReadNoiseMaps(options.maps);
  }
  NoiseExport made = sensornoise::ExportNoise(options.format, settings);
  made.note += (made.note.empty() || note.empty() ? "" : " ") + note;
  if (!options.into.empty())
  {
    const auto profile = sensornoise::NoiseProfileOf(settings.front());
    made.files = { { options.output,
                     OnDng(options.into, [&] { return sensornoise::WithNoiseProfile(dng, profile); }) } };
  }
  return made;
}

/** Returns the names of the files to be written: \a output, or several files in the folder \a output. */
std::vector<std::string>
NamesOf(const NoiseExport & made, const std::string & output)
{
  std::vector<std::string> names;
  for (const ExportedFile & file : made.files)
  {
    names.push_back(made.files.size() == 1 ? output : (fs::path(output) / file.name).string());
  }
  if (names.size() > 1 && !fs::is_directory(output))
  {
    throw std::runtime_error("--output is " + (output.empty() ? "not given" : output) +
                             "; this format writes several files, and expects the name of a folder that exists");
  }
  return names;
}

void
WriteFiles(const ExportOptions & options, const NoiseExport & made)
{
  const std::vector<std::string> names = NamesOf(made, options.output);
  FilesInUse                     files;
  for (const std::string & report : options.reports)
  {
    files.Read(report, "the report");
  }
  if (!options.into.empty())
  {
    files.Read(options.into, "the DNG file");
  }
  std::deque<PendingFile> pending;
  for (const std::string & name : names)
  {
    files.Write(name, "--output");
    pending.emplace_back(name);
    pending.back().Write(made.files[pending.size() - 1].bytes);
  }
  for (PendingFile & file : pending)
  {
    file.Commit();
  }
}

void
Run(const ExportOptions & options)
{
  const NoiseExport made = MakeExport(options);
  if (!options.output.empty() || made.files.size() > 1)
  {
    WriteFiles(options, made);
  }
  else
  {
    const auto & formats = sensornoise::ExportFormats();
    const bool   isText = std::all_of(formats.begin(), formats.end(), [&](const auto & format) {
      return format.isText || options.format != format.name;
    });
    if (!isText)
    {
      throw std::runtime_error(options.format + " is no text; expected the name of a file (--output)");
    }
    std::cout << made.files.front().bytes;
  }
  if (!made.note.empty())
  {
    std::cerr << "note: " << ForStandardError(made.note) << '\n';
  }
}
} // namespace

int
main(int argc, char * argv[])
{
  try
  {
    ExportOptions options;
    if (const auto finished = options.Parse(argc, argv))
    {
      return *finished;
    }
    Run(options);
    return ExitDone;
  }
  catch (const UnfitReport & error)
  {
    std::cerr << "error: " << ForStandardError(SentenceOf(error)) << '\n';
    return ExitUnfitReport;
  }
  catch (const sensornoise::ExportError & error)
  {
    std::cerr << "error: " << ForStandardError(SentenceOf(error)) << '\n';
    return dynamic_cast<const sensornoise::ExportUseError *>(&error) != nullptr ? ExitWrongUse : ExitUnfitReport;
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << ForStandardError(SentenceOf(error)) << '\n';
  }
  return ExitWrongUse;
}
