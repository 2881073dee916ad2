/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "sensornoise/report/ReportJson.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/base/RollingShutter.h"
#include "sensornoise/report/Report.h"
#include "sensornoise/simulation/Scenes.h"
#include "itkSensorNoiseEstimator.h"
#include "helpers/PipelineTestHelper.h"
#include "itkFlickerCorrectionImageFilter.h"
#include "itkImageFileReader.h"
#include "itkNoiseRegressionEstimator.h"
#include "itkPipelineMonitorImageFilter.h"
#include "itkTemporalStatisticsImageFilter.h"
#include "itkVibrationMaskImageFilter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>

namespace
{
using namespace sensornoisetest;
using StackType = itk::Image<unsigned short, 3>;
using DoubleStackType = itk::Image<double, 3>;
using RollingShutter = sensornoise::RollingShutter;
using sensornoise::EstimateStatus;
using sensornoise::PixelUse;
constexpr unsigned int Width = 65;
constexpr unsigned int Height = 63;
constexpr unsigned int Frames = 25;

template <typename TStack>
auto
EstimatorOf(const TStack * stack, const std::string & method = "refined")
{
  auto estimator = itk::SensorNoiseEstimator<TStack>::New();
  estimator->SetInput(stack);
  estimator->SetMethod(method);
  return estimator;
}

StackType::Pointer
SimulatedStack()
{
  static const StackType::Pointer stack = TargetStack<StackType>(Width, Height, Frames);
  return stack;
}

/** A rolling shutter over bars: each row holds every level, and its own flicker. */
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

/** 1e-9 is the module's promise. */
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
  ExpectTheSameQuantity(report.offset, byHand.offset);
  ExpectTheSameQuantity(report.readNoise, byHand.readNoise);
  ExpectTheSameQuantity(report.readNoiseElectrons, byHand.readNoiseElectrons);
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

template <typename TEstimator>
std::string
JsonOf(const TEstimator & estimator)
{
  EXPECT_EQ(ErrorOf(estimator), "no error");
  return sensornoise::ToJson(estimator->GetReport());
}

template <typename TEstimator>
void
ExpectTheSameMaps(const TEstimator & a, const TEstimator & b)
{
  EXPECT_TRUE(HaveTheSameBits(a->GetMean(), b->GetMean()));
  EXPECT_TRUE(HaveTheSameBits(a->GetVariance(), b->GetVariance()));
  EXPECT_TRUE(HaveTheSameBits(a->GetCorrectedVariance(), b->GetCorrectedVariance()));
  EXPECT_TRUE(HaveTheSameBits(a->GetPixelUse(), b->GetPixelUse()));
}

bool
WarnsOf(const sensornoise::Report & report, const std::string & code)
{
  return std::any_of(
    report.warnings.begin(), report.warnings.end(), [&code](const auto & warning) { return warning.code == code; });
}

template <typename TPixel>
class SensorNoiseEstimatorOf : public ::testing::Test
{};
using PixelTypes = ::testing::Types<unsigned char, unsigned short, short, float, double>;
TYPED_TEST_SUITE(SensorNoiseEstimatorOf, PixelTypes, );
} // namespace

// A pixel's variance has the relative sd sqrt(2/(T-1)), so the gain's is about
// sqrt(2/24) V_max / (spread of the means x sqrt(pixels)) < 0.29 / sqrt(600) x sqrt(12) = 4 %; 5 of them. The read
// noise adds the offset's error, about 5 % of the level: the test holds it to the bracket only.
TYPED_TEST(SensorNoiseEstimatorOf, GainIsRecovered)
{
  using Stack = itk::Image<TypeParam, 3>;
  const auto estimator = EstimatorOf<Stack>(TargetStack<Stack>(Width, Height, Frames));
  estimator->Update();
  const sensornoise::Report & report = estimator->GetReport();
  ASSERT_EQ(report.gain.status, EstimateStatus::Identified);
  EXPECT_NEAR(*report.gain.value, 1.0, 0.2);
  EXPECT_EQ(report.frames, Frames);
  EXPECT_EQ(report.width, Width);
  EXPECT_EQ(report.height, Height);
  EXPECT_GT(report.pixels.used, 600u);
  EXPECT_EQ(report.quantisationStepDn.has_value(), std::is_integral<TypeParam>::value);
  const auto uses = PixelsOf(estimator->GetPixelUse());
  EXPECT_EQ(static_cast<std::size_t>(std::count(uses.begin(), uses.end(), 0)), report.pixels.used);
}

