// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Speed, as ratios to two reference times. Both are measured in the same run, by the same threads, just before each
// benchmark. The counter read_passes counts passes over the stack in memory that read one sample after the other. The
// counter memory_passes counts passes of the fastest sum that the compiler makes, whose speed the memory limits. The
// counters are medians.
//
// Filters that work pixel by pixel are timed against ITK's CastImageFilter between the same types, on a part of the
// stack. The counter casts counts its runs.
//
//   SensorNoiseBenchmark [--benchmark_filter=...]     stack: 1376 x 1040 x 100 unsigned short, 2 threads

#include "benchmark/BenchmarkStack.h"
#include "itkCastImageFilter.h"
#include "itkGeneralizedAnscombeImageFilter.h"
#include "itkInverseGeneralizedAnscombeImageFilter.h"
#include "itkMeanProjectionImageFilter.h"
#include "itkMultiThreaderBase.h"
#include "itkStandardDeviationProjectionImageFilter.h"

#include <benchmark/benchmark.h>
#include <type_traits>
#include <vector>

namespace sensornoise::benchmarks
{
namespace
{
void
ReadPassAgain(benchmark::State & state)
{
  const auto stack = SimulateStack();
  CompareWithReadPass(state, stack, [&] { return SecondsToReadPass(stack); });
}

void
TemporalStatistics(benchmark::State & state)
{
  const auto stack = SimulateStack();
  CompareWithReadPass(state, stack, [&] { return SecondsToTemporalStatistics(stack); });
}

/** Measures a whole estimate. The argument is the period of the bands of a rolling shutter in rows, 0 for none. */
void
Estimate(benchmark::State & state, const char * method)
{
  const auto stack = SimulateStack(static_cast<double>(state.range(0)));
  CompareWithReadPass(state, stack, [&] { return SecondsToEstimate(stack, method); });
}

/** Measures ITK's own filters for mean and standard deviation over time. */
void
Projections(benchmark::State & state)
{
  using MapType = itk::Image<double, 2>;
  const auto stack = SimulateStack();
  CompareWithReadPass(state, stack, [&] {
    auto mean = itk::MeanProjectionImageFilter<StackType, MapType>::New();
    auto deviation = itk::StandardDeviationProjectionImageFilter<StackType, MapType>::New();
    mean->SetInput(stack);
    mean->SetNumberOfWorkUnits(Threads);
    deviation->SetInput(stack);
    deviation->SetNumberOfWorkUnits(Threads);
    return SecondsOf([&] {
      mean->Update();
      deviation->Update();
    });
  });
}

/** Times one thread, each time before two threads. times_faster is the ratio of the times, and of_read_pass is the
 * ratio for plain read passes. */
void
TwoThreads(benchmark::State & state, const char * what)
{
  const auto          stack = SimulateStack();
  std::vector<double> ratios;
  std::vector<double> ofReadPass;
  for (auto _ : state)
  {
    ofReadPass.push_back(SecondsToReadPass(stack, 1) / SecondsToReadPass(stack, 2));
    const double one = SecondsTo(what, stack, 1);
    const double two = SecondsTo(what, stack, 2);
    state.SetIterationTime(two);
    ratios.push_back(one / two);
  }
  SetRatios(state, "times_faster", ratios);
  SetRatios(state, "of_read_pass", ofReadPass);
}

/** Measures the four channels of a mosaic, each time after the estimate of a monochrome stack of the same size. */
void
Mosaic(benchmark::State & state, const char * method)
{
  const auto          mosaic = SimulateStack(0.0, "RGGB");
  const auto          mono = SimulateStack();
  std::vector<double> monos;
  for (auto _ : state)
  {
    const double ofMono = SecondsToEstimate(mono, method);
    const double seconds = SecondsToEstimate(mosaic, method, "RGGB");
    state.SetIterationTime(seconds);
    monos.push_back(seconds / ofMono);
  }
  SetRatios(state, "monos", monos);
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

/** Measures a filter pixel by pixel, each time after a cast between the same types. */
template <typename TFilter>
void
PixelByPixel(benchmark::State & state)
{
  using InputType = typename TFilter::InputImageType;
  auto part = itk::CastImageFilter<StackType, InputType>::New();
  part->SetInput(SimulateStack());
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
  SetRatios(state, "casts", casts);
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
BENCHMARK(Projections)->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
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
BENCHMARK_CAPTURE(TwoThreads, Statistics, "statistics")->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(TwoThreads, Published, "published")->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(TwoThreads, Refined, "refined")->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Mosaic, Published, "published")->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Mosaic, Refined, "refined")->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
} // namespace
} // namespace sensornoise::benchmarks

int
main(int argc, char ** argv)
{
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(sensornoise::benchmarks::Threads);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
