// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkNoiseCorrelationEstimator.h"
#include "itkPipelineMonitorImageFilter.h"
#include "itkTemporalStatisticsImageFilter.h"
#include "helpers/NoiseCorrelationTestHelper.h"
#include "helpers/PipelineTestHelper.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::correlation;
using ShortStack = itk::Image<unsigned short, 3>;

const Kernels Smooth{ { 0.5, 0.5 }, { 1.0 } };

ShortStack::Pointer
SmoothStack()
{
  static const ShortStack::Pointer stack = FlatStack<ShortStack>(Smooth);
  return stack;
}

template <typename TPixel>
class NoiseCorrelationEstimatorOf : public ::testing::Test
{};
using PixelTypes = ::testing::Types<unsigned char, unsigned short, short, float, double>;
TYPED_TEST_SUITE(NoiseCorrelationEstimatorOf, PixelTypes, );
} // namespace

TYPED_TEST(NoiseCorrelationEstimatorOf, SameBitsForAnyChunksAndWorkUnits)
{
  using Stack = itk::Image<TypeParam, 3>;
  const auto stack = FlatStack<Stack>(Smooth);
  const auto json = JsonOf(CorrelationOf<Stack>(stack));
  for (const unsigned int chunks : { 1u, 3u, Frames })
  {
    for (const unsigned int units : { 1u, 7u })
    {
      const auto estimator = CorrelationOf<Stack>(stack);
      estimator->SetNumberOfStreamDivisions(chunks);
      estimator->SetNumberOfWorkUnits(units);
      EXPECT_EQ(JsonOf(estimator), json) << chunks << " x " << units;
    }
  }
}

TEST(NoiseCorrelationEstimatorPipeline, ReadsTheStackOnceIfMeanAndMaskAreGiven)
{
  const auto statistics = itk::TemporalStatisticsImageFilter<ShortStack>::New();
  statistics->SetInput(SmoothStack());
  statistics->Update();
  for (const bool isGiven : { false, true })
  {
    for (const unsigned int chunks : { 1u, 3u, Frames, Frames + 9 })
    {
      const auto source = TargetSource<ShortStack>(Width, Height, Frames);
      const auto monitor = itk::PipelineMonitorImageFilter<ShortStack>::New();
      monitor->SetInput(source->GetOutput());
      const auto estimator = CorrelationOf<ShortStack>(monitor->GetOutput());
      estimator->SetNumberOfStreamDivisions(chunks);
      if (isGiven)
      {
        estimator->SetMean(statistics->GetMean());
        estimator->SetMask(statistics->GetValidMask());
      }
      estimator->Update();
      // A single chunk is read once, because it is still in memory in the next pass.
      const unsigned int parts = std::min(chunks, Frames);
      EXPECT_TRUE(monitor->VerifyAllInputCanStream(static_cast<int>(parts == 1 || isGiven ? parts : 2 * parts)))
        << isGiven << chunks;
    }
  }
}

TEST(NoiseCorrelationEstimatorPipeline, OneReaderFeedsTheChain)
{
  const auto json = JsonOf(CorrelationOf<ShortStack>(SmoothStack()));
  const auto reader = StackReader<ShortStack>::Of(SmoothStack());
  const auto statistics = itk::TemporalStatisticsImageFilter<ShortStack>::New();
  statistics->SetInput(reader->GetOutput());
  statistics->SetNumberOfStreamDivisions(4);
  for (const unsigned int chunks : { 1u, 3u })
  {
    for (const bool hasMask : { true, false })
    {
      const auto estimator = CorrelationOf<ShortStack>(reader->GetOutput());
      estimator->SetMean(statistics->GetMean());
      estimator->SetMask(hasMask ? statistics->GetValidMask() : nullptr);
      estimator->SetNumberOfStreamDivisions(chunks);
      EXPECT_EQ(JsonOf(estimator), json);
      reader->Modified();
      EXPECT_EQ(JsonOf(estimator), json);
    }
  }
}

