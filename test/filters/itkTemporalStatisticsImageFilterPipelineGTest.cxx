// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkTemporalStatisticsImageFilter.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/TemporalStatisticsTestHelper.h"
#include "itkCastImageFilter.h"
#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkImageSeriesReader.h"
#include "itkPipelineMonitorImageFilter.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::statistics;

/** Expects that every way to read \a image, in 1, 3 and T chunks, gives the same bits as the image itself. */
template <typename TMakeReader>
void
ExpectTheSameForAnyChunks(const StackType * stack, bool streams, const TMakeReader & makeReader)
{
  const auto expected = StatisticsOf(stack);
  expected->Update();
  for (const unsigned int chunks : { 1u, 3u, Frames })
  {
    const auto reader = makeReader();
    const auto monitor = itk::PipelineMonitorImageFilter<StackType>::New();
    monitor->SetInput(reader->GetOutput());
    const auto filter = StatisticsOf<StackType>(monitor->GetOutput());
    filter->SetNumberOfStreamDivisions(chunks);
    filter->Update();
    ExpectTheSameStatistics(filter, expected, std::to_string(chunks) + " chunks");
    EXPECT_TRUE(!streams || monitor->VerifyAllInputCanStream(static_cast<int>(chunks))) << chunks;
  }
}

std::vector<std::string>
FramesWrittenTo(const TemporaryFolder & folder, const StackType * stack, const std::string & extension)
{
  using SliceType = itk::Image<unsigned short, 2>;
  std::vector<std::string> names;
  for (unsigned int t = 0; t < Frames; ++t)
  {
    const auto slice = ImageOf<SliceType>({ { Width, Height } }, [&](const auto & index) {
      return stack->GetPixel({ { index[0], index[1], static_cast<itk::IndexValueType>(t) } });
    });
    names.push_back(WrittenTo<SliceType>(folder.File("f" + std::to_string(t) + extension), slice));
  }
  return names;
}

itk::ImageSeriesReader<StackType>::Pointer
SeriesReaderOf(const std::vector<std::string> & names)
{
  auto reader = itk::ImageSeriesReader<StackType>::New();
  reader->SetFileNames(names);
  reader->MetaDataDictionaryArrayUpdateOff();
  return reader;
}

template <typename TPixel>
class TemporalStatisticsImageFilterPipelineOf : public ::testing::Test
{};
TYPED_TEST_SUITE(TemporalStatisticsImageFilterPipelineOf, PixelTypes, );
} // namespace

TYPED_TEST(TemporalStatisticsImageFilterPipelineOf, SameBitsForAnyChunksAndWorkUnits)
{
  using Stack = itk::Image<TypeParam, 3>;
  const auto stack = TargetStack<Stack>(Width, Height, Frames);
  const auto expected = StatisticsOf<Stack>(stack);
  expected->Update();
  for (const unsigned int chunks : { 1u, 3u, Frames, Frames + 9 })
  {
    for (const unsigned int units : { 1u, 7u })
    {
      const auto filter = StatisticsOf<Stack>(stack);
      filter->SetNumberOfStreamDivisions(chunks);
      filter->SetNumberOfWorkUnits(units);
      filter->Update();
      ExpectTheSameStatistics(filter, expected, std::to_string(chunks) + " x " + std::to_string(units));
    }
  }
}

TEST(TemporalStatisticsImageFilterPipeline, ReadsTheStackOnceInTheChunksAskedFor)
{
  for (const unsigned int chunks : { 1u, 3u, Frames, Frames + 9 })
  {
    const auto source = TargetSource<StackType>(Width, Height, Frames);
    const auto monitor = itk::PipelineMonitorImageFilter<StackType>::New();
    monitor->SetInput(source->GetOutput());
    const auto filter = StatisticsOf<StackType>(monitor->GetOutput());
    filter->SetNumberOfStreamDivisions(chunks);
    filter->Update();
    EXPECT_TRUE(monitor->VerifyAllInputCanStream(static_cast<int>(std::min(chunks, Frames)))) << chunks;
  }
}

// 17 frames of 8 MiB in chunks of at most 32 MiB: 5 chunks.
TEST(TemporalStatisticsImageFilterPipeline, ChoosesTheNumberOfChunks)
{
  using BytesType = itk::Image<unsigned char, 3>;
  using DoubleStackType = itk::Image<double, 3>;
  const auto cast = itk::CastImageFilter<BytesType, DoubleStackType>::New();
  cast->SetInput(ConstantImage<BytesType>({ { 1024, 1024, 17 } }, 1));
  const auto monitor = itk::PipelineMonitorImageFilter<DoubleStackType>::New();
  monitor->SetInput(cast->GetOutput());
  const auto filter = StatisticsOf<DoubleStackType>(monitor->GetOutput());
  filter->Update();
  EXPECT_TRUE(monitor->VerifyAllInputCanStream(5));
}

