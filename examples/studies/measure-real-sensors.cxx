// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Simulates sensors that depart from the model as real ones do, estimates each stack with the refined method, and
// prints whether errors and intervals keep what they promise. See --help and --list.

#include "studies/RealSensorLines.h"
#include "studies/RealSensorRun.h"
#include "studies/RealSensorSummary.h"
#include "studies/RealSensorTable.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <iterator>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{
using namespace sensornoise;
using tools::RealSensorGroup;
using tools::RealSensorLine;
using tools::RealSensorSetting;

struct Options
{
  std::vector<std::string>   lines{ "all" };
  std::string                reference{ "both" };
  std::uint64_t              seeds{ 10 };
  std::uint64_t              firstSeed{ 1 };
  std::size_t                size{ 256 };
  std::optional<std::size_t> frames;
  unsigned int               threads{ std::max(1U, std::thread::hardware_concurrency()) };
  bool                       isList{ false };
  bool                       isVerbose{ false };
};

std::vector<RealSensorLine>
ChooseLines(const Options & options)
{
  const std::vector<RealSensorLine> known = tools::GetRealSensorLines();
  std::vector<RealSensorLine>       chosen;
  for (const std::string & name : options.lines)
  {
    const auto isNamed = [&](const RealSensorLine & line) { return name == "all" || line.name == name; };
    if (std::none_of(known.begin(), known.end(), isNamed))
    {
      throw std::invalid_argument("the line \"" + name + "\" is not known; --list names them all");
    }
    std::copy_if(known.begin(), known.end(), std::back_inserter(chosen), isNamed);
  }
  return chosen;
}

/** The settings of a line that the command line asks for. A number of frames for all makes settings that differ by it
 * alike: one of them stays. */
std::vector<RealSensorGroup>
PlanGroups(const RealSensorLine & line, const Options & options)
{
  std::vector<RealSensorGroup> groups;
  for (RealSensorSetting setting : line.makeSettings())
  {
    setting.settings.frames = options.frames.value_or(setting.settings.frames);
    const std::string scene = NameOf(setting.scene);
    const bool        isChosen = options.reference == "both" || scene == options.reference || scene == "flat";
    const bool        isKnown = std::any_of(groups.begin(), groups.end(), [&](const RealSensorGroup & group) {
      return group.setting.name == setting.name && group.setting.scene == setting.scene &&
             group.setting.settings.frames == setting.settings.frames;
    });
    if (isChosen && !isKnown)
    {
      groups.push_back({ setting, std::vector<tools::RealSensorOutcome>(options.seeds) });
    }
  }
  return groups;
}

/** Measures all stacks of a line, some at a time, and prints each setting when all of its stacks are done, in order. */
void
MeasureGroups(std::vector<RealSensorGroup> & groups, const Options & options)
{
  const std::size_t        seeds = options.seeds;
  std::atomic<std::size_t> next{ 0 };
  std::mutex               mutex;
  std::vector<std::size_t> missing(groups.size(), seeds);
  std::size_t              printed = 0;
  std::string              failure;
  const auto               work = [&] {
    for (std::size_t k = next++; k < groups.size() * seeds; k = next++)
    {
      RealSensorGroup & group = groups[k / seeds];
      try
      {
        group.outcomes[k % seeds] =
          tools::MeasureRealSensor(group.setting, options.size, options.firstSeed + k % seeds);
      }
      catch (const std::exception & error)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        failure = group.setting.name + ": " + error.what();
        next = groups.size() * seeds;
        return;
      }
      const std::lock_guard<std::mutex> lock(mutex);
      --missing[k / seeds];
      for (; printed < groups.size() && missing[printed] == 0; ++printed)
      {
        tools::PrintGroup(groups[printed]);
        if (options.isVerbose)
        {
          tools::PrintStacks(groups[printed]);
        }
      }
    }
  };
  std::vector<std::thread> workers;
  for (unsigned int i = 0; i < options.threads; ++i)
  {
    workers.emplace_back(work);
  }
  for (std::thread & worker : workers)
  {
    worker.join();
  }
  if (!failure.empty())
  {
    throw std::runtime_error(failure);
  }
}

void
PrintPlan(const RealSensorLine & line, const std::vector<RealSensorGroup> & groups, bool isVerbose)
{
  std::printf("%-15s %4zu settings: %s\n", line.name.c_str(), groups.size(), line.what.c_str());
  for (std::size_t k = 0; k < groups.size() && isVerbose; ++k)
  {
    const RealSensorSetting & setting = groups[k].setting;
    std::printf("  %-7s %4zu frames  %s\n", NameOf(setting.scene), setting.settings.frames, setting.name.c_str());
  }
}

void
AddOptions(CLI::App & app, Options & options)
{
  app.add_option("--line", options.lines, "for example bends,flats-dark, or all")
    ->delimiter(',')
    ->capture_default_str();
  app.add_option("--reference", options.reference, "the scene, where it is no flat field")
    ->check(CLI::IsMember({ "target", "texture", "both" }))
    ->capture_default_str();
  app.add_option("--seeds", options.seeds, "stacks of each setting")
    ->check(CLI::Range(1, 10000))
    ->capture_default_str();
  app.add_option("--seed", options.firstSeed, "the first one")->capture_default_str();
  app.add_option("--size", options.size, "width and height [pixels]")
    ->check(CLI::Range(64, 4096))
    ->capture_default_str();
  app.add_option("--frames", options.frames, "instead of the settings'")->check(CLI::Range(5, 10000));
  app.add_option("--threads", options.threads, "stacks at a time")->check(CLI::Range(1, 1024));
  app.add_flag("--list", options.isList, "the lines, with --verbose their settings, and nothing else");
  app.add_flag("--verbose", options.isVerbose, "a row for each stack, too");
}

void
Measure(const Options & options)
{
  for (const RealSensorLine & line : ChooseLines(options))
  {
    std::vector<RealSensorGroup> groups = PlanGroups(line, options);
    if (options.isList)
    {
      PrintPlan(line, groups, options.isVerbose);
      continue;
    }
    tools::PrintLineHeader(line);
    MeasureGroups(groups, options);
    tools::PrintLineSummary(line, groups);
  }
}
} // namespace

int
main(int argc, char * argv[])
{
  Options  options;
  CLI::App app(
    "Simulates sensors that depart from the model as real ones do, and judges the refined method's report. A row is a\n"
    "setting: n stacks; refused (ref.: the gain is failed); 95 % intervals that hold the truth, of what is called\n"
    "identified, for gain g, offset mu, flicker fl and read noise rn; error over standard error z; mean standard "
    "error\n"
    "and mean error of the gain [%]; p: probability of so few intervals or fewer that hold the gain, if each does "
    "with\n"
    "95 % (lower tail of the binomial distribution); limits above the flicker where it cannot be told from 0; "
    "brackets\n"
    "that hold the offset, and identified offsets in their own bracket; warnings with the number of stacks. Last, all\n"
    "settings of the line together, and what they have to show. About 1 s a stack of 256 x 256 pixels and 50 frames.");
  AddOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  try
  {
    Measure(options);
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
