// SPDX-FileCopyrightText: the ITKSensorNoise contributors SPDX-License-Identifier: Apache-2.0 The estimate of a list of
// files, each time after the estimate of the same frames in memory. The counter in_memory is the ratio. The files were
// written just before, and so are in the computer's memory, too.

#include "benchmark/BenchmarkStack.h"
#include "itkExtractImageFilter.h"
#include "itkImageFileWriter.h"
#include "itkSensorNoiseFrameListSource.h"

#include <filesystem>
#include <random>

namespace sensornoise::benchmarks
{
namespace
{
namespace fs = std::filesystem;

/** The frames of a stack, one in a file, in a folder that goes with this. */
class FrameFiles
{
public:
  FrameFiles(StackType * stack, const std::string & ending)
    : m_Folder(fs::temp_directory_path() / ("SensorNoiseBenchmark" + std::to_string(std::random_device{}())))
  {
    fs::create_directories(m_Folder);
    using FrameType = itk::Image<unsigned short, 2>;
    auto frame = itk::ExtractImageFilter<StackType, FrameType>::New();
    frame->SetInput(stack);
    frame->SetDirectionCollapseToSubmatrix();
    auto writer = itk::ImageFileWriter<FrameType>::New();
    writer->SetInput(frame->GetOutput());
    StackType::RegionType region = stack->GetLargestPossibleRegion();
    const std::size_t     frames = region.GetSize(2);
    region.SetSize(2, 0);
    for (std::size_t t = 0; t < frames; ++t)
    {
      region.SetIndex(2, static_cast<itk::IndexValueType>(t));
      frame->SetExtractionRegion(region);
      m_Names.push_back((m_Folder / (std::to_string(t) + ending)).string());
      writer->SetFileName(m_Names.back());
      writer->SetUseCompression(false);
      writer->Update();
    }
  }
  ~FrameFiles()
  {
    std::error_code error;
    fs::remove_all(m_Folder, error);
  }
  FrameFiles(const FrameFiles &) = delete;
  FrameFiles &
  operator=(const FrameFiles &) = delete;

  const std::vector<std::string> &
  Names() const
  {
    return m_Names;
  }

private:
  fs::path                 m_Folder;
  std::vector<std::string> m_Names;
};

void
FromFiles(benchmark::State & state, const char * what, const char * ending)
{
  const auto          stack = SimulateStack();
  const FrameFiles    files(stack, ending);
  std::vector<double> ratios;
  for (auto _ : state)
  {
    const double inMemory = SecondsTo(what, stack);
    const double seconds = SecondsOf([&] {
      auto source = itk::SensorNoiseFrameListSource<StackType>::New();
      source->SetFileNames(files.Names());
      source->SetNumberOfWorkUnits(Threads);
      SecondsTo(what, source->GetOutput());
    });
    state.SetIterationTime(seconds);
    ratios.push_back(seconds / inMemory);
  }
  SetRatios(state, "in_memory", ratios);
}

void
SetTimes(benchmark::internal::Benchmark * cases)
{
  cases->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(FromFiles, StatisticsTiff, "statistics", ".tif")->Apply(SetTimes);
BENCHMARK_CAPTURE(FromFiles, PublishedTiff, "published", ".tif")->Apply(SetTimes);
BENCHMARK_CAPTURE(FromFiles, RefinedTiff, "refined", ".tif")->Apply(SetTimes);
} // namespace
} // namespace sensornoise::benchmarks
