// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkGeneralizedAnscombeImageFilter.h"

#include "sensornoise/NoiseModel.h"
#include "itkInverseGeneralizedAnscombeImageFilter.h"
#include "helpers/PipelineTestHelper.h"
#include "itkPipelineMonitorImageFilter.h"
#include "itkSensorNoiseEstimator.h"
#include "itkStreamingImageFilter.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace
{
using namespace sensornoisetest;
using StackType = itk::Image<unsigned short, 3>;
using FloatStackType = itk::Image<float, 3>;
using ForwardType = itk::GeneralizedAnscombeImageFilter<StackType>;
using InverseType = itk::InverseGeneralizedAnscombeImageFilter<FloatStackType, StackType>;
constexpr double Slope = 0.5;
constexpr double Intercept = -50.125; // with 3/8 a^2 = 0.09375: below 100.06 DN arguments are negative

/** Levels 0 to 2000, with an odd width. */
template <typename TImage>
typename TImage::Pointer
Levels(const typename TImage::SizeType &  size,
       const typename TImage::IndexType & start = typename TImage::IndexType{ {} })
{
  int number = 0;
  return ImageOf<TImage>(size, [&](const auto &) { return (number = (number + 37) % 2001); }, start);
}

template <typename TFilter, typename TImage>
typename TFilter::Pointer
FilterOf(const TImage * image)
{
  auto filter = TFilter::New();
  filter->SetInput(image);
  filter->SetVarianceSlope(Slope);
  filter->SetTotalIntercept(Intercept);
  return filter;
}

sensornoise::Report
ReportOf(double slope, double intercept)
{
  sensornoise::Report report;
  report.varianceSlope = sensornoise::Quantity::Identified(slope);
  report.totalIntercept = sensornoise::Quantity::Identified(intercept);
  return report;
}

/** Transforms an image and inverts the transform, in the dimension and types of the images, from another start index.
 */
template <typename TImage, typename TReal>
void
LeadsThereAndBack()
{
  typename TImage::SizeType  size;
  typename TImage::IndexType start;
  size.Fill(5);
  start.Fill(-3);
  auto image = Levels<TImage>(size, start);
  for (itk::SizeValueType i = 0; i < image->GetLargestPossibleRegion().GetNumberOfPixels(); ++i)
  {
    auto & pixel = image->GetBufferPointer()[i];
    pixel = static_cast<typename TImage::PixelType>(101 + static_cast<int>(pixel) % 27); // all are positive, and fit
  }
  using RealImage = itk::Image<TReal, TImage::ImageDimension>;
  const auto forward = FilterOf<itk::GeneralizedAnscombeImageFilter<TImage, RealImage>>(image.GetPointer());
  const auto inverse = FilterOf<itk::InverseGeneralizedAnscombeImageFilter<RealImage, TImage>>(forward->GetOutput());
  inverse->SetInverse("algebraic");
  inverse->Update();
  const auto found = PixelsOf(inverse->GetOutput());
  const auto expected = PixelsOf(image.GetPointer());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_NEAR(found[i], expected[i], 1e-4); // float's rounding of levels near 100; 0 for integers
  }
  EXPECT_EQ(inverse->GetOutput()->GetLargestPossibleRegion(), image->GetLargestPossibleRegion());
}
} // namespace

TEST(GeneralizedAnscombeImageFilter, EqualsTheTransformOfTheModule)
{
  const auto image = Levels<StackType>({ { 17, 9, 5 } });
  const auto filter = FilterOf<ForwardType>(image.GetPointer());
  filter->Update();
  const auto         pixels = PixelsOf(image.GetPointer());
  std::vector<float> expected(pixels.size());
  const auto         negative =
    sensornoise::GeneralizedAnscombe({ Slope, Intercept }).Stabilise(pixels.data(), pixels.size(), expected.data());
  EXPECT_TRUE(HaveTheSameBits(PixelsOf(filter->GetOutput()), expected));
  EXPECT_GT(negative, 0U);
  EXPECT_EQ(filter->GetNumberOfNegativeArguments(), negative);
}

TEST(GeneralizedAnscombeImageFilter, LeadsThereAndBackInEveryTypeAndDimension)
{
  LeadsThereAndBack<itk::Image<unsigned char, 2>, float>();
  LeadsThereAndBack<itk::Image<unsigned short, 2>, double>();
  LeadsThereAndBack<itk::Image<short, 2>, float>();
  LeadsThereAndBack<itk::Image<float, 2>, float>();
  LeadsThereAndBack<itk::Image<double, 2>, double>();
  LeadsThereAndBack<itk::Image<unsigned char, 3>, double>();
  LeadsThereAndBack<itk::Image<short, 3>, double>();
  LeadsThereAndBack<itk::Image<float, 3>, double>();
  LeadsThereAndBack<itk::Image<double, 3>, float>();
  LeadsThereAndBack<itk::Image<unsigned short, 1>, float>();
  LeadsThereAndBack<itk::Image<unsigned short, 4>, float>();
}