TYPED_TEST(SensorNoiseEstimatorOf, SameBitsForAnyChunksAndWorkUnits)
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

TEST(SensorNoiseEstimator, EqualsTheChainMadeByHand)
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
    EXPECT_EQ(WarnsOf(estimator->GetReport(), "rolling-shutter"), byLine);
  }
}

TEST(SensorNoiseEstimator, ChainOnOneFileReaderMayBePulledAgain)
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

TEST(SensorNoiseEstimator, ChainFailsUntilTheReaderIsMended)
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

TEST(SensorNoiseEstimator, ReadsTheStackInPassesTimesChunks)
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

TEST(SensorNoiseEstimator, SecondUpdateDoesNoWorkAndEveryParameterDoes)
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

TEST(SensorNoiseEstimator, RefinedIsTheDefaultAndMethodsHaveNames)
{
  const auto estimator = itk::SensorNoiseEstimator<StackType>::New();
  EXPECT_EQ(estimator->GetMethod(), itk::SensorNoiseEstimatorEnums::Method::Refined);
  EXPECT_EQ(estimator->GetMethodName(), "refined");
  estimator->SetInput(SimulatedStack());
  EXPECT_EQ(JsonOf(estimator), JsonOf(EstimatorOf<StackType>(SimulatedStack(), "refined")));
  EXPECT_TRUE(estimator->GetReport().gain.standardError);
  estimator->SetMethod(itk::SensorNoiseEstimatorEnums::Method::Published);
  EXPECT_EQ(JsonOf(estimator), JsonOf(EstimatorOf<StackType>(SimulatedStack(), "published")));
  EXPECT_FALSE(estimator->GetReport().gain.standardError);
  EXPECT_SAYS(ErrorWhen([&] { estimator->SetMethod("best"); }),
              "the method is \"best\"; expected refined or published");
}

TEST(SensorNoiseEstimator, MaskedPixelsAreLeftOut)
{
  const auto mask = ImageOf<MaskType>({ { Width, Height } }, [](const auto & index) { return index[0] < 48 ? 1 : 0; });
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  const auto json = JsonOf(estimator);
  estimator->SetMask(mask);
  EXPECT_NE(JsonOf(estimator), json);
  for (itk::ImageRegionIteratorWithIndex<MaskType> it(estimator->GetPixelUse(), mask->GetLargestPossibleRegion());
       !it.IsAtEnd();
       ++it)
  {
    ASSERT_EQ(it.Get() == static_cast<unsigned char>(PixelUse::Masked), it.GetIndex()[0] >= 48);
  }
  // What lies under the mask does not matter.
  const auto other = ImageOf<StackType>({ { Width, Height, Frames } }, [](const auto & index) {
    return index[0] < 49 ? SimulatedStack()->GetPixel(index) : 1000 + index[0] + index[2] % 7;
  });
  const auto hidden = EstimatorOf<StackType>(other);
  hidden->SetMask(mask);
  hidden->Update();
  EXPECT_EQ(hidden->GetReport().gain.value, estimator->GetReport().gain.value);
  EXPECT_EQ(hidden->GetReport().offset.value, estimator->GetReport().offset.value);
  mask->FillBuffer(1);
  mask->Modified();
  EXPECT_EQ(JsonOf(estimator), json);
}

