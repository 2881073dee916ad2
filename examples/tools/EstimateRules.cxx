// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/EstimateRules.h"

#include "tools/LowerCase.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <set>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
/** Throws std::invalid_argument for a command line without frames. It explains that --dark and --check take all
 * names that follow. */
[[noreturn]] void
RefuseMissingFrames(const EstimateOptions & options)
{
  const std::string tool = "estimate-sensor-noise ";
  if (LowerCaseEnding(options.json) != ".json" && std::filesystem::exists(options.json))
  {
    throw std::invalid_argument("no FRAME is left: --json takes the name behind it, " + options.json +
                                ", for the report. Name the report, too: " + tool + options.json +
                                " --json report.json");
  }
  if (options.dark.empty() && options.check.empty())
  {
    throw std::invalid_argument("no FRAME was given; expected image files, a folder or a stack: " + tool +
                                "FRAMES [OPTIONS] (--help explains the options)");
  }
  const bool        isDark = !options.dark.empty();
  const std::string option = isDark ? "--dark" : "--check";
  const std::string files = isDark ? "DARKS" : "OTHERS";
  const std::size_t names = isDark ? options.dark.size() : options.check.size();
  throw std::invalid_argument("no FRAME is left: " + option + " takes all names behind it, here " +
                              std::to_string(names) + ". Write the frames first: " + tool + "FRAMES " + option + " " +
                              files + ". Or end the list with --: " + tool + option + " " + files + " -- FRAMES");
}

/** Throws if an option is given that a sweep has no use for. */
void
RequireSweepOptions(const CLI::App & app, const EstimateOptions & options)
{
  for (const char * const name : { "--exposures", "--check", "--check-profile", "--compare", "--maps", "--dark" })
  {
    if (app.count(name) > 0)
    {
      throw CLI::ValidationError(
        "--sweep",
        std::string("it measures many bursts, and ") + name +
          (std::string(name) == "--dark"
             ? " gives the dark frames of one setting. Put the dark frames of each setting into the "
               "folder dark of its folder, or into the column dark of a table"
             : " is for one of them. Leave it out, or measure the burst by itself"));
    }
  }
  if (!options.files.empty())
  {
    throw CLI::ValidationError("--sweep", "it takes the place of FRAME; leave out " + options.files.front());
  }
  if (options.method != "refined")
  {
    throw CLI::ValidationError("--sweep", "the method is " + options.method + "; expected --method refined");
  }
  if (!options.plot.empty() && options.Plot() != PlotKind::Page)
  {
    throw CLI::ValidationError("--sweep", options.plot + " (--plot) is no page; expected for example sweep.html");
  }
}

} // namespace

std::string
NumericOptions(const CLI::App & app)
{
  const std::set<std::string> others{ "--sweep", "--json",    "--plot",         "--quiet",
                                      "--hash",  "--threads", "--memory-limit", "FRAME" };
  std::string                 text;
  for (const CLI::Option * const option : app.get_options())
  {
    if (option->count() > 0 && others.count(option->get_name()) == 0)
    {
      text += (text.empty() ? "" : " ") + option->get_name();
      for (const std::string & value : option->results())
      {
        text += " " + value;
      }
    }
  }
  return text;
}

void
RequireWork(const CLI::App & app, const EstimateOptions & options)
{
  if (!options.sweep.empty())
  {
    RequireSweepOptions(app, options);
    return;
  }
  if (app.count("--compare") == 0)
  {
    if (options.files.empty())
    {
      RefuseMissingFrames(options);
    }
    return;
  }
  const std::set<std::string> forBoth{ "--compare", "--plot", "--quiet", "--help" };
  for (const CLI::Option * const option : app.get_options())
  {
    if (option->count() > 0 && forBoth.count(option->get_name()) == 0)
    {
      throw CLI::ValidationError("--compare",
                                 "it reads stored reports and measures nothing; leave out " + option->get_name() +
                                   ", or leave out --compare");
    }
  }
  if (options.compare.size() < 2)
  {
    throw CLI::ValidationError("--compare", "there is one report; expected two or more to be compared");
  }
}

void
RequireOptionsOfEmva(const CLI::App & app, const EstimateOptions & options)
{
  if (options.method != "emva1288")
  {
    if (!options.xml.empty())
    {
      throw CLI::ValidationError(
        "--xml", "the method " + options.method + " writes no XML; leave it out, or set --method emva1288");
    }
    return;
  }
  const std::set<std::string> known{ "FRAME",   "--method",  "--exposures", "--dark", "--json", "--xml",
                                     "--plot",  "--quiet",   "--raw",       "--step", "--roi",  "--channel",
                                     "--plane", "--threads", "--bit-depth", "--bayer" };
  for (const CLI::Option * const option : app.get_options())
  {
    if (option->count() > 0 && known.count(option->get_name()) == 0)
    {
      throw CLI::ValidationError("--method",
                                 "the method emva1288 does not use " + option->get_name() +
                                   "; leave it out. A part of the frame is selected by --roi");
    }
  }
}

} // namespace sensornoise::tools
