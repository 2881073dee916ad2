// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"
#include "itkSensorNoiseEstimator.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"
#include "itkImage.h"
#include "itkPipelineMonitorImageFilter.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::estimator;
using RollingShutter = sensornoise::RollingShutter;

template <typename TPixel>
class SensorNoiseEstimatorPipelineOf : public ::testing::Test
{};
TYPED_TEST_SUITE(SensorNoiseEstimatorPipelineOf, PixelTypes, );
} // namespace

TYPED_TEST(SensorNoiseEstimatorPipelineOf, SameBitsForAnyChunksAndWorkUnits)
{
  using Stack = itk::Image<TypeParam, 3>;
  const auto stack = TargetStack<Stack>(Width, Height, Frames);
  const auto expected = EstimatorOf<Stack>(stack);
  const auto json = JsonOf(expected);
  for (const unsigned int chunks : { 1u, 3u, Frames })
  {
    for (const unsigned int units : { 1u, 7u })
    {
      const auto estimator = EstimatorOf<Stack>(stack);
      estimator->SetNumberOfStreamDivisions(chunks);
      estimator->SetNumberOfWorkUnits(units);
      EXPECT_EQ(JsonOf(estimator), json) << chunks << " x " << units;
      ExpectTheSameMaps(estimator, expected);
    }
  }
}

TEST(SensorNoiseEstimatorPipeline, ReadsTheStackInPassesTimesChunks)
{
  for (const unsigned int chunks : { 1u, 3u, Frames, Frames + 9 })
  {
    const auto source = TargetSource<StackType>(Width, Height, Frames);
    const auto monitor = itk::PipelineMonitorImageFilter<StackType>::New();
    monitor->SetInput(source->GetOutput());
    const auto estimator = EstimatorOf<StackType>(monitor->GetOutput());
    estimator->SetNumberOfStreamDivisions(chunks);
    estimator->Update();
    // One chunk is read once: it is still there in the next pass.
    const unsigned int parts = std::min(chunks, Frames);
    EXPECT_TRUE(monitor->VerifyAllInputCanStream(static_cast<int>(parts == 1 ? 1 : 3 * parts))) << chunks;
  }
}

TEST(SensorNoiseEstimatorPipeline, SecondUpdateDoesNoWorkAndEveryParameterDoes)
{
  const auto   estimator = EstimatorOf<StackType>(SimulatedStack(), "published");
  unsigned int runs = 0;
  estimator->AddObserver(itk::EndEvent(), [&runs](const itk::EventObject &) { ++runs; });
  const auto hasRun = [&] {
    const unsigned int before = runs;
    estimator->Update();
    return runs == before + 1;
  };
  EXPECT_TRUE(hasRun());
  EXPECT_FALSE(hasRun());
  estimator->GetPixelUse()->Update();
  estimator->UpdateLargestPossibleRegion();
  EXPECT_EQ(runs, 1u);
  const auto json = JsonOf(estimator);
  estimator->SetLevel(0.05);
  EXPECT_TRUE(hasRun());
  EXPECT_NE(JsonOf(estimator), json);
  estimator->SetLevel(0.01);
  EXPECT_TRUE(hasRun());
  EXPECT_EQ(JsonOf(estimator), json);
  estimator->SetBrightQuantile(0.95);
  EXPECT_TRUE(hasRun());
  estimator->SetDarkQuantile(0.05);
  EXPECT_TRUE(hasRun());
  estimator->SetRollingShutter(RollingShutter::Fixed);
  EXPECT_TRUE(hasRun());
  estimator->SetSigmaRows(20.0);
  EXPECT_TRUE(hasRun());
  estimator->SetShutterAxis(0);
  EXPECT_TRUE(hasRun());
  estimator->SetBitDepth(14);
  EXPECT_TRUE(hasRun());
  EXPECT_EQ(estimator->GetReport().clipHighDn, 16383.0);
  estimator->SetClipLow(110.0);
  EXPECT_TRUE(hasRun());
  estimator->SetClipHigh(3000.0);
  EXPECT_TRUE(hasRun());
  EXPECT_EQ(estimator->GetReport().clipHighDn, 3000.0);
  estimator->SetQuantisationStep(1.0);
  EXPECT_TRUE(hasRun());
  EXPECT_FALSE(hasRun());
  const auto report = estimator->GetReport();
  estimator->SetMethod("refined");
  EXPECT_TRUE(hasRun());
  EXPECT_EQ(estimator->GetReport().method, "refined");
  estimator->SetOffset(100.0);
  EXPECT_TRUE(hasRun());
  estimator->SetOffsetStandardError(0.5);
  EXPECT_TRUE(hasRun());
  EXPECT_EQ(estimator->GetReport().offset.value, 100.0);
  EXPECT_EQ(estimator->GetReport().offset.standardError, 0.5);
  using Setting = std::pair<std::string, sensornoise::Report::SettingValue>;
  const auto & settings = report.settings;
  for (const Setting & expected : { Setting("bright_quantile", 0.95),
                                    Setting("dark_quantile", 0.05),
                                    Setting("rolling_shutter", std::string("fixed")),
                                    Setting("shutter_axis", std::string("x")) })
  {
    EXPECT_EQ(std::count(settings.begin(), settings.end(), expected), 1) << expected.first;
  }
}

