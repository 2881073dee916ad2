// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Time of a frame, and time of a pixel that does not depend on the frames. The first frames of one stack are measured:
// an eighth of them, a quarter, half and all, in turn. The counter frames_T is the time for T of them, in the time in
// which a read pass reads one frame; a line through these numbers has the cost per sample as its slope.

#include "benchmark/BenchmarkStack.h"
#include "sensornoise/Simulator.h"
#include "itkSensorNoiseStackSource.h"

#include <algorithm>
#include <map>

namespace sensornoise::benchmarks
{
namespace
{
constexpr std::size_t Tiles = 8; // tiles of the scene, one below the other

/** The target scene Tiles times, one below the other, so that the scene of a frame that is rolled by the height of a
 * tile is the same. The surround of each is even, and so the first row goes with the last. */
itk::Image<double, 2>::Pointer
MakeTiledScene(std::size_t width, std::size_t height)
{
  auto                                  reference = itk::Image<double, 2>::New();
  const itk::Image<double, 2>::SizeType size{ { width, height } };
  reference->SetRegions(size);
  reference->Allocate();
  const std::vector<double> tile = MakeTargetScene(width, height / Tiles);
  for (std::size_t k = 0; k < Tiles; ++k)
  {
    std::copy(tile.begin(), tile.end(), reference->GetBufferPointer() + k * tile.size());
  }
  return reference;
}

/** An eighth of the frames is simulated; the others are these frames, rolled by one tile, two tiles and so on: at
 * each pixel the noise is new, and the simulation takes an eighth of the time. */
StackType::Pointer
MakeLongStack(std::size_t width, std::size_t height, std::size_t frames)
{
  const std::size_t simulated = frames / Tiles;
  auto              source = itk::SensorNoiseStackSource<StackType>::New();
  source->SetReference(MakeTiledScene(width, height));
  source->SetCamera('B');
  source->SetConditions(3);
  source->SetNumberOfFrames(static_cast<unsigned int>(simulated));
  source->Update();

  auto                      stack = StackType::New();
  const StackType::SizeType size{ { width, height, frames } };
  stack->SetRegions(size);
  stack->Allocate();
  const std::size_t framePixels = width * height;
  for (std::size_t t = 0; t < frames; ++t)
  {
    const unsigned short * const frame = source->GetOutput()->GetBufferPointer() + t % simulated * framePixels;
    unsigned short * const       rolled = stack->GetBufferPointer() + t * framePixels;
    std::rotate_copy(frame, frame + t / simulated * (framePixels / Tiles), frame + framePixels, rolled);
  }
  return stack;
}

/** Returns the first frames of a stack, which has to stay. */
StackType::Pointer
FirstFrames(StackType * stack, std::size_t frames)
{
  StackType::SizeType size = stack->GetLargestPossibleRegion().GetSize();
  size[2] = frames;
  auto first = StackType::New();
  first->SetRegions(size);
  first->GetPixelContainer()->SetImportPointer(stack->GetBufferPointer(), size[0] * size[1] * size[2]);
  return first;
}

void
CostOfFrames(benchmark::State & state, const char * what)
{
  const auto frames = static_cast<std::size_t>(state.range(2));
  const auto stack =
    MakeLongStack(static_cast<std::size_t>(state.range(0)), static_cast<std::size_t>(state.range(1)), frames);
  std::map<std::size_t, std::vector<double>> costs;
  for (auto _ : state)
  {
    double all = 0.0;
    for (const std::size_t divisor : { 8, 4, 2, 1 })
    {
      const auto   part = FirstFrames(stack, frames / divisor);
      const double readPass = SecondsToReadPass(part);
      const double seconds = SecondsTo(what, part);
      costs[frames / divisor].push_back(seconds / readPass * static_cast<double>(frames / divisor));
      all += seconds;
    }
    state.SetIterationTime(all);
  }
  for (const auto & [count, cost] : costs)
  {
    SetRatios(state, "frames_" + std::to_string(count), cost);
  }
}

void
SetStacks(benchmark::internal::Benchmark * cases)
{
  cases->ArgNames({ "width", "height", "frames" })
    ->Args({ 1376, 1040, 400 })
    ->Args({ 4096, 3072, 200 })
    ->Args({ 4096, 3072, 400 })
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(CostOfFrames, Statistics, "statistics")->Apply(SetStacks);
BENCHMARK_CAPTURE(CostOfFrames, Published, "published")->Apply(SetStacks);
BENCHMARK_CAPTURE(CostOfFrames, Refined, "refined")->Apply(SetStacks);
} // namespace
} // namespace sensornoise::benchmarks