TEST(GeneralizedAnscombeImageFilter, StreamsAndCountsTheWhole)
{
  const auto image = Levels<StackType>({ { 17, 9, 8 } });
  const auto whole = FilterOf<ForwardType>(image.GetPointer());
  whole->Update();
  const auto reader = StackReader<StackType>::Of(image);
  auto       monitor = itk::PipelineMonitorImageFilter<StackType>::New();
  monitor->SetInput(reader->GetOutput());
  const auto forward = FilterOf<ForwardType>(monitor->GetOutput());
  const auto inverse = FilterOf<InverseType>(forward->GetOutput());
  auto       streamer = itk::StreamingImageFilter<StackType, StackType>::New();
  streamer->SetInput(inverse->GetOutput());
  streamer->SetNumberOfStreamDivisions(4);
  streamer->Update();
  EXPECT_TRUE(monitor->VerifyInputFilterExecutedStreaming(4));
  EXPECT_TRUE(monitor->VerifyAllInputCanStream(4));
  EXPECT_EQ(forward->GetNumberOfNegativeArguments(), whole->GetNumberOfNegativeArguments());
  const auto direct = FilterOf<InverseType>(whole->GetOutput());
  direct->Update();
  EXPECT_TRUE(HaveTheSameBits(streamer->GetOutput(), direct->GetOutput()));
}

TEST(GeneralizedAnscombeImageFilter, DoesNotDependOnThreads)
{
  const auto image = Levels<StackType>({ { 31, 23, 5 } });
  const auto one = FilterOf<ForwardType>(image.GetPointer());
  const auto many = FilterOf<ForwardType>(image.GetPointer());
  one->SetNumberOfWorkUnits(1);
  many->SetNumberOfWorkUnits(7);
  one->Update();
  many->Update();
  EXPECT_TRUE(HaveTheSameBits(one->GetOutput(), many->GetOutput()));
  EXPECT_EQ(one->GetNumberOfNegativeArguments(), many->GetNumberOfNegativeArguments());
}

// The count stays valid as long as the output does.
TEST(GeneralizedAnscombeImageFilter, SecondUpdateDoesNoWork)
{
  const auto filter = FilterOf<ForwardType>(Levels<StackType>({ { 17, 9, 5 } }).GetPointer());
  filter->Update();
  const auto counted = filter->GetNumberOfNegativeArguments();
  const auto made = filter->GetOutput()->GetMTime();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetMTime(), made);
  EXPECT_EQ(filter->GetNumberOfNegativeArguments(), counted);
  filter->SetTotalIntercept(0.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfNegativeArguments(), 0U);
}

TEST(GeneralizedAnscombeImageFilter, NotANumberStaysOne)
{
  using FloatType = itk::Image<float, 2>;
  const auto image = ConstantImage<FloatType>({ { 3, 3 } }, 500.0);
  image->GetBufferPointer()[4] = std::numeric_limits<float>::quiet_NaN();
  const auto filter = FilterOf<itk::GeneralizedAnscombeImageFilter<FloatType>>(image.GetPointer());
  filter->Update();
  EXPECT_TRUE(std::isnan(filter->GetOutput()->GetBufferPointer()[4]));
  EXPECT_EQ(filter->GetNumberOfNegativeArguments(), 0U);
  const auto greyValues =
    FilterOf<itk::InverseGeneralizedAnscombeImageFilter<FloatType, itk::Image<unsigned short, 2>>>(filter->GetOutput());
  for (int i = 0; i < 2; ++i) // also when it is asked again
  {
    EXPECT_SAYS(ErrorOf(greyValues),
                "1 stabilised value(s) are NaN, which integers cannot hold; expected numbers, or an output of float or "
                "double");
  }
}

// After an error the next update fails again, or is right.
TEST(GeneralizedAnscombeImageFilter, FailsAgainUntilTheReaderIsMended)
{
  const auto reader = StackReader<StackType>::Of(Levels<StackType>({ { 17, 9, 5 } }));
  const auto forward = FilterOf<ForwardType>(reader->GetOutput());
  const auto inverse = FilterOf<InverseType>(forward->GetOutput());
  reader->Break(2);
  EXPECT_SAYS(ErrorOf(inverse), "frame 2 is broken");
  EXPECT_SAYS(ErrorOf(inverse), "frame 2 is broken");
  reader->Mend();
  EXPECT_EQ(ErrorOf(inverse), "no error");
}

