// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Simulates bursts with what goes wrong in real life, estimates each and prints the errors, the errors in units of the
// reported standard errors, and a verdict. See --help and --list.

#include "sensornoise/PublishedMethod.h"
#include "sensornoise/RefinedMethod.h"
#include "studies/RobustnessEstimate.h"
#include "studies/RobustnessRun.h"
#include "studies/RobustnessTable.h"
#include "studies/StressStacks.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{
using namespace sensornoise;
using tools::Run;
using tools::StressCase;
using tools::StressStack;

struct Options
{
  std::vector<std::string> cases{ "all" };
  std::string              reference{ "both" };
  std::string              method{ "refined" };
  std::uint64_t            seeds{ 1 };
  std::uint64_t            firstSeed{ 1 };
  std::size_t              size{ 512 };
  unsigned int             threads{ std::max(1U, std::thread::hardware_concurrency()) };
  bool                     list{ false };
};

void
Execute(Run & run, const Options & options)
{
  const StressStack stack = tools::MakeStressStack(run.stressCase.name, run.reference, options.size, run.seed);
  tools::FileEstimation(run,
                        stack,
                        options.method == "published" ? tools::EstimateStack<PublishedMethod>(stack)
                                                      : tools::EstimateStack<RefinedMethod>(stack));
}

/** Simulates and estimates all runs, some at a time, and prints them in order. */
void
ExecuteAll(std::vector<Run> & runs, const Options & options)
{
  std::atomic<std::size_t> next{ 0 };
  std::mutex               mutex;
  std::vector<char>        isDone(runs.size(), 0);
  std::size_t              printed = 0;
  std::string              failure;
  const auto               work = [&] {
    for (std::size_t k = next++; k < runs.size(); k = next++)
    {
      try
      {
        Execute(runs[k], options);
      }
      catch (const std::exception & error)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        failure = runs[k].stressCase.name + ": " + error.what();
        next = runs.size();
        return;
      }
      const std::lock_guard<std::mutex> lock(mutex);
      isDone[k] = 1;
      for (; printed < runs.size() && isDone[printed] != 0; ++printed)
      {
        tools::PrintRun(runs[printed]);
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

std::vector<Run>
PlanRuns(const Options & options)
{
  const std::vector<StressCase> known = tools::GetStressCases();
  std::vector<StressCase>       chosen;
  for (const std::string & name : options.cases)
  {
    const auto isNamed = [&](const StressCase & other) { return name == "all" || other.name == name; };
    if (std::none_of(known.begin(), known.end(), isNamed))
    {
      throw std::invalid_argument("the case \"" + name + "\" is not known; --list names them all");
    }
    std::copy_if(known.begin(), known.end(), std::back_inserter(chosen), isNamed);
  }
  std::vector<Run> runs;
  for (const StressCase & stressCase : chosen)
  {
    for (const char * reference : { "target", "texture" })
    {
      for (std::uint64_t k = 0; k < options.seeds && (options.reference == "both" || options.reference == reference);
           ++k)
      {
        runs.push_back({ stressCase, reference, options.firstSeed + k, {}, {}, {}, {}, {} });
      }
    }
  }
  return runs;
}

void
Measure(const Options & options)
{
  std::vector<Run> runs = PlanRuns(options);
  tools::PrintRunHeader(options.method, options.size);
  ExecuteAll(runs, options);
  tools::PrintSummary(runs);
}
} // namespace

int
main(int argc, char * argv[])
{
  Options  options;
  CLI::App app("Estimates simulated bursts with what goes wrong in real life: errors of gain g, intercept\n"
               "c = sigma^2 - g mu and offset mu, and their ratio z to the reported standard errors.\n"
               "Unless a case says otherwise: camera B, condition 3, 100 frames. About 3 s a run and thread.");
  app.add_option("--cases", options.cases, "for example rolling200,two_lamps, or all")
    ->delimiter(',')
    ->capture_default_str();
  app.add_option("--reference", options.reference)
    ->check(CLI::IsMember({ "target", "texture", "both" }))
    ->capture_default_str();
  app.add_option("--method", options.method)->check(CLI::IsMember({ "published", "refined" }))->capture_default_str();
  app.add_option("--seeds", options.seeds, "runs of each case")->check(CLI::Range(1, 10000))->capture_default_str();
  app.add_option("--first-seed", options.firstSeed)->capture_default_str();
  app.add_option("--size", options.size, "width and height [pixels]")
    ->check(CLI::Range(64, 4096))
    ->capture_default_str();
  app.add_option("--threads", options.threads, "runs at a time")->check(CLI::Range(1, 1024));
  app.add_flag("--list", options.list, "the cases, and nothing else");
  CLI11_PARSE(app, argc, argv);
  try
  {
    if (options.list)
    {
      for (const StressCase & stressCase : tools::GetStressCases())
      {
        std::printf("%-20s %s\n", stressCase.name.c_str(), stressCase.what.c_str());
      }
      return 0;
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