TEST(SensorNoiseEstimatorPipeline, ImagesThatWereNotAllocatedAreRefused)
{
  const auto stack = StackType::New();
  stack->SetRegions(SimulatedStack()->GetLargestPossibleRegion());
  for (const std::string method : { "refined", "published" })
  {
    for (const std::string pattern : { "none", "auto", "RGGB" })
    {
      const auto estimator = EstimatorOf<StackType>(stack, method);
      estimator->SetBayerPattern(pattern);
      EXPECT_SAYS(ErrorOf(estimator), "the stack has a size but no pixels");
    }
  }
  const auto ofDark = EstimatorOf<StackType>(SimulatedStack());
  ofDark->SetDark(stack);
  EXPECT_SAYS(ErrorOf(ofDark), "the stack has a size but no pixels");
  const auto mask = itk::SensorNoiseEstimator<StackType>::MaskImageType::New();
  mask->SetRegions(itk::Size<2>{ { Width, Height } });
  const auto ofMask = EstimatorOf<StackType>(SimulatedStack());
  ofMask->SetMask(mask);
  EXPECT_SAYS(ErrorOf(ofMask), "the mask has a size but no pixels");
}

TEST(SensorNoiseEstimatorPipeline, FailsUntilTheReaderIsMended)
{
  const auto expected = EstimatorOf<StackType>(SimulatedStack());
  const auto json = JsonOf(expected);
  const auto reader = StackReader<StackType>::Of(SimulatedStack());
  const auto estimator = EstimatorOf<StackType>(reader->GetOutput());
  estimator->SetNumberOfStreamDivisions(Frames);
  reader->Break(20);
  EXPECT_SAYS(ErrorOf(estimator), "frame 20 is broken");
  EXPECT_SAYS(ErrorOf(estimator), "frame 20 is broken");
  reader->Mend();
  EXPECT_EQ(JsonOf(estimator), json);
  ExpectTheSameMaps(estimator, expected);
}

TEST(SensorNoiseEstimatorPipeline, AbortThrowsAndTheNextUpdateIsRight)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->SetNumberOfStreamDivisions(5);
  const auto observer = estimator->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    if (estimator->GetProgress() > 0.5 && estimator->GetProgress() < 0.9)
    {
      estimator->AbortGenerateDataOn();
    }
  });
  EXPECT_THROW(estimator->Update(), itk::ProcessAborted);
  EXPECT_THROW(estimator->Update(), itk::ProcessAborted);
  estimator->RemoveObserver(observer);
  EXPECT_EQ(JsonOf(estimator), JsonOf(EstimatorOf<StackType>(SimulatedStack())));
}