TEST(GeneralizedAnscombeImageFilter, RefusesWhatIsNoModel)
{
  auto filter = ForwardType::New();
  filter->SetInput(Levels<StackType>({ { 4, 4, 4 } }));
  EXPECT_SAYS(ErrorOf(filter), "the variance slope is 0; expected a finite number above 0 [DN/e-]");
  filter->SetVarianceSlope(1.0);
  EXPECT_SAYS(ErrorOf(filter), "the total intercept is nan; expected a finite number [DN^2]");
  filter->SetTotalIntercept(2.0);
  EXPECT_EQ(ErrorOf(filter), "no error");
  auto inverse = InverseType::New();
  inverse->SetInput(filter->GetOutput());
  EXPECT_SAYS(ErrorOf(inverse), "the variance slope is 0; expected a finite number above 0 [DN/e-]");
  EXPECT_SAYS(ErrorWhen([&] { inverse->SetInverse("unbiased"); }),
              "the inverse is \"unbiased\"; expected exact-unbiased, algebraic or asymptotic");
}

TEST(GeneralizedAnscombeImageFilter, TakesTheModelOfAReport)
{
  const auto filter = ForwardType::New();
  const auto inverse = InverseType::New();
  filter->SetReport(ReportOf(0.25, -3.0));
  inverse->SetReport(ReportOf(0.25, -3.0));
  EXPECT_EQ(filter->GetVarianceSlope(), 0.25);
  EXPECT_EQ(filter->GetTotalIntercept(), -3.0);
  EXPECT_EQ(inverse->GetVarianceSlope(), 0.25);
  EXPECT_EQ(inverse->GetTotalIntercept(), -3.0);
  EXPECT_SAYS(ErrorWhen([&] { filter->SetReport(ReportOf(-0.25, 1.0)); }), "the variance slope is -0.25");
  EXPECT_SAYS(ErrorWhen([&] { inverse->SetReport(sensornoise::Report()); }),
              "the report's variance_slope has no value (it is failed)");
  EXPECT_SAYS(ErrorWhen([&] {
                filter->SetReport(static_cast<itk::SensorNoiseEstimator<StackType>::ReportObjectType *>(nullptr));
              }),
              "the report is null");
  EXPECT_EQ(filter->GetVarianceSlope(), 0.25); // as before
}

// The whole way: a burst's report, and a variance of 1 at every level. 12,000 pixels of 30 frames: each third of the
// levels has 4000 x 29 degrees of freedom, a standard error of
// sqrt(2 / 116,000) = 0.0042; 4.5 of them, and 0.01 for the transform in the dark and the errors of the report.
TEST(GeneralizedAnscombeImageFilter, StabilisesWhatWasMeasured)
{
  const auto source = TargetSource<StackType>(120, 100, 30);
  source->SetFlickerSd(0.0);
  auto estimator = itk::SensorNoiseEstimator<StackType>::New();
  estimator->SetInput(source->GetOutput());
  estimator->Update();
  const double slope = *estimator->GetReport().varianceSlope.value;
  const double intercept = *estimator->GetReport().totalIntercept.value;
  EXPECT_SAYS(estimator->GetNoiseModelCheckAsJson(slope, intercept), "\"verdict\": \"fits\"");
  EXPECT_SAYS(estimator->GetNoiseModelCheckAsText(2.0 * slope, intercept), "this is not the model of these frames");
  EXPECT_SAYS(ErrorWhen([&] { estimator->GetNoiseModelCheckAsJson(-1.0, 0.0); }), "the variance slope is -1");
  const auto filter = ForwardType::New();
  filter->SetInput(source->GetOutput());
  filter->SetReport(estimator->GetReportOutput());
  filter->Update();
  const auto          stabilised = PixelsOf(filter->GetOutput());
  const std::size_t   pixels = 120 * 100;
  std::vector<double> sums(3);
  std::vector<double> counts(3);
  for (std::size_t p = 0; p < pixels; ++p)
  {
    double mean = 0.0;
    double square = 0.0;
    for (std::size_t t = 0; t < 30; ++t)
    {
      mean += stabilised[t * pixels + p] / 30.0;
    }
    for (std::size_t t = 0; t < 30; ++t)
    {
      square += std::pow(stabilised[t * pixels + p] - mean, 2) / 29.0;
    }
    const std::size_t third = mean < 40.0 ? 0 : mean < 80.0 ? 1 : 2;
    sums[third] += square;
    counts[third] += 1.0;
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    ASSERT_GT(counts[i], 100.0) << i;
    EXPECT_NEAR(sums[i] / counts[i], 1.0, 4.5 * std::sqrt(2.0 / (29.0 * counts[i])) + 0.01) << i;
  }
}
