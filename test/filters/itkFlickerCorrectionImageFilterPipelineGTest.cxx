// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Settings.h"
#include "itkFlickerCorrectionImageFilter.h"
#include "helpers/FlickerCorrectionTestHelper.h"
#include "helpers/PipelineTestHelper.h"
#include "itkCastImageFilter.h"
#include "itkImageFileReader.h"
#include "itkPipelineMonitorImageFilter.h"
#include "itkStreamingImageFilter.h"
#include "itkTemporalStatisticsImageFilter.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::flicker;
using RollingShutter = sensornoise::RollingShutter;

/** Returns the corrected stack, pulled in \a chunks chunks. */
template <typename TFilter>
std::vector<double>
CorrectedInChunks(const TFilter & filter, unsigned int chunks)
{
  const auto streamer = itk::StreamingImageFilter<DoubleStackType, DoubleStackType>::New();
  streamer->SetInput(filter->GetOutput());
  streamer->SetNumberOfStreamDivisions(chunks);
  streamer->Update();
  return PixelsOf(streamer->GetOutput());
}
} // namespace

TEST(FlickerCorrectionImageFilterPipeline, SameBitsForAnyChunksAndWorkUnits)
{
  for (const RollingShutter mode : { RollingShutter::Off, RollingShutter::Fixed })
  {
    Chain whole(SimulatedStack().GetPointer());
    whole.filter->SetRollingShutter(mode);
    whole.filter->Update();
    const auto expected = PixelsOf(whole.filter->GetOutput());
    for (const unsigned int chunks : { 1u, 3u, Frames })
    {
      for (const unsigned int units : { 1u, 7u })
      {
        const auto reader = StackReader<StackType>::Of(SimulatedStack());
        Chain      chain(reader->GetOutput());
        chain.statistics->SetNumberOfStreamDivisions(chunks);
        chain.filter->SetRollingShutter(mode);
        chain.filter->SetNumberOfWorkUnits(units);
        EXPECT_TRUE(HaveTheSameBits(CorrectedInChunks(chain.filter, chunks), expected)) << chunks << " x " << units;
      }
    }
  }
}

TEST(FlickerCorrectionImageFilterPipeline, StreamsAndMakesNoMoreThanWasAskedFor)
{
  const TemporaryFolder folder;
  auto                  reader = itk::ImageFileReader<StackType>::New();
  reader->SetFileName(WrittenTo<StackType>(folder.File("s.mha"), SimulatedStack()));
  Chain      chain(reader->GetOutput());
  const auto monitor = itk::PipelineMonitorImageFilter<DoubleStackType>::New();
  monitor->SetInput(chain.filter->GetOutput());
  const auto statistics = itk::TemporalStatisticsImageFilter<DoubleStackType>::New();
  statistics->SetInput(monitor->GetOutput());
  statistics->SetNumberOfStreamDivisions(5);
  statistics->Update();
  EXPECT_TRUE(monitor->VerifyAllInputCanStream(5));
}

TEST(FlickerCorrectionImageFilterPipeline, EveryStackFileGivesTheSameBits)
{
  const TemporaryFolder folder;
  Chain                 expected(SimulatedStack().GetPointer());
  expected.filter->Update();
  for (const char * name : { "s.mha", "s.nrrd", "s.tif" })
  {
    auto reader = itk::ImageFileReader<StackType>::New();
    reader->SetFileName(WrittenTo<StackType>(folder.File(name), SimulatedStack()));
    Chain chain(reader->GetOutput());
    chain.statistics->SetNumberOfStreamDivisions(4);
    EXPECT_TRUE(HaveTheSameBits(CorrectedInChunks(chain.filter, 3), PixelsOf(expected.filter->GetOutput()))) << name;
  }
}

// 10 frames of 8 MiB: the pass for the flicker takes chunks of 4, 4 and 2 frames.
TEST(FlickerCorrectionImageFilterPipeline, LargeStackIsLookedAtInChunks)
{
  const auto tile = TargetStack<StackType>(64, 64, 10);
  const auto stack = ImageOf<StackType>({ { 1024, 1024, 10 } }, [&](const auto & index) {
    return tile->GetPixel(StackType::IndexType{ { index[0] % 64, index[1] % 64, index[2] } });
  });
  Chain      whole(stack.GetPointer(), 10);
  const auto cast = itk::CastImageFilter<StackType, DoubleStackType>::New();
  cast->SetInput(stack);
  std::vector<itk::SizeValueType> chunks;
  cast->AddObserver(itk::EndEvent(), [&](const itk::EventObject &) {
    chunks.push_back(cast->GetOutput()->GetBufferedRegion().GetSize(2));
  });
  const auto filter = itk::FlickerCorrectionImageFilter<DoubleStackType>::New();
  filter->SetInput(cast->GetOutput());
  filter->SetMean(whole.statistics->GetMean());
  filter->SetVariance(whole.statistics->GetVariance());
  filter->SetMask(whole.mask->GetOutput());
  filter->GetOffsetOutput()->Update();
  EXPECT_EQ(chunks, (std::vector<itk::SizeValueType>{ 1, 4, 4, 2, 1 }));
  whole.filter->GetOffsetOutput()->Update();
  EXPECT_EQ(filter->GetFlicker().gamma, whole.filter->GetFlicker().gamma);
  EXPECT_EQ(filter->GetFlicker().offsetDn, whole.filter->GetFlicker().offsetDn);
}