TEST(TemporalStatisticsImageFilterPipeline, SecondUpdateDoesNoWorkAndAParameterDoes)
{
  const auto reader = StackReader<StackType>::Of(TargetStack<StackType>(Width, Height, Frames));
  const auto filter = StatisticsOf<StackType>(reader->GetOutput());
  filter->SetNumberOfStreamDivisions(Frames);
  filter->Update();
  EXPECT_EQ(reader->Reads(), Frames);
  filter->Update();
  filter->UpdateLargestPossibleRegion();
  filter->GetVariance()->Update();
  filter->GetValidMask()->Update();
  EXPECT_EQ(reader->Reads(), Frames);
  const auto clipped = [&] {
    filter->Update();
    return filter->GetSummary().clipped;
  };
  EXPECT_EQ(clipped(), 0u);
  filter->SetClipLow(500.0);
  EXPECT_GT(clipped(), 0u);
  EXPECT_EQ(reader->Reads(), 2 * Frames);
  filter->SetClipLow(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(clipped(), 0u);
  filter->SetBitDepth(16);
  filter->Update();
  EXPECT_EQ(filter->GetSummary().dnRange.clipHighDn, 65535.0);
  filter->SetBitDepth(0);
  filter->Update();
  EXPECT_EQ(filter->GetSummary().dnRange.clipHighDn, 4095.0);
}

TEST(TemporalStatisticsImageFilterPipeline, EveryStackFileGivesTheSameBits)
{
  const TemporaryFolder folder;
  const auto            stack = TargetStack<StackType>(Width, Height, Frames);
  for (const auto & [name, streams] : std::vector<std::pair<std::string, bool>>{
         { "s.mha", true }, { "s.mhd", true }, { "s.nrrd", false }, { "s.tif", false } })
  {
    SCOPED_TRACE(name);
    const std::string file = WrittenTo<StackType>(folder.File(name), stack);
    ExpectTheSameForAnyChunks(stack, streams, [&] {
      auto reader = itk::ImageFileReader<StackType>::New();
      reader->SetFileName(file);
      return reader;
    });
  }
}

TEST(TemporalStatisticsImageFilterPipeline, EveryListOfFilesGivesTheSameBits)
{
  const auto stack = TargetStack<StackType>(Width, Height, Frames);
  for (const char * extension : { ".tif", ".png" })
  {
    SCOPED_TRACE(extension);
    const TemporaryFolder          folder;
    const std::vector<std::string> names = FramesWrittenTo(folder, stack, extension);
    ExpectTheSameForAnyChunks(stack, true, [&] { return SeriesReaderOf(names); });
  }
}

TEST(TemporalStatisticsImageFilterPipeline, FailsUntilTheFilesAreMended)
{
  const TemporaryFolder folder;
  const auto            stack = TargetStack<StackType>(Width, Height, Frames);
  const auto            names = FramesWrittenTo(folder, stack, ".tif");
  const auto            smaller = ConstantImage<itk::Image<unsigned short, 2>>({ { Width, Height - 1 } }, 7);
  WrittenTo<itk::Image<unsigned short, 2>>(names[6], smaller);
  const auto reader = SeriesReaderOf(names);
  const auto filter = StatisticsOf<StackType>(reader->GetOutput());
  filter->SetNumberOfStreamDivisions(Frames);
  EXPECT_NE(ErrorOf(filter), "no error");
  EXPECT_NE(ErrorOf(filter), "no error");
  FramesWrittenTo(folder, stack, ".tif");
  reader->Modified();
  EXPECT_EQ(ErrorOf(filter), "no error");
  const auto expected = StatisticsOf<StackType>(stack);
  expected->Update();
  ExpectTheSameStatistics(filter, expected, "mended");
}

TEST(TemporalStatisticsImageFilterPipeline, FailsUntilTheFileIsThere)
{
  const TemporaryFolder folder;
  const auto            stack = TargetStack<StackType>(Width, Height, Frames);
  auto                  reader = itk::ImageFileReader<StackType>::New();
  reader->SetFileName(folder.File("later.mha"));
  const auto filter = StatisticsOf<StackType>(reader->GetOutput());
  EXPECT_SAYS(ErrorOf(filter), "later.mha");
  EXPECT_SAYS(ErrorOf(filter), "later.mha");
  WrittenTo<StackType>(folder.File("later.mha"), stack);
  EXPECT_EQ(ErrorOf(filter), "no error");
  const auto expected = StatisticsOf<StackType>(stack);
  expected->Update();
  ExpectTheSameStatistics(filter, expected, "there");
}

TEST(TemporalStatisticsImageFilterPipeline, AbortThrowsAndTheNextUpdateIsRight)
{
  const auto reader = StackReader<StackType>::Of(TargetStack<StackType>(Width, Height, Frames));
  const auto filter = StatisticsOf<StackType>(reader->GetOutput());
  filter->SetNumberOfStreamDivisions(Frames);
  const auto observer = filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    if (filter->GetProgress() > 0.5 && filter->GetProgress() < 0.9)
    {
      filter->AbortGenerateDataOn();
    }
  });
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  EXPECT_LT(reader->Reads(), Frames);
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  filter->RemoveObserver(observer);
  EXPECT_EQ(ErrorOf(filter), "no error");
  const auto expected = StatisticsOf<StackType>(TargetStack<StackType>(Width, Height, Frames));
  expected->Update();
  ExpectTheSameStatistics(filter, expected, "after an abort");
}

TEST(TemporalStatisticsImageFilterPipeline, AStackInMemoryIsAbortedWithinTheTimeOfAPiece)
{
  using LongStack = itk::Image<unsigned char, 3>;
  const auto stack = LongStack::New();
  stack->SetRegions(LongStack::SizeType{ { 2048, 2048, 160 } }); // 5 pieces of 128 MiB
  stack->Allocate();
  stack->FillBuffer(7);
  const auto filter = itk::TemporalStatisticsImageFilter<LongStack>::New();
  filter->SetInput(stack);
  std::vector<float> progress;
  const auto         observer = filter->AddObserver(
    itk::ProgressEvent(), [&](const itk::EventObject &) { progress.push_back(filter->GetProgress()); });
  filter->Update();
  EXPECT_GE(std::count_if(progress.begin(), progress.end(), [](float p) { return p > 0.1F && p < 0.9F; }), 2);
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  filter->RemoveObserver(observer);

  float reached = 0.0F;
  filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    reached = filter->GetProgress();
    filter->SetAbortGenerateData(reached > 0.1F);
  });
  filter->Modified();
  EXPECT_THROW(filter->Update(), itk::ProcessAborted);
  EXPECT_LT(reached, 0.5F);
}