TEST(SensorNoiseEstimator, StartIndexDoesNotMatterAndOutputsKeepIt)
{
  const auto moved = EstimatorOf<StackType>(MovedTo<StackType>({ { 9, -6, 100 } }, SimulatedStack()));
  moved->SetMask(MovedTo<MaskType>({ { 9, -6 } }, ConstantImage<MaskType>({ { Width, Height } }, 1)));
  moved->SetNumberOfStreamDivisions(4);
  const auto expected = EstimatorOf<StackType>(SimulatedStack());
  EXPECT_EQ(JsonOf(moved), JsonOf(expected));
  ExpectTheSameMaps(moved, expected);
  EXPECT_EQ(moved->GetPixelUse()->GetLargestPossibleRegion().GetIndex(), (MaskType::IndexType{ { 9, -6 } }));
}

TEST(SensorNoiseEstimator, PixelsThatAreNaNAreLeftOutAndReported)
{
  using FloatStackType = itk::Image<float, 3>;
  const auto stack = TargetStack<FloatStackType>(Width, Height, Frames);
  for (itk::IndexValueType x = 10; x < 20; ++x)
  {
    stack->SetPixel({ { x, 30, x } }, std::numeric_limits<float>::quiet_NaN());
  }
  const auto estimator = EstimatorOf<FloatStackType>(stack);
  estimator->Update();
  const sensornoise::Report & report = estimator->GetReport();
  EXPECT_EQ(report.pixels.notFinite, 10u);
  EXPECT_TRUE(WarnsOf(report, "not-finite-pixels"));
  EXPECT_EQ(report.gain.status, EstimateStatus::Identified);
  EXPECT_NEAR(*report.gain.value, 1.0, 0.2); // as above
  EXPECT_TRUE(report.vibrationCovariance.value && std::isfinite(*report.vibrationCovariance.value));
  EXPECT_EQ(estimator->GetPixelUse()->GetPixel({ { 15, 30 } }), static_cast<unsigned char>(PixelUse::NotFinite));
}

