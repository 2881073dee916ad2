// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// How often the check of a noise model is right: a report is held against another burst of the same camera, as it is,
// and with a slope that is 5 % too steep. The first should fit, the second should not. See --help.

#include "sensornoise/RefinedMethod.h"
#include "sensornoise/Report.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/NoiseModel.h"
#include "studies/RenderedStack.h"
#include "studies/RobustnessEstimate.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

namespace
{
using namespace sensornoise;

constexpr double        WrongSlope = 1.05;
constexpr std::uint64_t OtherBurst = 500; ///< what is added to the seed of a report's burst

struct CheckOptions
{
  unsigned int seeds{ 8 };
  std::size_t  size{ 256 };
  std::size_t  frames{ 60 };
  unsigned int threads{ std::max(1U, std::thread::hardware_concurrency()) };
};

/** Bursts of a camera in one light, and what became of them. */
struct Experiment
{
  char         camera;
  int          condition;
  std::string  scene;
  unsigned int reports{ 0 }; ///< that have a model
  unsigned int fits{ 0 };
  unsigned int seen{ 0 };     ///< reports whose wrong slope does not fit
  double       lowest{ 1e9 }; ///< variance over the model's, of all bands [1]
  double       highest{ -1e9 };
};

Report
MeasureBurst(const Experiment & experiment, const CheckOptions & options, std::uint64_t seed)
{
  SimulationSettings settings;
  settings.camera = PaperCamera(experiment.camera);
  settings.conditions = PaperConditions(experiment.condition);
  settings.frames = options.frames;
  settings.seed = seed;
  const std::size_t    size = options.size;
  const StackSimulator simulator(
    experiment.scene == "target" ? MakeTargetScene(size, size) : MakeTextureScene(size, size), size, size, settings);
  const std::vector<std::uint16_t> stack = tools::RenderStack(simulator, size, size, options.frames);
  return tools::EstimateBy(RefinedMethod<std::uint16_t>({}, { size, size, 1 }, options.frames), stack, options.frames)
    .report;
}

void
Execute(Experiment & experiment, const CheckOptions & options)
{
  for (std::uint64_t seed = 1; seed <= options.seeds; ++seed)
  {
    const Report report = MeasureBurst(experiment, options, seed);
    if (!report.varianceSlope.value || !report.totalIntercept.value)
    {
      continue;
    }
    const Report          other = MeasureBurst(experiment, options, seed + OtherBurst);
    const NoiseModelCheck check = CheckReport(other, report);
    for (const NoiseModelCheck::Band & band : check.bands)
    {
      experiment.lowest = std::min(experiment.lowest, band.ratio.value_or(0.0));
      experiment.highest = std::max(experiment.highest, band.ratio.value_or(0.0));
    }
    Report wrong = report;
    *wrong.varianceSlope.value *= WrongSlope;
    ++experiment.reports;
    experiment.fits += check.verdict == NoiseModelCheck::Verdict::Fits ? 1 : 0;
    experiment.seen += CheckReport(other, wrong).verdict == NoiseModelCheck::Verdict::DoesNotFit ? 1 : 0;
  }
}

void
ExecuteAll(std::vector<Experiment> & experiments, const CheckOptions & options)
{
  std::atomic<std::size_t> next{ 0 };
  std::vector<std::thread> workers;
  for (unsigned int i = 0; i < options.threads; ++i)
  {
    workers.emplace_back([&] {
      for (std::size_t k = next++; k < experiments.size(); k = next++)
      {
        Execute(experiments[k], options);
      }
    });
  }
  for (std::thread & worker : workers)
  {
    worker.join();
  }
}

void
Print(const std::vector<Experiment> & experiments)
{
  unsigned int reports = 0;
  unsigned int fits = 0;
  unsigned int seen = 0;
  std::printf("%-12s %-8s %9s %12s   %s\n", "experiment", "scene", "fits", "5 % wrong", "variance/model, all bands");
  const auto text = [](unsigned int count, unsigned int of) {
    return std::to_string(count) + '/' + std::to_string(of);
  };
  for (const Experiment & e : experiments)
  {
    std::printf("%c%-11d %-8s %9s %12s   %.3f to %.3f\n",
                e.camera,
                e.condition,
                e.scene.c_str(),
                text(e.fits, e.reports).c_str(),
                text(e.seen, e.reports).c_str(),
                e.lowest,
                e.highest);
    reports += e.reports;
    fits += e.fits;
    seen += e.seen;
  }
  std::printf("%-21s %9s %12s\n", "all", text(fits, reports).c_str(), text(seen, reports).c_str());
}
} // namespace

int
main(int argc, char * argv[])
{
  CheckOptions options;
  CLI::App     app(
    "Holds reports against other bursts of their camera, as they are and with a slope that is 5 % too steep:\n"
        "how many fit, how many of the wrong ones are seen. Cameras A to C, conditions 1 to 3, two scenes.");
  app.add_option("--seeds", options.seeds, "pairs of bursts of each")->check(CLI::Range(1, 400))->capture_default_str();
  app.add_option("--size", options.size, "width and height [pixels]")
    ->check(CLI::Range(32, 4096))
    ->capture_default_str();
  app.add_option("--frames", options.frames)->check(CLI::Range(5, 10000))->capture_default_str();
  app.add_option("--threads", options.threads)->check(CLI::Range(1, 1024));
  CLI11_PARSE(app, argc, argv);

  std::vector<Experiment> experiments;
  for (const char camera : { 'A', 'B', 'C' })
  {
    for (const int condition : { 1, 2, 3 })
    {
      for (const char * scene : { "target", "texture" })
      {
        experiments.push_back({ camera, condition, scene });
      }
    }
  }
  ExecuteAll(experiments, options);
  Print(experiments);
  return 0;
}
