// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkVibrationMaskImageFilter.h"
#include "helpers/PipelineTestHelper.h"
#include "published/PublishedScene.h"
#include "itkCastImageFilter.h"
#include "itkPipelineMonitorImageFilter.h"
#include "itkStreamingImageFilter.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace
{
using namespace sensornoisetest;
using FilterType = itk::VibrationMaskImageFilter<>;
constexpr unsigned int Width = 29;
constexpr unsigned int Height = 23;
constexpr unsigned int Frames = 25;

/** Random maps of mean, variance and valid pixels. The filter keeps about half of the pixels. */
struct Maps
{
  explicit Maps(const FrameType::IndexType & start = FrameType::IndexType{ {} })
  {
    std::mt19937_64                        random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const FrameType::SizeType              size{ { Width, Height } };
    mean = ImageOf<FrameType>(size, [&](const auto &) { return 1000.0 + uniform(random); }, start);
    variance = ImageOf<FrameType>(size, [&](const auto &) { return 1.5 * uniform(random); }, start);
    valid = ImageOf<MaskType>(size, [&](const auto &) { return uniform(random) < 0.9 ? 1 : 0; }, start);
    mean->GetBufferPointer()[10 * Width + 10] = std::numeric_limits<double>::quiet_NaN();
    variance->GetBufferPointer()[12 * Width + 4] = 0.0;
  }
  std::vector<unsigned char>
  Expected(double level = 0.01) const
  {
    return sensornoise::VibrationMask(
      mean->GetBufferPointer(), variance->GetBufferPointer(), valid->GetBufferPointer(), Width, Height, Frames, level);
  }
  FilterType::Pointer
  Filter() const
  {
    auto filter = FilterType::New();
    filter->SetInput(mean);
    filter->SetVariance(variance);
    filter->SetValidMask(valid);
    filter->SetNumberOfFrames(Frames);
    return filter;
  }
  FrameType::Pointer mean;
  FrameType::Pointer variance;
  MaskType::Pointer  valid;
};
} // namespace

// On a slope s the statistic is 2 T s^2 / V everywhere; -2 ln(0.01) = 9.2103 is the limit.
TEST(VibrationMaskImageFilter, SlopeIsKeptUpToTheQuantile)
{
  constexpr double slope = 0.3;
  for (const double statistic : { 9.21, 9.2104 })
  {
    const auto filter = FilterType::New();
    filter->SetInput(
      ImageOf<FrameType>({ { 6, 5 } }, [](const auto & index) { return slope * static_cast<double>(index[0]); }));
    filter->SetVariance(ConstantImage<FrameType>({ { 6, 5 } }, 2.0 * Frames * slope * slope / statistic));
    filter->SetNumberOfFrames(Frames);
    filter->Update();
    const auto expected = ImageOf<MaskType>({ { 6, 5 } }, [&](const auto & index) {
      const bool isInside = index[0] > 0 && index[0] < 5 && index[1] > 0 && index[1] < 4;
      return isInside && statistic < 9.2103 ? 1 : 0;
    });
    EXPECT_EQ(PixelsOf(filter->GetOutput()), PixelsOf<MaskType>(expected)) << statistic;
  }
}

TEST(VibrationMaskImageFilter, EqualsTheMaskOfTheModule)
{
  const Maps maps;
  for (const unsigned int units : { 1u, 7u })
  {
    for (const double level : { 0.5, 0.01, 1e-6 })
    {
      const auto filter = maps.Filter();
      filter->SetLevel(level);
      filter->SetNumberOfWorkUnits(units);
      filter->Update();
      EXPECT_EQ(PixelsOf(filter->GetOutput()), maps.Expected(level)) << level;
    }
  }
  const auto expected = maps.Expected();
  EXPECT_GT(std::count(expected.begin(), expected.end(), 1), 100);
  EXPECT_GT(std::count(expected.begin(), expected.end(), 0), 250);
}

TEST(VibrationMaskImageFilter, ValidMaskIsOptional)
{
  Maps       maps;
  const auto filter = maps.Filter();
  filter->SetValidMask(nullptr);
  filter->Update();
  maps.valid->FillBuffer(1);
  EXPECT_EQ(PixelsOf(filter->GetOutput()), maps.Expected());
}

TEST(VibrationMaskImageFilter, StartIndexAndSpacingDoNotMatter)
{
  const Maps             maps(FrameType::IndexType{ { -5, 40 } });
  FrameType::SpacingType spacing;
  spacing.Fill(0.01);
  maps.mean->SetSpacing(spacing);
  const auto filter = maps.Filter();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetLargestPossibleRegion(), maps.mean->GetLargestPossibleRegion());
  EXPECT_EQ(filter->GetOutput()->GetSpacing()[0], 0.01);
  EXPECT_EQ(PixelsOf(filter->GetOutput()), Maps().Expected());
}

