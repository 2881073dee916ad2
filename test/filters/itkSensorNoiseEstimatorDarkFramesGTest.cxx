// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "itkSensorNoiseEstimator.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"
#include "itkImage.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::estimator;

/** Returns dark frames of the same camera. */
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

template <typename TPixel>
class SensorNoiseEstimatorDarkFramesOf : public ::testing::Test
{};
TYPED_TEST_SUITE(SensorNoiseEstimatorDarkFramesOf, PixelTypes, );
} // namespace

// Camera B, mu = 100 DN and sigma = 8 DN (20 and 2 in 8 bits): within 4 standard errors.
TYPED_TEST(SensorNoiseEstimatorDarkFramesOf, DarkFramesDetermineOffsetAndReadNoise)
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

TEST(SensorNoiseEstimatorDarkFrames, OneDarkFrameDeterminesTheOffsetAlone)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->SetDark(DarkStack<StackType>(1));
  estimator->Update();
  const sensornoise::Report & report = estimator->GetReport();
  EXPECT_NEAR(*report.offset.value, 100.0, 4.0 * 8.0 / std::sqrt(Width * Height));
  // From the line through the others' variance: its error is far from the error by dark frames.
  EXPECT_GT(report.readNoise.standardError.value_or(0.0), 0.1);
}

TEST(SensorNoiseEstimatorDarkFrames, DarkFramesAreReadOnceInChunksAndChangeNoBit)
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

TEST(SensorNoiseEstimatorDarkFrames, DarkFramesMayHaveAnotherStartIndexAndAreMasked)
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

TEST(SensorNoiseEstimatorDarkFrames, DarkFramesThatCannotBeUsedAreRefused)
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

TEST(SensorNoiseEstimatorDarkFrames, PixelsHaveTheirOwnOffsetAndReadNoise)
{
  const auto dark = DarkStack<StackType>(12);
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->SetDark(dark);
  estimator->Update();
  EXPECT_EQ(estimator->GetPixelOffset()->GetLargestPossibleRegion(), estimator->GetMean()->GetLargestPossibleRegion());
  double offsets = 0.0;
  double noises = 0.0;
  for (int y = 0; y < static_cast<int>(Height); ++y)
  {
    for (int x = 0; x < static_cast<int>(Width); ++x)
    {
      double sum = 0.0;
      for (int t = 0; t < 12; ++t)
      {
        sum += dark->GetPixel({ { x, y, t } });
      }
      ASSERT_NEAR(estimator->GetPixelOffset()->GetPixel({ { x, y } }), sum / 12.0, 1e-9);
      offsets += estimator->GetPixelOffsetLow()->GetPixel({ { x, y } }) < 100.0 &&
                     estimator->GetPixelOffsetHigh()->GetPixel({ { x, y } }) > 100.0
                   ? 1.0
                   : 0.0;
      noises += estimator->GetPixelReadNoiseLow()->GetPixel({ { x, y } }) < 8.0 &&
                    estimator->GetPixelReadNoiseHigh()->GetPixel({ { x, y } }) > 8.0
                  ? 1.0
                  : 0.0;
      ASSERT_LT(estimator->GetPixelReadNoiseLow()->GetPixel({ { x, y } }),
                estimator->GetPixelReadNoise()->GetPixel({ { x, y } }));
    }
  }
  // 95 % of 4095, give or take 0.35 %
  EXPECT_NEAR(offsets / (Width * Height), 0.95, 0.014);
  EXPECT_NEAR(noises / (Width * Height), 0.95, 0.014);
}

TEST(SensorNoiseEstimatorDarkFrames, WithoutTwoDarkFramesThePixelsMapsAreEmpty)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->SetDark(DarkStack<StackType>(3));
  estimator->GetPixelOffset()->Update();
  EXPECT_EQ(estimator->GetPixelOffset()->GetBufferedRegion().GetNumberOfPixels(), Width * Height);
  estimator->SetDark(DarkStack<StackType>(1));
  estimator->Update();
  EXPECT_EQ(estimator->GetPixelOffset()->GetLargestPossibleRegion().GetNumberOfPixels(), 0u);
  estimator->SetDark(nullptr);
  estimator->Update();
  EXPECT_EQ(estimator->GetPixelReadNoiseHigh()->GetLargestPossibleRegion().GetNumberOfPixels(), 0u);
  EXPECT_EQ(estimator->GetMean()->GetBufferedRegion().GetNumberOfPixels(), Width * Height);
  estimator->SetDark(DarkStack<StackType>(3));
  estimator->GetPixelReadNoise()->Update();
  EXPECT_EQ(estimator->GetPixelReadNoise()->GetBufferedRegion().GetNumberOfPixels(), Width * Height);
}

TEST(SensorNoiseEstimatorDarkFrames, PixelsThatAreMaskedHaveNone)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->SetDark(DarkStack<StackType>(6));
  estimator->SetMask(
    ImageOf<MaskType>({ { Width, Height } }, [](const auto & index) { return index[0] < 48 ? 1 : 0; }));
  estimator->Update();
  EXPECT_TRUE(std::isfinite(estimator->GetPixelReadNoise()->GetPixel({ { 47, 5 } })));
  EXPECT_TRUE(std::isnan(estimator->GetPixelReadNoise()->GetPixel({ { 48, 5 } })));
}

// A black level that drifts is in no pixel's noise, whatever the chunks.
TEST(SensorNoiseEstimatorDarkFrames, DriftOfTheBlackLevelIsNoReadNoise)
{
  const auto steady = DarkStack<StackType>(12);
  const auto drifting = ImageOf<StackType>({ { Width, Height, 12 } }, [&](const auto & index) {
    return static_cast<StackType::PixelType>(steady->GetPixel(index) + 10 * (index[2] % 3));
  });
  const auto expected = EstimatorOf<StackType>(SimulatedStack());
  expected->SetDark(steady);
  expected->Update();
  for (const unsigned int chunks : { 1u, 4u })
  {
    const auto estimator = EstimatorOf<StackType>(SimulatedStack());
    const auto reader = StackReader<StackType>::Of(drifting);
    estimator->SetDark(reader->GetOutput());
    estimator->SetNumberOfStreamDivisions(chunks);
    estimator->Update();
    for (int x = 0; x < static_cast<int>(Width); ++x)
    {
      ASSERT_NEAR(estimator->GetPixelReadNoise()->GetPixel({ { x, 7 } }),
                  expected->GetPixelReadNoise()->GetPixel({ { x, 7 } }),
                  1e-6);
    }
    EXPECT_GT(*estimator->GetReport().offset.standardError, 10.0 * 0.85 / std::sqrt(12.0) * 0.9);
  }
}
