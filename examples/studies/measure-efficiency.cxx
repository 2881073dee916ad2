// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Measures how close the estimates come to the Cramer-Rao bound: simulates stacks of the cameras and conditions of
// Table 1 of Sur & Gredi'ac 2015 and compares estimates and 95 % intervals with the truth. See --help.

#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "studies/EfficiencyOptions.h"
#include "studies/EfficiencyStack.h"
#include "studies/EfficiencyStatistics.h"
#include "studies/EfficiencyTable.h"
#include "itkImage.h"
#include "itkImageFileReader.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace
{
using namespace sensornoise;
using tools::EfficiencyOptions;
using tools::EfficiencyRun;
using tools::Scene;

Scene
MakeScene(const EfficiencyOptions & options)
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
MakeSettings(const EfficiencyOptions & options, const std::string & experiment, std::uint64_t seed)
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
  if (options.bayer != "none")
  {
    settings.flaws.filters.pattern = BayerPatternOf(options.bayer);
  }
  settings.rollingShutterPeriodRows = options.rollingShutterPeriod;
  settings.frames = options.frames;
  settings.seed = seed;
  return settings;
}

/** The stacks of one experiment, one a thread; the first error ends them all. */
std::vector<EfficiencyRun>
MeasureAll(const EfficiencyOptions & options, const Scene & scene, const std::string & experiment)
{
  const std::size_t          planes = options.bayer == "none" ? 1 : BayerPlanes.size();
  std::vector<EfficiencyRun> runs(options.seeds * planes);
  std::atomic<std::size_t>   next{ 0 };
  std::exception_ptr         error;
  std::mutex                 errorMutex;
  std::vector<std::thread>   workers;
  for (unsigned int i = 0; i < options.threads; ++i)
  {
    workers.emplace_back([&] {
      try
      {
        for (std::size_t k = next++; k < options.seeds; k = next++)
        {
          const SimulationSettings settings = MakeSettings(options, experiment, options.firstSeed + k);
          if (planes == 1)
          {
            runs[k] = tools::MeasureStack(scene, settings, options.method, options.isFullBound);
            runs[k].experiment = experiment;
            continue;
          }
          const auto ofPlanes = tools::MeasureMosaic(scene, settings, options.method);
          for (std::size_t plane = 0; plane < planes; ++plane)
          {
            runs[plane * options.seeds + k] = ofPlanes[plane];
            runs[plane * options.seeds + k].experiment = experiment + "/" + ofPlanes[plane].experiment;
          }
        }
      }
      catch (...)
      {
        next = options.seeds;
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
MeasureEfficiency(const EfficiencyOptions & options)
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
    const auto                       seeds = static_cast<std::size_t>(options.seeds);
    for (std::size_t first = 0; first < runs.size(); first += seeds)
    {
      const auto                       begin = runs.begin() + static_cast<std::ptrdiff_t>(first);
      const std::vector<EfficiencyRun> group(begin, begin + static_cast<std::ptrdiff_t>(seeds));
      tools::PrintEfficiencyRows(Select(group), group.front().experiment, false);
    }
    all.insert(all.end(), runs.begin(), runs.end());
    if (!options.csv.empty())
    {
      tools::WriteEfficiencyCsv(options.csv, all);
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
  try
  {
    EfficiencyOptions options;
    if (const auto finished = options.Parse(argc, argv))
    {
      return *finished;
    }
    MeasureEfficiency(options);
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
