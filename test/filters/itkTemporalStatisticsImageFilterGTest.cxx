// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkTemporalStatisticsImageFilter.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/TemporalStatisticsTestHelper.h"
#include "itkImage.h"
#include "itkMeanProjectionImageFilter.h"
#include "itkStandardDeviationProjectionImageFilter.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::statistics;
using FloatStackType = itk::Image<float, 3>;

template <typename TPixel>
class TemporalStatisticsImageFilterOf : public ::testing::Test
{};
TYPED_TEST_SUITE(TemporalStatisticsImageFilterOf, PixelTypes, );
} // namespace

// Over t = 0 ... T-1 the series b + t has the mean b + (T-1)/2 and the variance T(T+1)/12.
TYPED_TEST(TemporalStatisticsImageFilterOf, RampInTimeHasTheClosedForm)
{
  using Stack = itk::Image<TypeParam, 3>;
  const auto baseOf = [](const auto & index) { return static_cast<double>(10 + index[0] + 5 * index[1]); };
  const auto filter = StatisticsOf<Stack>(
    ImageOf<Stack>({ { 7, 5, 6 } }, [&](const auto & index) { return baseOf(index) + static_cast<double>(index[2]); }));
  filter->Update();
  const auto mean = ImageOf<FrameType>({ { 7, 5 } }, [&](const auto & index) { return baseOf(index) + 2.5; });
  for (std::size_t p = 0; p < 35; ++p)
  {
    // Welford's recurrence rounds once a frame: 6 x 60 x 2^-53 < 1e-13. Integers are exact.
    EXPECT_NEAR(PixelsOf(filter->GetMean())[p], PixelsOf<FrameType>(mean)[p], 1e-12);
    EXPECT_NEAR(PixelsOf(filter->GetVariance())[p], 3.5, 1e-12);
    EXPECT_EQ(PixelsOf(filter->GetValidMask())[p], 1);
  }
  EXPECT_EQ(filter->GetOutput(), filter->GetMean());
  EXPECT_EQ(filter->GetOutput(1), filter->GetVariance());
  EXPECT_EQ(filter->GetOutput(2), filter->GetValidMask());
}

TYPED_TEST(TemporalStatisticsImageFilterOf, AgreesWithTheProjectionFilters)
{
  using Stack = itk::Image<TypeParam, 3>;
  const auto stack = TargetStack<Stack>(Width, Height, Frames);
  const auto filter = StatisticsOf<Stack>(stack);
  filter->Update();
  const auto mean = itk::MeanProjectionImageFilter<Stack, FrameType>::New();
  mean->SetInput(stack);
  mean->Update();
  const auto sd = itk::StandardDeviationProjectionImageFilter<Stack, FrameType>::New();
  sd->SetInput(stack);
  sd->Update();
  for (std::size_t p = 0; p < Width * Height; ++p)
  {
    // Sums of 11 numbers round to 11 x 2^-53 of the largest, 4095 (mean), and of its deviations (sd): below 1e-11.
    EXPECT_NEAR(filter->GetMean()->GetBufferPointer()[p], mean->GetOutput()->GetBufferPointer()[p], 1e-11);
    EXPECT_NEAR(std::sqrt(filter->GetVariance()->GetBufferPointer()[p]), sd->GetOutput()->GetBufferPointer()[p], 1e-11);
  }
}

TYPED_TEST(TemporalStatisticsImageFilterOf, ConstantStackHasNoVarianceAndIsValid)
{
  using Stack = itk::Image<TypeParam, 3>;
  const auto filter = StatisticsOf<Stack>(ConstantImage<Stack>({ { 3, 5, 4 } }, 77));
  filter->Update();
  EXPECT_EQ(PixelsOf(filter->GetMean()), std::vector<double>(15, 77.0));
  EXPECT_EQ(PixelsOf(filter->GetVariance()), std::vector<double>(15, 0.0));
  EXPECT_EQ(PixelsOf(filter->GetValidMask()), std::vector<unsigned char>(15, 1));
}

TEST(TemporalStatisticsImageFilter, WrongInputIsRefusedWithTheNumbers)
{
  EXPECT_SAYS(ErrorOf(itk::TemporalStatisticsImageFilter<StackType>::New()), "Input Primary is required but not set");
  EXPECT_SAYS(ErrorOf(StatisticsOf<StackType>(ConstantImage<StackType>({ { 8, 8, 1 } }, 5))), "has 1 frame");
  const auto filter = StatisticsOf<StackType>(ConstantImage<StackType>({ { 8, 8, 3 } }, 300));
  filter->SetBitDepth(8);
  EXPECT_SAYS(ErrorOf(filter),
              "the data hold the level 300 DN, but 8 bits with a quantization step of 1 DN end at 255 DN");
  EXPECT_SAYS(ErrorOf(filter), "the data hold the level 300 DN");
  filter->SetBitDepth(17);
  EXPECT_SAYS(ErrorOf(filter), "the bit depth is 17; expected 1 to 16");
  filter->SetBitDepth(9);
  filter->SetClipLow(30.0);
  filter->SetClipHigh(20.0);
  EXPECT_SAYS(ErrorOf(filter), "expected low < high");
  filter->SetClipHigh(400.0);
  EXPECT_EQ(ErrorOf(filter), "no error");
}

