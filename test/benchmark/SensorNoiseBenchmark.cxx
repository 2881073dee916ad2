// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Speed, as ratios to two yardsticks, timed in the same run and by the same threads just before what is measured:
// read_passes counts passes over the stack in memory that read one sample after the other, memory_passes those of the
// fastest sum that the compiler makes, which waits for the memory. The counters are medians.
//
//   SensorNoiseBenchmark [--benchmark_filter=...]     stack: 1376 x 1040 x 100 unsigned short, 2 threads

#include "sensornoise/simulation/Scenes.h"
#include "itkMultiThreaderBase.h"
#include "itkSensorNoiseEstimator.h"
#include "itkSensorNoiseStackSource.h"
#include "itkTemporalStatisticsImageFilter.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace
{
using StackType = itk::Image<unsigned short, 3>;
constexpr unsigned int Threads = 2;
constexpr std::size_t  Width = 1376;
constexpr std::size_t  Height = 1040;
constexpr std::size_t  Frames = 100;

StackType::Pointer
GetStack(double rollingShutterPeriod)
{
  auto                                  reference = itk::Image<double, 2>::New();
  const itk::Image<double, 2>::SizeType size{ { Width, Height } };
  reference->SetRegions(size);
  reference->Allocate();
  const std::vector<double> scene = sensornoise::MakeTargetScene(Width, Height);
  std::copy(scene.begin(), scene.end(), reference->GetBufferPointer());
  auto source = itk::SensorNoiseStackSource<StackType>::New();
  source->SetReference(reference);
  source->SetCamera('B');
  source->SetConditions(3);
  source->SetNumberOfFrames(Frames);
  source->SetRollingShutterPeriod(rollingShutterPeriod);
  source->Update();
  StackType::Pointer stack = source->GetOutput();
  stack->DisconnectPipeline();
  return stack;
}

/** The sum of all samples; each is read as a \a TSample. */
template <typename TSample>
std::uint64_t
SumOfSamples(const StackType * stack)
{
  static auto                threader = itk::MultiThreaderBase::New();
  const std::size_t          blocks = Frames * 8;
  const std::size_t          size = Width * Height * Frames / blocks;
  std::vector<std::uint64_t> sums(blocks);
  threader->SetNumberOfWorkUnits(Threads);
  threader->ParallelizeArray(
    0,
    blocks,
    [&](itk::SizeValueType b) {
      TSample * const samples = stack->GetBufferPointer() + b * size;
      sums[b] = std::accumulate(samples, samples + size, std::uint64_t{ 0 });
    },
    nullptr);
  return std::accumulate(sums.begin(), sums.end(), std::uint64_t{ 0 });
}

/** Volatile samples are read one after the other, whatever the compiler. */
constexpr auto ReadPass = SumOfSamples<const volatile unsigned short>;
constexpr auto MemoryPass = SumOfSamples<const unsigned short>;

template <typename TFunction>
double
SecondsOf(TFunction function)
{
  const auto start = std::chrono::steady_clock::now();
  function();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double
MedianOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/** Times \a function in each iteration after a pass of either kind. */
template <typename TFunction>
void
CompareWithReadPass(benchmark::State & state, const StackType * stack, TFunction function)
{
  std::vector<double> readPasses;
  std::vector<double> memoryPasses;
  for (auto _ : state)
  {
    const double memoryPass = SecondsOf([&] { benchmark::DoNotOptimize(MemoryPass(stack)); });
    const double readPass = SecondsOf([&] { benchmark::DoNotOptimize(ReadPass(stack)); });
    const double seconds = SecondsOf(function);
    state.SetIterationTime(seconds);
    readPasses.push_back(seconds / readPass);
    memoryPasses.push_back(seconds / memoryPass);
  }
  state.counters["read_passes"] = MedianOf(readPasses);
  state.counters["memory_passes"] = MedianOf(memoryPasses);
}

void
ReadPassAgain(benchmark::State & state)
{
  const auto stack = GetStack(0.0);
  CompareWithReadPass(state, stack, [&] { benchmark::DoNotOptimize(ReadPass(stack)); });
}

/** Mean, variance and clip mask. */
void
TemporalStatistics(benchmark::State & state)
{
  const auto stack = GetStack(0.0);
  CompareWithReadPass(state, stack, [&] {
    auto filter = itk::TemporalStatisticsImageFilter<StackType>::New();
    filter->SetInput(stack);
    filter->SetNumberOfWorkUnits(Threads);
    filter->Update();
  });
}

/** A whole estimate; the argument is the period of a rolling shutter's bands in rows, 0 for none. */
void
Estimate(benchmark::State & state, const char * method)
{
  const auto stack = GetStack(static_cast<double>(state.range(0)));
  CompareWithReadPass(state, stack, [&] {
    auto estimator = itk::SensorNoiseEstimator<StackType>::New();
    estimator->SetInput(stack);
    estimator->SetMethod(method);
    estimator->SetNumberOfWorkUnits(Threads);
    estimator->Update();
  });
}

BENCHMARK(ReadPassAgain)->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK(TemporalStatistics)->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Estimate, Published, "published")
  ->Arg(0)
  ->Arg(600)
  ->UseManualTime()
  ->Iterations(5)
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Estimate, Refined, "refined")
  ->Arg(0)
  ->Arg(600)
  ->UseManualTime()
  ->Iterations(5)
  ->Unit(benchmark::kMillisecond);
} // namespace

int
main(int argc, char ** argv)
{
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(Threads);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
