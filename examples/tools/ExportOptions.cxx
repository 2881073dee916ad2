// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ExportOptions.h"

#include "sensornoise/Version.h"
#include "tools/HelpText.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstddef>
#include <iostream>
#include <memory>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
/** Returns the table of the formats, with one line per format. */
std::string
ListOfFormats()
{
  std::size_t widest = 0;
  for (const ExportFormat & format : ExportFormats())
  {
    widest = std::max(widest, std::string(format.name).size());
  }
  std::string list;
  for (const ExportFormat & format : ExportFormats())
  {
    const std::string name = format.name;
    list += name + std::string(widest + 2 - name.size(), ' ') + format.consumer + "; " + NameOf(format.takes) + ", " +
            NameOf(format.exactness) + ": " + format.fields + '\n';
  }
  return list;
}

/** Throws unless the options that were given are for the format. */
void
RequireUsed(const CLI::App & app, const std::string & format)
{
  const std::array<std::array<const char *, 2>, 3> uses{
    { { "--analogue-gain", "libcamera" }, { "--max-analogue-iso", "android" }, { "--maps", "maps" } }
  };
  for (const auto & [option, user] : uses)
  {
    if (app.count(option) > 0 && format != user)
    {
      throw std::runtime_error(std::string(option) + " is for --format " + user + ", and the format is " + format +
                               "; leave the option out");
    }
  }
}

void
RequireFitting(const ExportOptions & options)
{
  if (options.reports.empty() || options.format.empty())
  {
    throw std::runtime_error("expected REPORT and --format NAME; --list shows the formats");
  }
  if (!options.into.empty() && (options.format != "dng" || options.output.empty()))
  {
    throw std::runtime_error("--into writes a copy of a DNG file: expected --format dng and --output COPY.dng");
  }
}
} // namespace

std::optional<int>
ExportOptions::Parse(int argc, char ** argv)
{
  CLI::App app(
    "Writes the noise model of a report of estimate-sensor-noise for a program that asks for one.\n"
    "REPORT is the JSON file of --json. Some formats take several, one for each ISO setting. The passport of "
    "--sweep holds them all.\n"
    "Exit code: 0 done, 2 wrong use or unreadable input, 3 the report cannot serve.",
    "export-noise-model");
  app.formatter(std::make_shared<HelpFormatter>(TerminalWidth()));
  bool isList = false;
  app.add_option("REPORT", reports, "JSON file of the camera at this setting");
  app.add_option("--format", format, "name of the format");
  app.add_option("--setting",
                 setting,
                 "ISO speed or gain of a passport, for a format of one setting; between measured settings the noise is "
                 "interpolated");
  app.add_flag("--list", isList, "show the formats, with program, input, exactness and what is written");
  app.add_option("--output", output, "file, or folder for a format of several files; else standard output");
  app.add_option("--black", settings.blackLevelDn, "black level [DN]; else the level in the report");
  app.add_option("--white", settings.whiteLevelDn, "white level [DN]; else the level in the report");
  app.add_option("--channel", settings.channel, "the only channel of a mosaic to be written: R, G1, G2 or B");
  app.add_option("--analogue-gain", settings.analogueGain, "analogue gain of the burst, for libcamera")
    ->capture_default_str();
  app.add_option(
    "--max-analogue-iso", settings.maxAnalogueIso, "ISO speed above which the gain is digital, for android");
  app.add_option("--maps", maps, "folder of maps that estimate-sensor-noise --dark --maps wrote, for maps");
  app.add_option(
    "--into", into, "DNG file: --output becomes its copy with the tag NoiseProfile, by the levels of the file");
  app.set_version_flag("--version", std::string("export-noise-model ") + GetModuleVersion());
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::Success & request)
  {
    return app.exit(request); // --help or --version
  }
  if (isList)
  {
    std::cout << ListOfFormats();
    return 0;
  }
  RequireFitting(*this);
  RequireUsed(app, format);
  return std::nullopt;
}

} // namespace sensornoise::tools
