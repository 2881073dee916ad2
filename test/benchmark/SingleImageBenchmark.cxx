// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// The time of the single-image method for one frame of 24 megapixels, in passes that read the frame sample by sample:
// one thread each, in processor time, which depends little on the load of the machine.

#include "benchmark/BenchmarkStack.h"
#include "sensornoise/Simulator.h"
#include "itkSensorNoiseStackSource.h"
#include "itkSingleImageNoiseEstimator.h"

#include <algorithm>
#include <ctime>
#include <vector>

namespace sensornoise::benchmarks
{
namespace
{
StackType::Pointer
SimulateFrame(std::size_t width, std::size_t height)
{
  auto                                  reference = itk::Image<double, 2>::New();
  const itk::Image<double, 2>::SizeType size{ { width, height } };
  reference->SetRegions(size);
  reference->Allocate();
  const std::vector<double> scene = MakeTargetScene(width, height);
  std::copy(scene.begin(), scene.end(), reference->GetBufferPointer());
  auto source = itk::SensorNoiseStackSource<StackType>::New();
  source->SetReference(reference);
  source->SetCamera('B');
  source->SetConditions(3);
  source->SetNumberOfFrames(1);
  source->Update();
  StackType::Pointer frame = source->GetOutput();
  frame->DisconnectPipeline();
  return frame;
}

template <typename TFunction>
double
ProcessorSecondsOf(TFunction function)
{
  const std::clock_t start = std::clock();
  function();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void
SingleImage(benchmark::State & state)
{
  const auto frame = SimulateFrame(static_cast<std::size_t>(state.range(0)), static_cast<std::size_t>(state.range(1)));
  std::vector<double> readPasses;
  for (auto _ : state)
  {
    const double readPass = ProcessorSecondsOf([&] { benchmark::DoNotOptimize(ReadPass(frame, 1)); });
    auto         estimator = itk::SingleImageNoiseEstimator<StackType>::New();
    estimator->SetInput(frame);
    estimator->SetNumberOfWorkUnits(1);
    const double seconds = ProcessorSecondsOf([&] { estimator->Update(); });
    state.SetIterationTime(seconds);
    readPasses.push_back(seconds / readPass);
  }
  SetRatios(state, "read_passes", readPasses);
}

BENCHMARK(SingleImage)
  ->ArgNames({ "width", "height" })
  ->Args({ 6000, 4000 })
  ->UseManualTime()
  ->Iterations(9)
  ->Unit(benchmark::kMillisecond);
} // namespace
} // namespace sensornoise::benchmarks
