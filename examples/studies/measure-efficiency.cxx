/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
// Measures how close the estimates come to the Cramer-Rao bound: simulates stacks of the cameras and conditions of
// Table 1 of Sur & Gredi'ac 2015 and compares estimates and 95 % intervals with the truth. See --help.

#include "sensornoise/report/ReportJson.h"
#include "sensornoise/report/Report.h"
#include "sensornoise/series/FrameEquations.h"
#include "sensornoise/simulation/Scenes.h"
#include "sensornoise/simulation/SimulationSettings.h"
#include "studies/EfficiencyStack.h"
#include "studies/EfficiencyTable.h"
#include "itkImageFileReader.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{
using namespace sensornoise;
using tools::EfficiencyParameters;
using tools::EfficiencyRun;
using tools::EfficiencySample;
using tools::Scene;

struct Options
{
  std::string              method{ "refined" };
  std::string              reference{ "target" };
  std::uint64_t            sceneSeed{ DefaultSceneSeed };
  std::vector<std::string> experiments{ "A1", "A2", "A3", "B1", "B2", "B3", "C1", "C2", "C3" };
  std::uint64_t            seeds{ 20 };
  std::uint64_t            firstSeed{ 1 };
  std::size_t              size{ 512 };
  std::size_t              frames{ 100 };
  std::optional<double>    flickerSd;
  std::vector<double>      vibrationSd;
  std::optional<double>    gain;
  std::optional<double>    offset;
  std::optional<double>    readNoise;
  std::optional<double>    electrons;
  double                   rollingShutterPeriod{ 0.0 };
  bool                     isFullBound{ false };
  unsigned int             threads{ std::max(1U, std::thread::hardware_concurrency()) };
  std::string              csv;
};

Scene
MakeScene(const Options & options)
{
  const std::size_t size = options.size;
  if (options.reference == "target")
  {
    return { size, size, MakeTargetScene(size, size, options.sceneSeed) };
  }
  if (options.reference == "texture")
  {
    return { size, size, MakeTextureScene(size, size, options.sceneSeed) };
  }
  if (options.reference == "bars")
  {
    return { size, size, MakeBarsScene(size, size) };
  }
  const auto     image = itk::ReadImage<itk::Image<double, 2>>(options.reference);
  const auto     region = image->GetLargestPossibleRegion();
  const double * values = image->GetBufferPointer();
  return { region.GetSize(0), region.GetSize(1), { values, values + region.GetNumberOfPixels() } };
}

SimulationSettings
MakeSettings(const Options & options, const std::string & experiment, std::uint64_t seed)
{
  SimulationSettings settings;
  CameraModel &      camera = settings.camera;
  camera = PaperCamera(experiment[0]);
  camera.gainDnPerElectron = options.gain.value_or(camera.gainDnPerElectron);
  camera.offsetDn = options.offset.value_or(camera.offsetDn);
  camera.readNoiseDn = options.readNoise.value_or(camera.readNoiseDn);
  camera.electrons = options.electrons.value_or(camera.electrons);
  SceneConditions & conditions = settings.conditions;
  conditions = PaperConditions(experiment[1] - '0');
  conditions.flickerSd = options.flickerSd.value_or(conditions.flickerSd);
  if (!options.vibrationSd.empty())
  {
    conditions.vibrationSdXPixels = options.vibrationSd[0];
    conditions.vibrationSdYPixels = options.vibrationSd[1];
  }
  settings.rollingShutterPeriodRows = options.rollingShutterPeriod;
  settings.frames = options.frames;
  settings.seed = seed;
  return settings;
}

/** The stacks of one experiment, one a thread; the first error ends them all. */
std::vector<EfficiencyRun>
MeasureAll(const Options & options, const Scene & scene, const std::string & experiment)
{
  std::vector<EfficiencyRun> runs(options.seeds);
  std::atomic<std::size_t>   next{ 0 };
  std::exception_ptr         error;
  std::mutex                 errorMutex;
  std::vector<std::thread>   workers;
  for (unsigned int i = 0; i < options.threads; ++i)
  {
    workers.emplace_back([&] {
      try
      {
        for (std::size_t k = next++; k < runs.size(); k = next++)
        {
          const SimulationSettings settings = MakeSettings(options, experiment, options.firstSeed + k);
          runs[k] = tools::MeasureStack(scene, settings, options.method, options.isFullBound);
          runs[k].experiment = experiment;
        }
      }
      catch (...)
      {
        next = runs.size();
        const std::lock_guard<std::mutex> lock(errorMutex);
        error = std::current_exception();
      }
    });
  }
  for (std::thread & worker : workers)
  {
    worker.join();
  }
  if (error)
  {
    std::rethrow_exception(error);
  }
  return runs;
}