TEST(SensorNoiseEstimator, WrongInputIsRefusedWithTheNumbers)
{
  EXPECT_SAYS(ErrorOf(itk::SensorNoiseEstimator<StackType>::New()), "Input Primary is required but not set");
  const auto four = EstimatorOf<StackType>(TargetStack<StackType>(Width, Height, 4));
  EXPECT_SAYS(ErrorOf(four), "the stack has 4 frames; expected at least 5");
  EXPECT_SAYS(ErrorOf(four), "the stack has 4 frames; expected at least 5");
  const auto tiny = EstimatorOf<StackType>(ConstantImage<StackType>({ { 2, 2, 9 } }, 5));
  EXPECT_SAYS(ErrorOf(tiny), "the frames have 2 x 2 pixels; expected at least 3 x 3");
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->SetMask(ConstantImage<MaskType>({ { Width, Height - 2 } }, 1));
  EXPECT_SAYS(ErrorOf(estimator), "the mask has the region");
  EXPECT_SAYS(ErrorOf(estimator), "[65, 61]");
  estimator->SetMask(nullptr);
  estimator->SetBitDepth(8);
  EXPECT_SAYS(ErrorOf(estimator), "end at 255 DN; give a larger bit depth");
  estimator->SetBitDepth(0);
  estimator->SetMethod("published");
  estimator->SetLevel(1.5);
  EXPECT_SAYS(ErrorOf(estimator), "the level of the vibration test is 1.5");
  estimator->SetLevel(0.01);
  estimator->SetOffset(100.0);
  EXPECT_SAYS(ErrorOf(estimator), "the offset cannot be used by the method published");
  estimator->SetMethod("refined");
  estimator->SetOffset(std::numeric_limits<double>::infinity());
  EXPECT_SAYS(ErrorOf(estimator), "the offset is inf DN");
  estimator->SetOffset(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(JsonOf(estimator), JsonOf(EstimatorOf<StackType>(SimulatedStack())));
}

TEST(SensorNoiseEstimator, StackThatCannotBeMeasuredGivesAReportThatSaysWhy)
{
  const StackType::SizeType size{ { 40, 30, 9 } };
  const auto                first = TargetStack<StackType>(40, 32, 1);
  const auto                identical = ImageOf<StackType>(
    size, [&](const auto & index) { return first->GetPixel(StackType::IndexType{ { index[0], index[1], 0 } }); });
  for (const auto & [stack, clipped] : { std::pair(ConstantImage<StackType>(size, 4095), true),
                                         std::pair(ConstantImage<StackType>(size, 0), true),
                                         std::pair(ConstantImage<StackType>(size, 1000), false),
                                         std::pair(identical, false) })
  {
    const auto estimator = EstimatorOf<StackType>(stack);
    estimator->SetBitDepth(12);
    EXPECT_EQ(ErrorOf(estimator), "no error");
    const sensornoise::Report & report = estimator->GetReport();
    for (const auto * quantity : { &report.gain,
                                   &report.offset,
                                   &report.readNoise,
                                   &report.readNoiseElectrons,
                                   &report.intercept,
                                   &report.totalIntercept })
    {
      EXPECT_EQ(quantity->status, EstimateStatus::Failed);
      EXPECT_FALSE(quantity->value);
    }
    EXPECT_FALSE(report.IsUsable());
    EXPECT_TRUE(WarnsOf(report, "nothing-to-measure"));
    EXPECT_EQ(report.pixels.clipped == 1200u, clipped);
    EXPECT_EQ(report.pixels.used, 0u);
    EXPECT_TRUE(std::isnan(estimator->GetCorrectedVariance()->GetPixel({ { 20, 20 } })));
    EXPECT_EQ(estimator->GetVariance()->GetPixel({ { 20, 20 } }), 0.0);
    EXPECT_EQ(estimator->GetPixelUse()->GetPixel({ { 20, 20 } }),
              static_cast<unsigned char>(clipped ? PixelUse::Clipped : PixelUse::Constant));
  }
}

TEST(SensorNoiseEstimator, FailsUntilTheReaderIsMended)
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

TEST(SensorNoiseEstimator, AbortThrowsAndTheNextUpdateIsRight)
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

namespace
{
/** Frames of the same camera without light. */
template <typename TStack>
typename TStack::Pointer
DarkStack(unsigned int frames, unsigned int width = Width)
{
  const auto source = TargetSource<TStack>(width, Height, frames);
  source->SetElectrons(1e-9);
  source->SetSeed(77);
  typename TStack::Pointer stack = source->GetOutput();
  source->Update();
  stack->DisconnectPipeline();
  return stack;
}
} // namespace

// Camera B, mu = 100 DN and sigma = 8 DN (20 and 2 in 8 bits): within 4 standard errors.
TYPED_TEST(SensorNoiseEstimatorOf, DarkFramesTellOffsetAndReadNoise)
{
  using Stack = itk::Image<TypeParam, 3>;
  const auto estimator = EstimatorOf<Stack>(TargetStack<Stack>(Width, Height, Frames));
  estimator->SetDark(DarkStack<Stack>(12));
  estimator->Update();
  const sensornoise::Report & report = estimator->GetReport();
  const bool                  isByte = sizeof(TypeParam) == 1;
  for (const auto & [quantity, truth] :
       { std::pair(&report.offset, isByte ? 20.0 : 100.0), std::pair(&report.readNoise, isByte ? 2.0 : 8.0) })
  {
    ASSERT_TRUE(quantity->value && quantity->standardError);
    EXPECT_NEAR(*quantity->value, truth, 4.0 * *quantity->standardError);
  }
  // sigma / sqrt(pixels x frames)
  EXPECT_NEAR(*report.offset.standardError, (isByte ? 2.0 : 8.0) / std::sqrt(Width * Height * 12.0), 0.004);
}

TEST(SensorNoiseEstimator, OneDarkFrameTellsTheOffsetAlone)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->SetDark(DarkStack<StackType>(1));
  estimator->Update();
  const sensornoise::Report & report = estimator->GetReport();
  EXPECT_NEAR(*report.offset.value, 100.0, 4.0 * 8.0 / std::sqrt(Width * Height));
  // From the line through the others' variance: its error is far from that of dark frames.
  EXPECT_GT(report.readNoise.standardError.value_or(0.0), 0.1);
}

