// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"
#include "sensornoise/Simulator.h"
#include "itkSensorNoiseEstimator.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"
#include "itkFlickerCorrectionImageFilter.h"
#include "itkImage.h"
#include "itkImageFileReader.h"
#include "itkNoiseRegressionEstimator.h"
#include "itkSensorNoiseStackSource.h"
#include "itkTemporalStatisticsImageFilter.h"
#include "itkVibrationMaskImageFilter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <initializer_list>
#include <tuple>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::estimator;
using DoubleStackType = itk::Image<double, 3>;
using RollingShutter = sensornoise::RollingShutter;
using sensornoise::EstimateStatus;

/** Returns a stack of bars under a rolling shutter: each row holds every level, and its own flicker. */
StackType::Pointer
RollingShutterStack()
{
  const auto scene = sensornoise::MakeBarsScene(96, 60);
  auto       source = itk::SensorNoiseStackSource<StackType>::New();
  source->SetReference(ImageOf<FrameType>(
    { { 96, 60 } }, [&](const auto & index) { return scene[static_cast<std::size_t>(index[1] * 96 + index[0])]; }));
  source->SetNumberOfFrames(40);
  source->SetOpticalBlur(0.0);
  source->SetVibrationSdX(0.0);
  source->SetVibrationSdY(0.0);
  source->SetRollingShutterPeriod(60.0);
  StackType::Pointer stack = source->GetOutput();
  source->Update();
  stack->DisconnectPipeline();
  return stack;
}

/** Figure 2 by hand, filter by filter, from one source. */
struct Chain
{
  Chain(StackType * stack, itk::SizeValueType frames, RollingShutter mode)
  {
    statistics->SetInput(stack);
    statistics->SetNumberOfStreamDivisions(3);
    mask->SetInput(statistics->GetMean());
    mask->SetVariance(statistics->GetVariance());
    mask->SetValidMask(statistics->GetValidMask());
    mask->SetNumberOfFrames(frames);
    flicker->SetInput(stack);
    flicker->SetMean(statistics->GetMean());
    flicker->SetVariance(statistics->GetVariance());
    flicker->SetMask(mask->GetOutput());
    flicker->SetRollingShutter(mode);
    flicker->SetSigmaRows(2.0);
    corrected->SetInput(flicker->GetOutput());
    corrected->SetNumberOfStreamDivisions(5);
    regression->SetMean(statistics->GetMean());
    regression->SetVariance(corrected->GetVariance());
    regression->SetMask(mask->GetOutput());
    regression->SetOffsetInput(flicker->GetOffsetOutput());
    regression->SetNumberOfFrames(frames);
  }
  itk::TemporalStatisticsImageFilter<StackType>::Pointer statistics =
    itk::TemporalStatisticsImageFilter<StackType>::New();
  itk::VibrationMaskImageFilter<>::Pointer              mask = itk::VibrationMaskImageFilter<>::New();
  itk::FlickerCorrectionImageFilter<StackType>::Pointer flicker = itk::FlickerCorrectionImageFilter<StackType>::New();
  itk::TemporalStatisticsImageFilter<DoubleStackType>::Pointer corrected =
    itk::TemporalStatisticsImageFilter<DoubleStackType>::New();
  itk::NoiseRegressionEstimator<>::Pointer regression = itk::NoiseRegressionEstimator<>::New();
};

/** 1e-9 is the accuracy that the module documents. */
void
ExpectTheSameQuantity(const sensornoise::Quantity & a, const sensornoise::Quantity & b)
{
  EXPECT_EQ(a.status, b.status);
  ASSERT_EQ(a.value.has_value(), b.value.has_value());
  if (a.value)
  {
    EXPECT_NEAR(*a.value, *b.value, 1e-9 * std::abs(*b.value));
  }
}

