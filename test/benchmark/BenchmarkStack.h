// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_benchmark_BenchmarkStack_h
#define sensornoise_benchmark_BenchmarkStack_h

#include "itkImage.h"
#include "itkSensorNoiseEstimator.h"
#include "itkTemporalStatisticsImageFilter.h"

#include <benchmark/benchmark.h>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/** \file
 * Simulated stacks, passes over them as yardsticks, and the counters of ratios between times of one run. */

namespace sensornoise::benchmarks
{
using StackType = itk::Image<unsigned short, 3>;

inline constexpr unsigned int Threads = 2;
inline constexpr std::size_t  Width = 1376;
inline constexpr std::size_t  Height = 1040;
inline constexpr std::size_t  Frames = 100;

/** Width x Height x Frames pixels of the target scene, camera B, condition 3. */
StackType::Pointer
SimulateStack(double rollingShutterPeriodRows = 0.0, const char * bayer = "none");

/** Returns the sum of all samples, which are read one after the other, whatever the compiler. */
std::uint64_t
ReadPass(const StackType * stack, unsigned int threads = Threads);
/** The fastest sum that the compiler makes: it waits for the memory. */
std::uint64_t
MemoryPass(const StackType * stack);

template <typename TFunction>
double
SecondsOf(TFunction function)
{
  const auto start = std::chrono::steady_clock::now();
  function();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double
SecondsToReadPass(const StackType * stack, unsigned int threads = Threads)
{
  return SecondsOf([&] { benchmark::DoNotOptimize(ReadPass(stack, threads)); });
}

/** Mean, variance and clip mask. */
inline double
SecondsToTemporalStatistics(StackType * stack, unsigned int threads = Threads)
{
  auto filter = itk::TemporalStatisticsImageFilter<StackType>::New();
  filter->SetInput(stack);
  filter->SetNumberOfWorkUnits(threads);
  return SecondsOf([&] { filter->Update(); });
}

/** A whole estimate. */
inline double
SecondsToEstimate(StackType *         stack,
                  const std::string & method,
                  const std::string & bayer = "none",
                  unsigned int        threads = Threads)
{
  auto estimator = itk::SensorNoiseEstimator<StackType>::New();
  estimator->SetInput(stack);
  estimator->SetMethod(method);
  estimator->SetBayerPattern(bayer);
  estimator->SetNumberOfWorkUnits(threads);
  return SecondsOf([&] { estimator->Update(); });
}

/** Work of a benchmark that is named "statistics", "published" or "refined". */
inline double
SecondsTo(const std::string & what, StackType * stack, unsigned int threads = Threads)
{
  return what == "statistics" ? SecondsToTemporalStatistics(stack, threads)
                              : SecondsToEstimate(stack, what, "none", threads);
}

/** Stores the median under the name itself, and the ends as NAME_min and NAME_max. */
void
SetRatios(benchmark::State & state, const std::string & name, const std::vector<double> & ratios);

/** Times \a function, which gives seconds, in each iteration after a pass of either kind. */
template <typename TFunction>
void
CompareWithReadPass(benchmark::State & state, const StackType * stack, TFunction function)
{
  std::vector<double> readPasses;
  std::vector<double> memoryPasses;
  for (auto _ : state)
  {
    const double memoryPass = SecondsOf([&] { benchmark::DoNotOptimize(MemoryPass(stack)); });
    const double readPass = SecondsToReadPass(stack);
    const double seconds = function();
    state.SetIterationTime(seconds);
    readPasses.push_back(seconds / readPass);
    memoryPasses.push_back(seconds / memoryPass);
  }
  SetRatios(state, "read_passes", readPasses);
  SetRatios(state, "memory_passes", memoryPasses);
}

} // namespace sensornoise::benchmarks

#endif