TEST(SensorNoiseEstimator, DarkFramesAreReadOnceInChunksAndChangeNoBit)
{
  const auto dark = DarkStack<StackType>(12);
  const auto expected = EstimatorOf<StackType>(SimulatedStack());
  expected->SetDark(dark);
  const auto json = JsonOf(expected);
  for (const unsigned int chunks : { 1u, 4u })
  {
    for (const unsigned int units : { 1u, 7u })
    {
      const auto reader = StackReader<StackType>::Of(dark);
      const auto estimator = EstimatorOf<StackType>(SimulatedStack());
      estimator->SetDark(reader->GetOutput());
      estimator->SetNumberOfStreamDivisions(chunks);
      estimator->SetNumberOfWorkUnits(units);
      EXPECT_EQ(JsonOf(estimator), json) << chunks << " x " << units;
      EXPECT_EQ(reader->WholeReads(), chunks == 1 ? 1u : 0u);
      EXPECT_EQ(reader->Reads(), chunks == 1 ? 1u : chunks + 1) << "and one frame, which the pipeline keeps";
      estimator->Update();
      EXPECT_LE(reader->Reads(), chunks + 1);
    }
  }
}

TEST(SensorNoiseEstimator, DarkFramesMayHaveAnotherStartIndexAndAreMasked)
{
  const auto dark = DarkStack<StackType>(12);
  const auto mask = ImageOf<MaskType>({ { Width, Height } }, [](const auto & index) { return index[0] < 48 ? 1 : 0; });
  const auto expected = EstimatorOf<StackType>(SimulatedStack());
  expected->SetDark(dark);
  expected->SetMask(mask);
  const auto moved = EstimatorOf<StackType>(SimulatedStack());
  moved->SetMask(mask);
  moved->SetDark(
    MovedTo<StackType>({ { 3, -2, 50 } }, ImageOf<StackType>({ { Width, Height, 12 } }, [&](const auto & index) {
                         return index[0] < 48 ? dark->GetPixel(index) : 3000;
                       })));
  EXPECT_EQ(JsonOf(moved), JsonOf(expected));
}

TEST(SensorNoiseEstimator, DarkFramesThatCannotBeUsedAreRefused)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  const auto json = JsonOf(estimator);
  estimator->SetDark(DarkStack<StackType>(12, Width - 1));
  EXPECT_SAYS(ErrorOf(estimator), "the dark frames have 64 x 63 pixels, but the frames have 65 x 63");
  estimator->SetDark(ConstantImage<StackType>({ { Width, Height, 9 } }, 0));
  EXPECT_SAYS(ErrorOf(estimator), "their black level is cut off");
  EXPECT_SAYS(ErrorOf(estimator), "their black level is cut off");
  const auto dark = DarkStack<StackType>(12);
  estimator->SetDark(dark);
  estimator->SetOffset(100.0);
  EXPECT_SAYS(ErrorOf(estimator), "the offset 100 DN and dark frames were given; expected one of them");
  estimator->SetOffset(std::numeric_limits<double>::quiet_NaN());
  estimator->SetMethod("published");
  EXPECT_SAYS(ErrorOf(estimator), "dark frames cannot be used by the method published");
  estimator->SetMethod("refined");
  const auto reader = StackReader<StackType>::Of(dark);
  estimator->SetDark(reader->GetOutput());
  reader->Break(7);
  EXPECT_SAYS(ErrorOf(estimator), "frame 7 is broken");
  EXPECT_SAYS(ErrorOf(estimator), "frame 7 is broken");
  reader->Mend();
  const auto expected = EstimatorOf<StackType>(SimulatedStack());
  expected->SetDark(dark);
  EXPECT_EQ(JsonOf(estimator), JsonOf(expected));
  estimator->SetDark(nullptr);
  EXPECT_EQ(JsonOf(estimator), json);
}