void
WriteCsv(const std::string & name, const std::vector<EfficiencyRun> & runs)
{
  std::ofstream file(name);
  file << "experiment,seed,parameter,truth,estimate,standard_error,low95,high95,status,limit,used_fraction,"
          "unclipped_fraction\n";
  file.precision(10);
  const auto write = [&file](const std::optional<double> & number) {
    if (number)
    {
      file << *number;
    }
    file << ',';
  };
  for (const EfficiencyRun & run : runs)
  {
    for (std::size_t row = 0; row < EfficiencyParameters.size(); ++row)
    {
      const EfficiencySample & sample = run.samples[row];
      const Interval           interval = sample.estimate.interval95.value_or(Interval{});
      file << run.experiment << ',' << run.seed << ',' << EfficiencyParameters[row] << ',' << sample.truth << ',';
      write(sample.estimate.value);
      write(sample.estimate.standardError);
      write(interval.low);
      write(interval.high);
      file << NameOf(sample.estimate.status) << ',' << sample.limit << ',' << run.usedFraction << ','
           << run.keptFraction << '\n';
    }
  }
  if (!file.flush())
  {
    throw std::runtime_error("cannot write " + name);
  }
}

/** The runs whose condition is one of \a conditions. */
std::vector<const EfficiencyRun *>
Select(const std::vector<EfficiencyRun> & all, const std::string & conditions = "123")
{
  std::vector<const EfficiencyRun *> runs;
  for (const EfficiencyRun & run : all)
  {
    if (conditions.find(run.experiment[1]) != std::string::npos)
    {
      runs.push_back(&run);
    }
  }
  return runs;
}

void
MeasureEfficiency(const Options & options)
{
  const Scene scene = MakeScene(options);
  std::printf("%s method, reference %s, %zu x %zu x %zu, seeds %llu to %llu, limit: %s\n",
              options.method.c_str(),
              options.reference.c_str(),
              scene.width,
              scene.height,
              options.frames,
              static_cast<unsigned long long>(options.firstSeed),
              static_cast<unsigned long long>(options.firstSeed + options.seeds - 1),
              options.isFullBound ? "Cramer-Rao bound" : "closed forms");
  tools::PrintEfficiencyHeader();
  std::vector<EfficiencyRun> all;
  for (const std::string & experiment : options.experiments)
  {
    const std::vector<EfficiencyRun> runs = MeasureAll(options, scene, experiment);
    tools::PrintEfficiencyRows(Select(runs), experiment, false);
    all.insert(all.end(), runs.begin(), runs.end());
    if (!options.csv.empty())
    {
      WriteCsv(options.csv, all);
    }
  }
  if (options.experiments.size() > 1)
  {
    tools::PrintEfficiencyRows(Select(all), "all", true);
    tools::PrintEfficiencyRows(Select(all, "23"), "*2 *3", true);
    tools::PrintEfficiencyRows(Select(all, "1"), "*1", true);
  }
}
} // namespace

int
main(int argc, char * argv[])
{
  Options  options;
  CLI::App app(
    "How close the estimates come to the theoretical limit, by simulation. One line an experiment and parameter:\n"
    "bias; rms error; rms error over the limit, per stack (rms/lim; 1 is the best there is); mean error over the "
    "limit;\n"
    "how many 95 % intervals hold the truth; rms of error over standard error (z-rms, should be 1); how many of the N\n"
    "stacks identify the parameter. Flicker and vibrations are compared with what the stack really had. Last, all\n"
    "experiments together, then conditions 2 and 3, and condition 1: rms error in % of the truth.");
  app.add_option("--method", options.method)->check(CLI::IsMember({ "refined", "published" }))->capture_default_str();
  app.add_option("--reference", options.reference, "target, texture, bars or an image file")->capture_default_str();
  app.add_option("--scene-seed", options.sceneSeed, "another target or texture")->capture_default_str();
  app.add_option("--experiments", options.experiments, "camera and condition, for example A1,B3")
    ->delimiter(',')
    ->check(CLI::IsMember({ "A1", "A2", "A3", "B1", "B2", "B3", "C1", "C2", "C3" }));
  app.add_option("--seeds", options.seeds, "stacks of each experiment")
    ->check(CLI::Range(1, 10000))
    ->capture_default_str();
  app.add_option("--first-seed", options.firstSeed)->capture_default_str();
  app.add_option("--size", options.size, "width and height of a scene [pixels]")
    ->check(CLI::Range(32, 4096))
    ->capture_default_str();
  app.add_option("--frames", options.frames)->check(CLI::Range(5, 10000))->capture_default_str();
  app.add_option("--flicker-sd", options.flickerSd, "instead of the condition's [1]");
  app.add_option("--vibration-sd", options.vibrationSd, "X,Y instead of the condition's [pixels]")
    ->delimiter(',')
    ->expected(2);
  app.add_option("--gain", options.gain, "instead of the camera's [DN/e-]");
  app.add_option("--offset", options.offset, "instead of the camera's [DN]");
  app.add_option("--read-noise", options.readNoise, "instead of the camera's [DN]");
  app.add_option("--electrons", options.electrons, "brightest pixel, instead of the camera's [e-]");
  auto * shutter = app.add_option("--rolling-shutter",
                                  options.rollingShutterPeriod,
                                  "bands of the flicker [rows]; 0: global. The limit is that of global flicker");
  app
    .add_flag(
      "--full-bound", options.isFullBound, "the Cramer-Rao bound itself: 4 s a stack; else closed forms, 3 % off")
    ->excludes(shutter);
  app.add_option("--threads", options.threads, "stacks at the same time")->check(CLI::Range(1, 1024));
  app.add_option("--csv", options.csv, "every single stack, one line a parameter");
  CLI11_PARSE(app, argc, argv);
  try
  {
    MeasureEfficiency(options);
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