TEST(VibrationMaskImageFilter, StreamsWithTheSameBitsForAnyChunks)
{
  using CastType = itk::CastImageFilter<FrameType, FrameType>;
  const Maps maps(FrameType::IndexType{ { 3, -2 } });
  for (const unsigned int chunks : { 1u, 3u, Height })
  {
    const auto mean = CastType::New();
    mean->SetInput(maps.mean);
    mean->InPlaceOff();
    const auto variance = CastType::New();
    variance->SetInput(maps.variance);
    variance->InPlaceOff();
    const auto monitor = itk::PipelineMonitorImageFilter<FrameType>::New();
    monitor->SetInput(variance->GetOutput());
    const auto filter = maps.Filter();
    filter->SetInput(mean->GetOutput());
    filter->SetVariance(monitor->GetOutput());
    const auto streamer = itk::StreamingImageFilter<MaskType, MaskType>::New();
    streamer->SetInput(filter->GetOutput());
    streamer->SetNumberOfStreamDivisions(chunks);
    streamer->Update();
    // A filter of several inputs propagates the region once for each, which VerifyAllInputCanStream() does not expect.
    EXPECT_TRUE(monitor->VerifyInputFilterExecutedStreaming(static_cast<int>(chunks))) << chunks;
    for (const auto & region : monitor->GetUpdatedBufferedRegions())
    {
      EXPECT_LE(region.GetSize(1), Height / chunks + 1);
    }
    EXPECT_EQ(PixelsOf(streamer->GetOutput()), maps.Expected()) << chunks;
  }
}

TEST(VibrationMaskImageFilter, AnyRegionIsThatPartOfTheWhole)
{
  const Maps maps;
  const auto expected = maps.Expected();
  for (const MaskType::RegionType & region : { MaskType::RegionType({ { 0, 0 } }, { { 1, 1 } }),
                                               MaskType::RegionType({ { 5, 3 } }, { { 9, 12 } }),
                                               MaskType::RegionType({ { 20, 20 } }, { { 9, 3 } }) })
  {
    const auto cast = itk::CastImageFilter<FrameType, FrameType>::New();
    cast->SetInput(maps.mean);
    cast->InPlaceOff();
    const auto filter = maps.Filter();
    filter->SetInput(cast->GetOutput());
    filter->GetOutput()->SetRequestedRegion(region);
    filter->GetOutput()->Update();
    EXPECT_EQ(filter->GetOutput()->GetBufferedRegion(), region);
    for (itk::ImageRegionIteratorWithIndex<MaskType> it(filter->GetOutput(), region); !it.IsAtEnd(); ++it)
    {
      const auto index = it.GetIndex();
      EXPECT_EQ(it.Get(), expected[static_cast<std::size_t>(index[1] * Width + index[0])]) << index;
    }
  }
}

TEST(VibrationMaskImageFilter, WrongUseIsRefusedWithTheNumbers)
{
  const Maps maps;
  const auto filter = maps.Filter();
  filter->SetNumberOfFrames(0);
  EXPECT_SAYS(ErrorOf(filter), "NumberOfFrames is 0; expected the number of frames, at least 2");
  filter->SetNumberOfFrames(Frames);
  for (const double level : { 0.0, 1.0, -1.0, std::numeric_limits<double>::quiet_NaN() })
  {
    filter->SetLevel(level);
    EXPECT_SAYS(ErrorOf(filter), "expected a probability between 0 and 1");
  }
  filter->SetLevel(0.01);
  filter->SetVariance(ConstantImage<FrameType>({ { Width + 1, Height } }, 1.0));
  EXPECT_SAYS(ErrorOf(filter), "the variance has the region");
  EXPECT_SAYS(ErrorOf(filter), "[30, 23]");
  filter->SetVariance(maps.variance);
  filter->SetValidMask(ConstantImage<MaskType>({ { Width, Height - 1 } }, 1));
  EXPECT_SAYS(ErrorOf(filter), "the valid mask has the region");
  filter->SetValidMask(maps.valid);
  EXPECT_EQ(ErrorOf(filter), "no error");
  EXPECT_EQ(PixelsOf(filter->GetOutput()), maps.Expected());
  filter->SetVariance(nullptr);
  EXPECT_SAYS(ErrorOf(filter), "Input Variance is required but not set");
  EXPECT_SAYS(ErrorOf(FilterType::New()), "is required but not set");
}

TEST(VibrationMaskImageFilter, ParametersReExecuteAndNothingElseDoes)
{
  const Maps   maps;
  const auto   filter = maps.Filter();
  unsigned int runs = 0;
  filter->AddObserver(itk::EndEvent(), [&runs](const itk::EventObject &) { ++runs; });
  filter->Update();
  filter->Update();
  EXPECT_EQ(runs, 1u);
  filter->SetLevel(0.05);
  filter->Update();
  EXPECT_EQ(runs, 2u);
  EXPECT_EQ(PixelsOf(filter->GetOutput()), maps.Expected(0.05));
}