template <typename TEstimator>
void
ExpectTheSameAsTheChain(const TEstimator & estimator, Chain & chain)
{
  const sensornoise::Report & report = estimator->GetReport();
  const sensornoise::Report & byHand = chain.regression->GetReport();
  ASSERT_EQ(report.gain.status, EstimateStatus::Identified);
  ExpectTheSameQuantity(report.gain, byHand.gain);
  ExpectTheSameQuantity(report.intercept, byHand.intercept);
  // The regression does not know the dark pixels, and so not that they contradict the offset.
  const bool isContradicted = WarnsOf(report, sensornoise::WarningCode::OffsetLineMisfit) ||
                              WarnsOf(report, sensornoise::WarningCode::OffsetAboveDarkest);
  for (const auto quantity :
       { &sensornoise::Report::offset, &sensornoise::Report::readNoise, &sensornoise::Report::readNoiseElectrons })
  {
    if (isContradicted)
    {
      EXPECT_EQ((report.*quantity).status, EstimateStatus::Failed);
    }
    else
    {
      ExpectTheSameQuantity(report.*quantity, byHand.*quantity);
    }
  }
  EXPECT_EQ(report.pixels.used, byHand.pixels.used);
  EXPECT_NEAR(*report.fit.reducedChi2, *byHand.fit.reducedChi2, 1e-9);
  EXPECT_NEAR(*report.flickerSd.value, chain.flicker->GetFlicker().flickerSd, 1e-12);
  EXPECT_TRUE(HaveTheSameBits<FrameType>(estimator->GetMean(), chain.statistics->GetMean()));
  EXPECT_TRUE(HaveTheSameBits<FrameType>(estimator->GetVariance(), chain.statistics->GetVariance()));
  const auto corrected = PixelsOf(estimator->GetCorrectedVariance());
  const auto expected = PixelsOf(chain.corrected->GetVariance());
  for (std::size_t p = 0; p < corrected.size(); ++p)
  {
    ASSERT_EQ(std::isnan(corrected[p]), std::isnan(expected[p])) << p;
    ASSERT_TRUE(std::isnan(expected[p]) || std::abs(corrected[p] - expected[p]) <= 1e-9 * expected[p]) << p;
  }
}
} // namespace

TEST(SensorNoiseEstimatorChain, EqualsTheChainMadeByHand)
{
  const auto rolling = RollingShutterStack();
  for (const auto & [stack, mode, byLine] : { std::tuple(SimulatedStack(), RollingShutter::Off, false),
                                              std::tuple(SimulatedStack(), RollingShutter::Auto, false),
                                              std::tuple(rolling, RollingShutter::Fixed, true),
                                              std::tuple(rolling, RollingShutter::Auto, true) })
  {
    const auto estimator = EstimatorOf<StackType>(stack, "published");
    estimator->SetRollingShutter(mode);
    estimator->SetSigmaRows(2.0);
    estimator->Update();
    Chain chain(stack, stack->GetLargestPossibleRegion().GetSize(2), mode);
    chain.regression->Update();
    ExpectTheSameAsTheChain(estimator, chain);
    EXPECT_EQ(estimator->GetReport().flickerRows.empty(), !byLine);
    EXPECT_EQ(WarnsOf(estimator->GetReport(), sensornoise::WarningCode::RollingShutter), byLine);
  }
}

TEST(SensorNoiseEstimatorChain, ChainOnOneFileReaderMayBePulledAgain)
{
  const TemporaryFolder folder;
  const auto            file = WrittenTo<StackType>(folder.File("s.mha"), SimulatedStack());
  const auto            estimator = EstimatorOf<StackType>(SimulatedStack(), "published");
  estimator->Update();
  auto reader = itk::ImageFileReader<StackType>::New();
  reader->SetFileName(file);
  Chain              chain(reader->GetOutput(), Frames, RollingShutter::Auto);
  itk::SizeValueType frames = 0;
  unsigned int       runs = 0;
  chain.flicker->AddObserver(itk::EndEvent(), [&](const itk::EventObject &) {
    frames = std::max(frames, chain.flicker->GetOutput()->GetBufferedRegion().GetSize(2));
    ++runs;
  });
  chain.regression->Update();
  ExpectTheSameAsTheChain(estimator, chain);
  EXPECT_EQ(frames, Frames / 5); // never the whole corrected stack
  EXPECT_EQ(runs, 6u);           // the offset, and 5 chunks
  chain.regression->Update();
  EXPECT_EQ(runs, 6u);
  chain.corrected->Modified();
  chain.regression->Update();
  ExpectTheSameAsTheChain(estimator, chain);
  EXPECT_EQ(runs, 11u);
  for (itk::Object * const process :
       std::initializer_list<itk::Object *>{ reader, chain.statistics, chain.mask, chain.flicker, chain.regression })
  {
    process->Modified();
    chain.regression->Update();
    ExpectTheSameAsTheChain(estimator, chain);
  }
  EXPECT_EQ(frames, Frames / 5);
}

TEST(SensorNoiseEstimatorChain, ChainFailsUntilTheReaderIsMended)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack(), "published");
  estimator->Update();
  const auto reader = StackReader<StackType>::Of(SimulatedStack());
  Chain      chain(reader->GetOutput(), Frames, RollingShutter::Auto);
  for (int round = 0; round < 2; ++round)
  {
    reader->Break(12);
    EXPECT_SAYS(ErrorOf(chain.regression), "frame 12 is broken");
    EXPECT_SAYS(ErrorOf(chain.regression), "frame 12 is broken");
    reader->Mend();
    EXPECT_EQ(ErrorOf(chain.regression), "no error");
    ExpectTheSameAsTheChain(estimator, chain);
  }
}