// Whoever asks for the offset first, before any frame, must not have the corrected stack made whole.
TEST(FlickerCorrectionImageFilterPipeline, OffsetAloneMakesOneFrame)
{
  const auto         reader = StackReader<StackType>::Of(SimulatedStack());
  Chain              chain(reader->GetOutput());
  itk::SizeValueType most = 0;
  chain.filter->AddObserver(itk::EndEvent(), [&](const itk::EventObject &) {
    most = std::max(most, chain.filter->GetOutput()->GetBufferedRegion().GetSize(2));
  });
  chain.filter->GetOffsetOutput()->Update();
  EXPECT_EQ(most, 1u);
  Chain whole(SimulatedStack().GetPointer());
  whole.filter->Update();
  EXPECT_EQ(chain.filter->GetOffset(), whole.filter->GetOffset());
  EXPECT_TRUE(HaveTheSameBits(CorrectedInChunks(chain.filter, 5), PixelsOf(whole.filter->GetOutput())));
  EXPECT_EQ(most, 5u);
  chain.filter->UpdateLargestPossibleRegion();
  EXPECT_TRUE(HaveTheSameBits<DoubleStackType>(chain.filter->GetOutput(), whole.filter->GetOutput()));
}

// The reader's frames are released after use, so that each look at the whole stack is one estimate.
TEST(FlickerCorrectionImageFilterPipeline, EstimateIsKeptUntilSomethingChanges)
{
  Chain whole(SimulatedStack().GetPointer());
  whole.mask->Update();
  const auto reader = StackReader<StackType>::Of(SimulatedStack());
  reader->GetOutput()->ReleaseDataFlagOn();
  const auto filter = itk::FlickerCorrectionImageFilter<StackType>::New();
  filter->SetInput(reader->GetOutput());
  filter->SetMean(whole.statistics->GetMean());
  filter->SetVariance(whole.statistics->GetVariance());
  filter->SetMask(whole.mask->GetOutput());
  const auto estimatesOfAnUpdate = [&] {
    const unsigned int before = reader->WholeReads();
    CorrectedInChunks(filter, 5);
    return reader->WholeReads() - before;
  };
  EXPECT_EQ(estimatesOfAnUpdate(), 1u);
  EXPECT_EQ(reader->Reads(), 6u);
  EXPECT_EQ(estimatesOfAnUpdate(), 0u);
  EXPECT_EQ(reader->Reads(), 11u);
  filter->SetDarkQuantile(0.02);
  EXPECT_EQ(estimatesOfAnUpdate(), 1u);
  EXPECT_EQ(estimatesOfAnUpdate(), 0u);
  filter->SetRollingShutter(RollingShutter::Off);
  EXPECT_EQ(estimatesOfAnUpdate(), 1u);
  whole.mask->SetLevel(0.02);
  EXPECT_EQ(estimatesOfAnUpdate(), 1u);
  reader->Modified();
  EXPECT_EQ(estimatesOfAnUpdate(), 1u);
  EXPECT_EQ(estimatesOfAnUpdate(), 0u);
  filter->SetDarkQuantile(0.01);
  filter->SetRollingShutter(RollingShutter::Auto);
  whole.mask->SetLevel(0.01);
  whole.filter->Update();
  EXPECT_TRUE(HaveTheSameBits(CorrectedInChunks(filter, 5), PixelsOf(whole.filter->GetOutput())));
}

TEST(FlickerCorrectionImageFilterPipeline, SecondUpdateDoesNoWork)
{
  const auto   reader = StackReader<StackType>::Of(SimulatedStack());
  Chain        chain(reader->GetOutput());
  unsigned int runs = 0;
  chain.filter->AddObserver(itk::EndEvent(), [&runs](const itk::EventObject &) { ++runs; });
  chain.filter->Update();
  const unsigned int reads = reader->Reads();
  chain.filter->Update();
  chain.filter->GetOffsetOutput()->Update();
  EXPECT_EQ(runs, 1u);
  EXPECT_EQ(reader->Reads(), reads);
}

TEST(FlickerCorrectionImageFilterPipeline, FailsUntilTheReaderIsMended)
{
  const auto reader = StackReader<StackType>::Of(SimulatedStack());
  Chain      chain(reader->GetOutput());
  chain.statistics->SetNumberOfStreamDivisions(5);
  reader->Break(17);
  EXPECT_SAYS(ErrorOf(chain.filter), "frame 17 is broken");
  EXPECT_SAYS(ErrorOf(chain.filter), "frame 17 is broken");
  EXPECT_SAYS(ErrorWhen([&] { chain.filter->GetOffsetOutput()->Update(); }), "frame 17 is broken");
  reader->Mend();
  EXPECT_EQ(ErrorOf(chain.filter), "no error");
  Chain expected(SimulatedStack().GetPointer());
  expected.filter->Update();
  EXPECT_TRUE(HaveTheSameBits<DoubleStackType>(chain.filter->GetOutput(), expected.filter->GetOutput()));
}
