// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"
#include "itkVibrationCovarianceEstimator.h"
#include "helpers/PipelineTestHelper.h"
#include "published/PublishedScene.h"
#include "itkTemporalStatisticsImageFilter.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace
{
using namespace sensornoisetest;
using EstimatorType = itk::VibrationCovarianceEstimator<>;
constexpr double          VarianceX = 0.0025;
constexpr double          VarianceY = 0.0009;
constexpr double          Covariance = -0.0006;
constexpr double          FlickerSd = 0.05;
constexpr unsigned int    Width = 41;
constexpr unsigned int    Height = 37;
const FrameType::SizeType Size{ { Width, Height } };

FrameType::Pointer
TextureMean()
{
  const auto scene = sensornoise::MakeTextureScene(Width, Height);
  return ImageOf<FrameType>(Size, [&](const auto & index) {
    return 100.0 + 3000.0 * scene[static_cast<std::size_t>(index[1] * Width + index[0])];
  });
}

/** Returns the variance that (2.20) gives to a mean: 36 + 0.8 ubar, flicker and vibration. */
FrameType::Pointer
VarianceOf(const FrameType * mean)
{
  auto variance = ConstantImage<FrameType>(Size, 1e9); // the border does not take part
  for (std::size_t y = 1; y + 1 < Height; ++y)
  {
    for (std::size_t x = 1; x + 1 < Width; ++x)
    {
      const std::size_t p = y * Width + x;
      const double      u = mean->GetBufferPointer()[p];
      const auto        gradient = sensornoise::CentredGradient(mean->GetBufferPointer(), Width, p);
      const double      motion = VarianceX * gradient.x * gradient.x + VarianceY * gradient.y * gradient.y +
                            2.0 * Covariance * gradient.x * gradient.y;
      const double flicker = FlickerSd * FlickerSd;
      variance->GetBufferPointer()[p] = 36.0 + 0.8 * u + flicker * u * u + (1.0 + flicker) * motion;
    }
  }
  return variance;
}

EstimatorType::Pointer
ExactEstimator()
{
  const auto mean = TextureMean();
  auto       estimator = EstimatorType::New();
  estimator->SetMean(mean);
  estimator->SetVariance(VarianceOf(mean));
  return estimator;
}

/** 1365 rounded rows and a condition of the scaled normal equations below 1e4: 1365 x 2^-53 x 1e4 < 2e-9 relative. */
void
ExpectTheCovariance(const sensornoise::VibrationCovariance & result, double factor)
{
  ASSERT_TRUE(result.isDetermined);
  EXPECT_NEAR(result.varianceXPixels2, VarianceX * factor, 2e-9 * VarianceX);
  EXPECT_NEAR(result.varianceYPixels2, VarianceY * factor, 2e-9 * VarianceX);
  EXPECT_NEAR(result.covariancePixels2, Covariance * factor, 2e-9 * VarianceX);
  EXPECT_NEAR(result.flickerVariance, FlickerSd * FlickerSd, 2e-9 * FlickerSd);
}
} // namespace

TEST(VibrationCovarianceEstimator, ExactDataAreRecovered)
{
  const auto estimator = ExactEstimator();
  estimator->Update();
  ExpectTheCovariance(estimator->GetResult(), 1.0);
  EXPECT_EQ(estimator->GetResult().pixels, (Width - 2) * (Height - 2));
  EXPECT_EQ(estimator->GetOutput(0), estimator->GetResultOutput());
}

// With sigma_gamma given, its own replaces the regression's in the factor 1 + sigma_gamma^2.
TEST(VibrationCovarianceEstimator, KnownFlickerIsUsedAndReExecutes)
{
  const auto   estimator = ExactEstimator();
  unsigned int runs = 0;
  estimator->AddObserver(itk::EndEvent(), [&runs](const itk::EventObject &) { ++runs; });
  estimator->Update();
  estimator->Update();
  EXPECT_EQ(runs, 1u);
  for (const double sd : { 0.0, 0.3 })
  {
    estimator->SetFlickerSd(sd);
    estimator->Update();
    ExpectTheCovariance(estimator->GetResult(), (1.0 + FlickerSd * FlickerSd) / (1.0 + sd * sd));
  }
  EXPECT_EQ(runs, 3u);
}

