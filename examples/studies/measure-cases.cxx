// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Simulates the stacks of named cases, measures each, and prints its truth and its report as a line of JSON. The tables
// are made of them by examples/python/study_tables.py. See --help.

#include "studies/OrderedWork.h"
#include "studies/StudyCase.h"
#ifdef SENSORNOISE_VARY_CONSTANTS
#  include "studies/InfluenceConstants.h"
#endif

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{
using namespace sensornoise;
using tools::StudyCase;
using tools::StudyOptions;

struct Options
{
  std::vector<std::string> patterns;
  std::vector<std::string> constants;
  StudyOptions             study;
  std::uint64_t            seeds{ 1 };
  std::uint64_t            firstSeed{ 1 };
  unsigned int             threads{ std::max(1U, std::thread::hardware_concurrency()) };
  bool                     list{ false };
  bool                     listConstants{ false };
};

/** Returns whether a name fits a pattern, in which each * stands for any number of any characters. */
bool
Matches(const std::string & pattern, const std::string & name)
{
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos)
  {
    return pattern == name;
  }
  if (name.compare(0, star, pattern, 0, star) != 0)
  {
    return false;
  }
  const std::string rest = pattern.substr(star + 1);
  for (std::size_t k = star; k <= name.size(); ++k)
  {
    if (Matches(rest, name.substr(k)))
    {
      return true;
    }
  }
  return false;
}

std::vector<StudyCase>
ChooseCases(const std::vector<std::string> & patterns)
{
  const std::vector<StudyCase> all = tools::GetStudyCases();
  std::vector<StudyCase>       chosen;
  for (const std::string & pattern : patterns)
  {
    const std::size_t before = chosen.size();
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [&](const StudyCase & one) {
      return Matches(pattern, one.name);
    });
    if (chosen.size() == before)
    {
      throw std::invalid_argument("no case has the name \"" + pattern + "\"; --list prints all names");
    }
  }
  return chosen;
}

void
Measure(const Options & options)
{
  const std::vector<StudyCase> cases = ChooseCases(options.patterns);
  const auto                   seeds = static_cast<std::size_t>(options.seeds);
  const auto                   measure = [&](std::size_t k) {
    const StudyCase &   one = cases[k / seeds];
    const std::uint64_t seed = options.firstSeed + k % seeds;
    std::string         lines;
    for (nlohmann::ordered_json & record : one.measure(options.study, seed))
    {
      nlohmann::ordered_json line{ { "case", one.name }, { "seed", seed } };
      line.update(record);
      lines += line.dump() + '\n';
    }
    return lines;
  };
  tools::MakeInOrder(cases.size() * seeds, options.threads, measure, [](const std::string & lines) {
    std::cout << lines << std::flush;
    if (!std::cout)
    {
      throw std::runtime_error("cannot write to standard output; expected a file or a pipe that takes all lines");
    }
  });
}

void
ListCases(const std::vector<std::string> & patterns)
{
  for (const StudyCase & one : patterns.empty() ? tools::GetStudyCases() : ChooseCases(patterns))
  {
    std::printf("%-60s %s\n", one.name.c_str(), one.what.c_str());
  }
}

void
AddOptions(CLI::App & app, Options & options)
{
  StudyOptions & study = options.study;
  app.add_option("CASE", options.patterns, "names, or patterns such as 'sensors/gamma/*'");
  app.add_option("--seeds", options.seeds, "stacks of each case")->check(CLI::Range(1, 10000))->capture_default_str();
  app.add_option("--first-seed", options.firstSeed, "seed of the first stack")->capture_default_str();
  app.add_option("--threads", options.threads, "stacks at a time")->check(CLI::Range(1, 1024));
  app.add_flag("--list", options.list, "print the names of the cases, and measure nothing");
  app.add_option("--size", study.size, "width and height of the frames, instead of the case's [pixels]")
    ->check(CLI::Range(32, 4096));
  app.add_option("--frames", study.frames, "frames of a stack, instead of the case's")->check(CLI::Range(5, 10000));
  app.add_option("--method", study.method, "of efficiency/* and robustness/*")
    ->check(CLI::IsMember({ "refined", "published" }))
    ->capture_default_str();
  const std::string group = "Options of efficiency/*, instead of camera and condition";
  app.add_option("--scene-seed", study.sceneSeed, "another target or texture")->group(group);
  app.add_option("--flicker-sd", study.flickerSd, "[1]")->group(group);
  app.add_option("--vibration-sd", study.vibrationSd, "X,Y [pixels]")->delimiter(',')->expected(2)->group(group);
  app.add_option("--gain", study.gain, "[DN/e-]")->group(group);
  app.add_option("--offset", study.offset, "[DN]")->group(group);
  app.add_option("--read-noise", study.readNoise, "[DN]")->group(group);
  app.add_option("--electrons", study.electrons, "of the brightest pixel [e-]")->group(group);
  app.add_option("--clip", study.clip, "LOW,HIGH: levels that the sensor attains [DN]")
    ->delimiter(',')
    ->expected(2)
    ->group(group);
  auto * shutter = app.add_option("--rolling-shutter", study.rollingShutterPeriod, "period of the bands [rows]");
  auto * mosaic = app.add_option("--bayer", study.bayer, "measure each plane of a mosaic of this pattern")
                    ->check(CLI::IsMember({ "none", "RGGB", "GRBG", "GBRG", "BGGR" }));
  app
    .add_flag(
      "--full-bound", study.isFullBound, "compute the Cramer-Rao bound: 4 s a stack; else closed forms, 3 % off")
    ->excludes(shutter)
    ->excludes(mosaic)
    ->group(group);
  shutter->group(group);
  mosaic->group(group);
#ifdef SENSORNOISE_VARY_CONSTANTS
  app.add_option("--constant", options.constants, "NAME=FACTOR: multiply a constant of the refined method");
  app.add_flag("--list-constants", options.listConstants, "print the constants, and measure nothing");
#endif
}
} // namespace

int
main(int argc, char * argv[])
{
  Options  options;
  CLI::App app(
    "Simulates the stacks of named cases and measures each. Prints a line of JSON for each report: case, seed,\n"
    "truth, report, and what the tables of its study need. examples/python/study_tables.py makes the tables.\n"
    "The same case, seed and options give the same line. About a second a stack of 256 x 256 x 50.");
  AddOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  try
  {
#ifdef SENSORNOISE_VARY_CONSTANTS
    if (options.listConstants)
    {
      tools::PrintVariedConstants();
      return 0;
    }
    tools::MultiplyConstants(options.constants);
#endif
    if (options.list)
    {
      ListCases(options.patterns);
      return 0;
    }
    if (options.patterns.empty())
    {
      throw std::invalid_argument("no CASE was given; --list prints all names");
    }
    Measure(options);
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
