// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Speed, as ratios to two yardsticks, timed in the same run and by the same threads just before what is measured:
// read_passes counts passes over the stack in memory that read one sample after the other, memory_passes those of the
// fastest sum that the compiler makes, which waits for the memory. The counters are medians.
//
// What is done pixel by pixel is timed against ITK's CastImageFilter between the same types, on a part of the stack:
// casts counts its runs.
//
//   SensorNoiseBenchmark [--benchmark_filter=...]     stack: 1376 x 1040 x 100 unsigned short, 2 threads

#include "sensornoise/simulation/Scenes.h"
#include "itkCastImageFilter.h"
#include "itkGeneralizedAnscombeImageFilter.h"
#include "itkInverseGeneralizedAnscombeImageFilter.h"
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
#include <type_traits>
#include <vector>

namespace
{
using StackType = itk::Image<unsigned short, 3>;
constexpr unsigned int Threads = 2;
constexpr std::size_t  Width = 1376;
constexpr std::size_t  Height = 1040;
constexpr std::size_t  Frames = 100;

StackType::Pointer
GetStack(double rollingShutterPeriod, const char * bayer = "none")
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
  source->SetBayerPattern(bayer);
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

double
SecondsToEstimate(const StackType * stack, const char * method, const char * bayer)
{
  auto estimator = itk::SensorNoiseEstimator<StackType>::New();
  estimator->SetInput(stack);
  estimator->SetMethod(method);
  estimator->SetBayerPattern(bayer);
  estimator->SetNumberOfWorkUnits(Threads);
  return SecondsOf([&] { estimator->Update(); });
}

/** The four channels of a mosaic, each time after the estimate of a monochrome stack of the same size. */
void
Mosaic(benchmark::State & state, const char * method)
{
  const auto          mosaic = GetStack(0.0, "RGGB");
  const auto          mono = GetStack(0.0);
  std::vector<double> monos;
  for (auto _ : state)
  {
    const double ofMono = SecondsToEstimate(mono, method, "none");
    const double seconds = SecondsToEstimate(mosaic, method, "RGGB");
    state.SetIterationTime(seconds);
    monos.push_back(seconds / ofMono);
  }
  state.counters["monos"] = MedianOf(monos);
}

using RealStackType = itk::Image<float, 3>;

/** A filter's run over \a input, with its output made anew. */
template <typename TFilter, typename TImage>
double
SecondsToFilter(const TImage * input)
{
  auto filter = TFilter::New();
  filter->SetInput(input);
  filter->SetNumberOfWorkUnits(Threads);
  if constexpr (!std::is_same_v<TFilter, itk::CastImageFilter<TImage, typename TFilter::OutputImageType>>)
  {
    filter->SetVarianceSlope(0.4);
    filter->SetTotalIntercept(-30.0);
  }
  return SecondsOf([&] { filter->Update(); });
}

/** A filter pixel by pixel, each time after a cast between the same types. */
template <typename TFilter>
void
PixelByPixel(benchmark::State & state)
{
  using InputType = typename TFilter::InputImageType;
  auto part = itk::CastImageFilter<StackType, InputType>::New();
  part->SetInput(GetStack(0.0));
  part->GetOutput()->SetRequestedRegion({ {}, { { Width, Height, 20 } } });
  part->Update();
  typename InputType::Pointer input = InputType::New();
  input->SetRegions(part->GetOutput()->GetBufferedRegion());
  input->SetPixelContainer(part->GetOutput()->GetPixelContainer());
  std::vector<double> casts;
  for (auto _ : state)
  {
    const double cast =
      SecondsToFilter<itk::CastImageFilter<InputType, typename TFilter::OutputImageType>, InputType>(input);
    const double seconds = SecondsToFilter<TFilter, InputType>(input);
    state.SetIterationTime(seconds);
    casts.push_back(seconds / cast);
  }
  state.counters["casts"] = MedianOf(casts);
}

BENCHMARK_TEMPLATE(PixelByPixel, itk::GeneralizedAnscombeImageFilter<StackType, RealStackType>)
  ->UseManualTime()
  ->Iterations(15)
  ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(PixelByPixel, itk::GeneralizedAnscombeImageFilter<RealStackType, RealStackType>)
  ->UseManualTime()
  ->Iterations(15)
  ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(PixelByPixel, itk::InverseGeneralizedAnscombeImageFilter<RealStackType, StackType>)
  ->UseManualTime()
  ->Iterations(15)
  ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(PixelByPixel, itk::InverseGeneralizedAnscombeImageFilter<RealStackType, RealStackType>)
  ->UseManualTime()
  ->Iterations(15)
  ->Unit(benchmark::kMillisecond);
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
BENCHMARK_CAPTURE(Mosaic, Published, "published")->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Mosaic, Refined, "refined")->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
} // namespace

int
main(int argc, char ** argv)
{
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(Threads);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