TEST(VibrationCovarianceEstimator, PixelsThatAreNotValidAreLeftOut)
{
  const auto estimator = ExactEstimator();
  const auto mask = ConstantImage<MaskType>(Size, 1);
  auto *     variance = const_cast<FrameType *>(estimator->GetVariance());
  for (std::size_t p = 10 * Width + 5; p < 10 * Width + 25; ++p)
  {
    variance->GetBufferPointer()[p] = 1e6;
    mask->GetBufferPointer()[p] = 0;
  }
  estimator->SetValidMask(mask);
  estimator->Update();
  ExpectTheCovariance(estimator->GetResult(), 1.0);
  EXPECT_EQ(estimator->GetResult().pixels, (Width - 2) * (Height - 2) - 20);
}

TEST(VibrationCovarianceEstimator, UnknownPixelsAreLeftOutWithoutAMask)
{
  const auto estimator = ExactEstimator();
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  const_cast<FrameType *>(estimator->GetMean())->GetBufferPointer()[9 * Width + 9] = nan;
  const_cast<FrameType *>(estimator->GetVariance())->GetBufferPointer()[20 * Width + 20] = nan;
  estimator->Update();
  ExpectTheCovariance(estimator->GetResult(), 1.0);
  EXPECT_EQ(estimator->GetResult().pixels, (Width - 2) * (Height - 2) - 6); // with the four that have no gradient
}

TEST(VibrationCovarianceEstimator, EvenSceneHasNoVibration)
{
  const auto estimator = EstimatorType::New();
  estimator->SetMean(ConstantImage<FrameType>(Size, 500.0));
  estimator->SetVariance(ConstantImage<FrameType>(Size, 400.0));
  estimator->Update();
  EXPECT_FALSE(estimator->GetResult().isDetermined);
}

// (2.20) is of first order. Its error is of the order of the squared shift, 0.06^2, times the curvature of the blurred
// scene, which is a few per cent. The sample variance of 60 shifts differs from the variance of the motion by
// sqrt(2/59) = 18 %. The test compares with the realised shifts, which removes this difference.
TEST(VibrationCovarianceEstimator, SimulatedVibrationIsRecovered)
{
  using StackType = itk::Image<float, 3>;
  const auto scene = sensornoise::MakeTextureScene(96, 96);
  const auto source = itk::SensorNoiseStackSource<StackType>::New();
  source->SetReference(ImageOf<FrameType>(
    { { 96, 96 } }, [&](const auto & index) { return scene[static_cast<std::size_t>(index[1] * 96 + index[0])]; }));
  source->SetNumberOfFrames(60);
  source->SetOpticalBlur(2.0);
  source->SetVibrationSdX(0.06);
  source->SetVibrationSdY(0.03);
  source->SetFlickerSd(0.0);
  source->SetSeed(4);
  const auto statistics = itk::TemporalStatisticsImageFilter<StackType>::New();
  statistics->SetInput(source->GetOutput());
  const auto estimator = EstimatorType::New();
  estimator->SetMean(statistics->GetMean());
  estimator->SetVariance(statistics->GetVariance());
  estimator->SetValidMask(statistics->GetValidMask());
  estimator->Update();
  const auto & truth = source->GetTruth();
  EXPECT_NEAR(std::sqrt(estimator->GetResult().varianceXPixels2) / truth.realisedVibrationSdXPixels, 1.0, 0.1);
  EXPECT_NEAR(std::sqrt(estimator->GetResult().varianceYPixels2) / truth.realisedVibrationSdYPixels, 1.0, 0.1);
}

TEST(VibrationCovarianceEstimator, WrongInputIsRefused)
{
  const auto estimator = ExactEstimator();
  estimator->SetValidMask(ConstantImage<MaskType>({ { Width, Height + 1 } }, 1));
  EXPECT_SAYS(ErrorOf(estimator), "expected the same");
  EXPECT_SAYS(ErrorOf(estimator), "expected the same");
  estimator->SetValidMask(nullptr);
  EXPECT_EQ(ErrorOf(estimator), "no error");
  ExpectTheCovariance(estimator->GetResult(), 1.0);
  estimator->SetVariance(ConstantImage<FrameType>({ { Width - 1, Height } }, 1.0));
  EXPECT_SAYS(ErrorOf(estimator), "expected the same");
  estimator->SetVariance(nullptr);
  EXPECT_SAYS(ErrorOf(estimator), "Input Variance is required but not set");
  EXPECT_SAYS(ErrorOf(EstimatorType::New()), "is required but not set");
}
