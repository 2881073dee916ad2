// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "itkSensorNoiseEstimator.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"
#include "itkImage.h"
#include "itkImageRegionIteratorWithIndex.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <type_traits>
#include <utility>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::estimator;
using sensornoise::EstimateStatus;
using sensornoise::PixelUse;

template <typename TPixel>
class SensorNoiseEstimatorOf : public ::testing::Test
{};
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
  const auto measured = MeasuredBy(estimator);
  estimator->SetMask(mask);
  EXPECT_NE(MeasuredBy(estimator), measured);
  for (itk::ImageRegionIteratorWithIndex<MaskType> it(estimator->GetPixelUse(), mask->GetLargestPossibleRegion());
       !it.IsAtEnd();
       ++it)
  {
    ASSERT_EQ(it.Get() == static_cast<unsigned char>(PixelUse::Masked), it.GetIndex()[0] >= 48);
  }
  // Values under the mask have no effect.
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
  EXPECT_EQ(MeasuredBy(estimator), measured);
}

TEST(SensorNoiseEstimator, StartIndexDoesNotMatterAndOutputsKeepIt)
{
  const auto moved = EstimatorOf<StackType>(MovedTo<StackType>({ { 9, -6, 100 } }, SimulatedStack()));
  moved->SetMask(MovedTo<MaskType>({ { 9, -6 } }, ConstantImage<MaskType>({ { Width, Height } }, 1)));
  moved->SetNumberOfStreamDivisions(4);
  const auto expected = EstimatorOf<StackType>(SimulatedStack());
  expected->SetMask(ConstantImage<MaskType>({ { Width, Height } }, 1));
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
  EXPECT_TRUE(WarnsOf(report, sensornoise::WarningCode::NotFinitePixels));
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
    EXPECT_TRUE(WarnsOf(report, sensornoise::WarningCode::NothingToMeasure));
    EXPECT_EQ(report.pixels.clipped == 1200u, clipped);
    EXPECT_EQ(report.pixels.used, 0u);
    EXPECT_TRUE(std::isnan(estimator->GetCorrectedVariance()->GetPixel({ { 20, 20 } })));
    EXPECT_EQ(estimator->GetVariance()->GetPixel({ { 20, 20 } }), 0.0);
    EXPECT_EQ(estimator->GetPixelUse()->GetPixel({ { 20, 20 } }),
              static_cast<unsigned char>(clipped ? PixelUse::Clipped : PixelUse::Constant));
  }
}
