// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "benchmark/BenchmarkStack.h"

#include "sensornoise/Simulator.h"
#include "itkMultiThreaderBase.h"
#include "itkSensorNoiseStackSource.h"

#include <algorithm>
#include <numeric>

namespace sensornoise::benchmarks
{
namespace
{
/** Returns the sum of all samples; each is read as a \a TSample. */
template <typename TSample>
std::uint64_t
SumOfSamples(const StackType * stack, unsigned int threads)
{
  static auto                threader = itk::MultiThreaderBase::New();
  const auto                 size = stack->GetBufferedRegion().GetSize();
  const std::size_t          blocks = size[2] * 8;
  const std::size_t          samples = size[0] * size[1] * size[2] / blocks;
  std::vector<std::uint64_t> sums(blocks);
  threader->SetNumberOfWorkUnits(threads);
  threader->ParallelizeArray(
    0,
    blocks,
    [&](itk::SizeValueType b) {
      TSample * const first = stack->GetBufferPointer() + b * samples;
      sums[b] = std::accumulate(first, first + samples, std::uint64_t{ 0 });
    },
    nullptr);
  return std::accumulate(sums.begin(), sums.end(), std::uint64_t{ 0 });
}
} // namespace

StackType::Pointer
SimulateStack(double rollingShutterPeriodRows, const char * bayer)
{
  auto                                  reference = itk::Image<double, 2>::New();
  const itk::Image<double, 2>::SizeType size{ { Width, Height } };
  reference->SetRegions(size);
  reference->Allocate();
  const std::vector<double> scene = MakeTargetScene(Width, Height);
  std::copy(scene.begin(), scene.end(), reference->GetBufferPointer());
  auto source = itk::SensorNoiseStackSource<StackType>::New();
  source->SetReference(reference);
  source->SetCamera('B');
  source->SetConditions(3);
  source->SetNumberOfFrames(Frames);
  source->SetRollingShutterPeriod(rollingShutterPeriodRows);
  source->SetBayerPattern(bayer);
  source->Update();
  StackType::Pointer stack = source->GetOutput();
  stack->DisconnectPipeline();
  return stack;
}

std::uint64_t
ReadPass(const StackType * stack, unsigned int threads)
{
  return SumOfSamples<const volatile unsigned short>(stack, threads);
}

std::uint64_t
MemoryPass(const StackType * stack)
{
  return SumOfSamples<const unsigned short>(stack, Threads);
}

void
SetRatios(benchmark::State & state, const std::string & name, const std::vector<double> & ratios)
{
  std::vector<double> sorted = ratios;
  std::sort(sorted.begin(), sorted.end());
  state.counters[name] = sorted.at(sorted.size() / 2);
  state.counters[name + "_min"] = sorted.front();
  state.counters[name + "_max"] = sorted.back();
}

} // namespace sensornoise::benchmarks
