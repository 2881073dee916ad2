// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/TableRun.h"

#include "sensornoise/PublishedMethod.h"
#include "sensornoise/Report.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "studies/RenderedStack.h"

#include <atomic>

namespace sensornoise::tools
{
namespace
{
void
Execute(TableRun & run, const TableOptions & options, const std::vector<double> & scene)
{
  SimulationSettings settings;
  settings.camera = PaperCamera(run.camera);
  settings.conditions = PaperConditions(run.condition);
  if (options.flickerSd >= 0.0)
  {
    settings.conditions.flickerSd = options.flickerSd;
  }
  settings.rollingShutterPeriodRows = options.rollingShutterPeriod;
  if (!options.clip.empty())
  {
    settings.clipLowDn = options.clip[0];
    settings.clipHighDn = options.clip[1];
  }
  settings.frames = run.frames;
  settings.seed = run.seed;
  const StackSimulator             simulator(scene, options.size, options.size, settings);
  const std::vector<std::uint16_t> stack = RenderStack(simulator, options.size, options.size, run.frames);

  PublishedMethod<std::uint16_t> method({}, { options.size, options.size, 1 }, run.frames);
  while (!method.IsDone())
  {
    method.AddFrames(stack.data(), run.frames);
    method.EndPass();
  }
  const Report & report = method.GetReport();
  run.estimates = { report.gain.value,      report.offset.value,       report.readNoise.value,   report.intercept.value,
                    report.flickerSd.value, report.vibrationSdX.value, report.vibrationSdY.value };
  const CameraModel & camera = settings.camera;
  run.truth = { camera.gainDnPerElectron,
                camera.offsetDn,
                camera.readNoiseDn,
                camera.readNoiseDn * camera.readNoiseDn - camera.gainDnPerElectron * camera.offsetDn,
                settings.conditions.flickerSd,
                settings.conditions.vibrationSdXPixels,
                settings.conditions.vibrationSdYPixels };
}
} // namespace

void
ExecuteAll(std::vector<TableRun> & runs, const TableOptions & options)
{
  const std::size_t         size = options.size;
  const std::vector<double> scene = options.reference == "target" ? MakeTargetScene(size, size)
                                    : options.reference == "bars" ? MakeBarsScene(size, size)
                                                                  : MakeTextureScene(size, size);
  std::atomic<std::size_t>  next{ 0 };
  std::vector<std::thread>  workers;
  for (unsigned int i = 0; i < options.threads; ++i)
  {
    workers.emplace_back([&] {
      for (std::size_t k = next++; k < runs.size(); k = next++)
      {
        Execute(runs[k], options, scene);
      }
    });
  }
  for (std::thread & worker : workers)
  {
    worker.join();
  }
}

} // namespace sensornoise::tools