TEST(TemporalStatisticsImageFilter, PixelThatIsSaturatedOnceIsNotValid)
{
  const auto stack = ImageOf<StackType>({ { 9, 7, 4 } }, [](const auto & index) { return 100 + index[0] + index[2]; });
  stack->SetPixel({ { 3, 2, 1 } }, 4095);
  stack->SetPixel({ { 4, 2, 3 } }, 0);
  const auto filter = StatisticsOf<StackType>(stack);
  filter->Update();
  EXPECT_EQ(filter->GetSummary().clipped, 2u);
  EXPECT_EQ(filter->GetSummary().dnRange.bitDepth, 12);
  EXPECT_EQ(filter->GetValidMask()->GetPixel({ { 3, 2 } }), 0);
  EXPECT_EQ(filter->GetValidMask()->GetPixel({ { 4, 2 } }), 0);
  EXPECT_EQ(filter->GetValidMask()->GetPixel({ { 5, 2 } }), 1);
  EXPECT_EQ(filter->GetMean()->GetPixel({ { 3, 2 } }), (103 + 4095 + 105 + 106) / 4.0);
}

TEST(TemporalStatisticsImageFilter, FindsTheLevelAtWhichTheSensorSaturates)
{
  const auto source = TargetSource<StackType>(64, 64, Frames);
  source->SetClipHigh(2500.0);
  const auto filter = StatisticsOf<StackType>(source->GetOutput());
  filter->Update();
  EXPECT_EQ(filter->GetSummary().dnRange.clipHighDn, 2500.0);
  EXPECT_EQ(filter->GetSummary().dnRange.clipSource, "low: code range, high: pile-up");
  EXPECT_GT(filter->GetSummary().clipped, 0u);
}

TEST(TemporalStatisticsImageFilter, PixelThatIsNotFiniteOnceHasNeitherMeanNorVariance)
{
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float value : { nan, infinity, -infinity })
  {
    const auto stack = ImageOf<FloatStackType>(
      { { 5, 3, 4 } }, [](const auto & index) { return 0.5 + static_cast<double>(index[0] + index[2]); });
    stack->SetPixel({ { 2, 1, 1 } }, value);
    const auto filter = StatisticsOf<FloatStackType>(stack);
    filter->Update();
    EXPECT_TRUE(std::isnan(filter->GetMean()->GetPixel({ { 2, 1 } })));
    EXPECT_TRUE(std::isnan(filter->GetVariance()->GetPixel({ { 2, 1 } })));
    EXPECT_EQ(filter->GetValidMask()->GetPixel({ { 2, 1 } }), 0);
    EXPECT_EQ(filter->GetSummary().notFinite, 1u);
    EXPECT_EQ(filter->GetMean()->GetPixel({ { 3, 1 } }), 5.0);
    EXPECT_EQ(filter->GetValidMask()->GetPixel({ { 3, 1 } }), 1);
  }
}

TEST(TemporalStatisticsImageFilter, OutputsTakeTheGeometryOfTheFrames)
{
  const StackType::IndexType start{ { -4, 7, 12 } };
  const auto                 stack = TargetStack<StackType>(Width, Height, Frames);
  const auto                 moved = MovedTo<StackType>(start, stack);
  StackType::SpacingType     spacing;
  StackType::PointType       origin;
  for (unsigned int d = 0; d < 3; ++d)
  {
    spacing[d] = 0.5 + d;
    origin[d] = 3.0 - d;
  }
  moved->SetSpacing(spacing);
  moved->SetOrigin(origin);
  const auto filter = StatisticsOf<StackType>(moved);
  filter->SetNumberOfStreamDivisions(3);
  filter->Update();
  const auto check = [&](const auto * image) {
    EXPECT_EQ(image->GetLargestPossibleRegion().GetIndex()[0], -4);
    EXPECT_EQ(image->GetLargestPossibleRegion().GetIndex()[1], 7);
    EXPECT_EQ(image->GetLargestPossibleRegion().GetSize()[0], Width);
    EXPECT_EQ(image->GetLargestPossibleRegion().GetSize()[1], Height);
    EXPECT_EQ(image->GetSpacing()[0], 0.5);
    EXPECT_EQ(image->GetSpacing()[1], 1.5);
    EXPECT_EQ(image->GetOrigin()[0], 3.0);
    EXPECT_EQ(image->GetOrigin()[1], 2.0);
  };
  check(filter->GetMean());
  check(filter->GetVariance());
  check(filter->GetValidMask());
  const auto expected = StatisticsOf<StackType>(stack);
  expected->Update();
  ExpectTheSameStatistics(filter, expected, "at another start index");
}