TEST(NoiseCorrelationEstimatorPipeline, SecondUpdateDoesNoWorkAndEveryParameterDoes)
{
  const auto   estimator = CorrelationOf<ShortStack>(SmoothStack());
  unsigned int runs = 0;
  estimator->AddObserver(itk::EndEvent(), [&runs](const itk::EventObject &) { ++runs; });
  const auto hasRun = [&] {
    const unsigned int before = runs;
    estimator->Update();
    return runs == before + 1;
  };
  EXPECT_TRUE(hasRun());
  EXPECT_FALSE(hasRun());
  estimator->GetResultOutput()->Update();
  estimator->UpdateLargestPossibleRegion();
  EXPECT_EQ(runs, 1u);
  const auto json = JsonOf(estimator);
  estimator->ClearSeries();
  EXPECT_FALSE(hasRun());
  estimator->AddSeries(std::vector<double>(Frames, 1.0));
  EXPECT_TRUE(hasRun());
  EXPECT_EQ(JsonOf(estimator), json); // the constant is subtracted anyway
  estimator->ClearSeries();
  EXPECT_TRUE(hasRun());
  estimator->RemoveFrameMeansOff();
  EXPECT_TRUE(hasRun());
  EXPECT_NE(JsonOf(estimator), json);
  estimator->RemoveFrameMeansOn();
  EXPECT_TRUE(hasRun());
  EXPECT_EQ(JsonOf(estimator), json);
  estimator->SetOffset(40.0);
  EXPECT_TRUE(hasRun());
  EXPECT_NEAR(estimator->GetResult().lights.front().lightDn, Level - 40.0, 2.0);
  estimator->SetQuantisationStep(2.0);
  EXPECT_TRUE(hasRun());
  estimator->SetMask(ConstantImage<MaskType>({ { Width, Height } }, 1.0));
  EXPECT_TRUE(hasRun());
  estimator->SetMean(ConstantImage<FrameType>({ { Width, Height } }, Level));
  EXPECT_TRUE(hasRun());
  EXPECT_FALSE(hasRun());
}

TEST(NoiseCorrelationEstimatorPipeline, WrongInputsAreNamed)
{
  const auto of = [] { return CorrelationOf<ShortStack>(SmoothStack()); };
  auto       estimator = of();
  estimator->SetMean(ConstantImage<FrameType>({ { Width, Height + 1 } }, Level));
  EXPECT_SAYS(ErrorOf(estimator), "the mean has the region");
  estimator = of();
  estimator->SetMask(ConstantImage<MaskType>({ { Width - 1, Height } }, 1.0));
  EXPECT_SAYS(ErrorOf(estimator), "the mask has the region");
  estimator = of();
  estimator->AddSeries(std::vector<double>(Frames, 1.0));
  estimator->AddSeries(std::vector<double>(Frames - 1, 1.0));
  EXPECT_SAYS(ErrorOf(estimator), "series 1 has 29 values, but the stack has 30 frames");
  EXPECT_SAYS(ErrorOf(estimator), "series 1 has 29 values");
  estimator->ClearSeries();
  EXPECT_EQ(ErrorOf(estimator), "no error");
  estimator->AddSeries(std::vector<double>(Frames, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_SAYS(ErrorOf(estimator), "series 0 holds a value that is not finite");
  estimator = of();
  estimator->SetQuantisationStep(-1.0);
  EXPECT_SAYS(ErrorOf(estimator), "the quantization step is -1 DN");
  estimator = of();
  estimator->SetOffset(std::numeric_limits<double>::infinity());
  EXPECT_SAYS(ErrorOf(estimator), "the offset is infinite");
}

TEST(NoiseCorrelationEstimatorPipeline, FailsUntilTheReaderIsMended)
{
  const auto json = JsonOf(CorrelationOf<ShortStack>(SmoothStack()));
  const auto reader = StackReader<ShortStack>::Of(SmoothStack());
  const auto estimator = CorrelationOf<ShortStack>(reader->GetOutput());
  estimator->SetNumberOfStreamDivisions(Frames);
  reader->Break(20);
  EXPECT_SAYS(ErrorOf(estimator), "frame 20 is broken");
  EXPECT_SAYS(ErrorOf(estimator), "frame 20 is broken");
  reader->Mend();
  EXPECT_EQ(JsonOf(estimator), json);
}
