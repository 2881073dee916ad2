// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "itkNoiseRegressionEstimator.h"
#include "helpers/PipelineTestHelper.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>

namespace
{
using namespace sensornoisetest;
using EstimatorType = itk::NoiseRegressionEstimator<>;
using sensornoise::EstimateStatus;
constexpr double          Gain = 0.75;
constexpr double          Offset = 40.0;
constexpr double          ReadNoise = 6.0;
constexpr double          Intercept = ReadNoise * ReadNoise - Gain * Offset;
constexpr double          NaN = std::numeric_limits<double>::quiet_NaN();
const FrameType::SizeType Size{ { 31, 17 } };

FrameType::Pointer
RandomMean()
{
  std::mt19937_64                        random(3);
  std::uniform_real_distribution<double> uniform(50.0, 3000.0);
  return ImageOf<FrameType>(Size, [&](const auto &) { return uniform(random); });
}

/** Returns the variance g ubar + sigma^2 - g mu of every pixel of a mean. */
template <typename TNoise>
FrameType::Pointer
VarianceOf(const FrameType * mean, const TNoise & noise)
{
  return ImageOf<FrameType>(mean->GetLargestPossibleRegion().GetSize(),
                            [&](const auto & index) { return (Gain * mean->GetPixel(index) + Intercept) * noise(); });
}

EstimatorType::Pointer
ExactEstimator()
{
  const auto mean = RandomMean();
  auto       estimator = EstimatorType::New();
  estimator->SetMean(mean);
  estimator->SetVariance(VarianceOf(mean, [] { return 1.0; }));
  estimator->SetMask(ConstantImage<MaskType>(Size, 1));
  return estimator;
}

/** 527 sums of numbers below 3000 x 2250 round to 527 x 2^-53 = 6e-14 relative; the solution is well conditioned. */
void
ExpectTheLine(const sensornoise::Report & report)
{
  ASSERT_EQ(report.gain.status, EstimateStatus::Identified);
  EXPECT_NEAR(*report.gain.value, Gain, 1e-12);
  EXPECT_NEAR(*report.intercept.value, Intercept, 1e-9);
  EXPECT_EQ(report.intercept.value, report.totalIntercept.value);
}
} // namespace

TEST(NoiseRegressionEstimator, ExactDataAreRecovered)
{
  const auto estimator = ExactEstimator();
  estimator->SetOffset(Offset);
  estimator->Update();
  const sensornoise::Report & report = estimator->GetReport();
  ExpectTheLine(report);
  EXPECT_EQ(report.offset.value, Offset);
  EXPECT_NEAR(*report.readNoise.value, ReadNoise, 1e-9);
  EXPECT_NEAR(*report.readNoiseElectrons.value, ReadNoise / Gain, 1e-9);
  EXPECT_EQ(report.pixels.used, 31u * 17u);
  EXPECT_EQ(report.width, 31u);
  EXPECT_EQ(report.height, 17u);
  EXPECT_FALSE(report.fit.reducedChi2);
  EXPECT_FALSE(report.gain.standardError);
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_EQ(estimator->GetOutput(0), estimator->GetReportOutput());
}

TEST(NoiseRegressionEstimator, WithoutAnOffsetReadNoiseIsNotIdentifiable)
{
  const auto without = ExactEstimator();
  const auto notKnown = ExactEstimator();
  notKnown->SetOffset(NaN);
  for (const auto & estimator : { without, notKnown })
  {
    estimator->Update();
    const sensornoise::Report & report = estimator->GetReport();
    ExpectTheLine(report);
    EXPECT_EQ(report.offset.status, EstimateStatus::NotIdentifiable);
    EXPECT_EQ(report.readNoise.status, EstimateStatus::NotIdentifiable);
    EXPECT_EQ(report.readNoiseElectrons.status, EstimateStatus::NotIdentifiable);
    EXPECT_FALSE(report.offset.value || report.readNoise.value || report.readNoiseElectrons.value);
  }
}

TEST(NoiseRegressionEstimator, LeavesOutMaskedPixelsAndUnknownVariances)
{
  const auto estimator = ExactEstimator();
  auto *     variance = const_cast<FrameType *>(estimator->GetVariance());
  auto *     mask = const_cast<MaskType *>(estimator->GetMask());
  for (std::size_t p = 0; p < 100; ++p)
  {
    variance->GetBufferPointer()[p] = NaN;
    variance->GetBufferPointer()[100 + p] = 1e6;
    mask->GetBufferPointer()[100 + p] = 0;
  }
  estimator->Update();
  ExpectTheLine(estimator->GetReport());
  EXPECT_EQ(estimator->GetReport().pixels.used, 31u * 17u - 200u);
}

TEST(NoiseRegressionEstimator, DataThatContradictTheModelFail)
{
  const auto estimator = ExactEstimator();
  const auto expectFailure = [&](const std::string & part) {
    estimator->Update();
    const sensornoise::Report & report = estimator->GetReport();
    EXPECT_EQ(report.gain.status, EstimateStatus::Failed);
    EXPECT_EQ(report.readNoise.status, EstimateStatus::Failed);
    ASSERT_EQ(report.warnings.size(), 1u);
    EXPECT_EQ(report.warnings[0].code, sensornoise::WarningCode::VarianceNotAffine);
    EXPECT_SAYS(report.warnings[0].message, part);
  };
  estimator->SetVariance(
    ImageOf<FrameType>(Size, [&](const auto & index) { return 9000.0 - 2.0 * estimator->GetMean()->GetPixel(index); }));
  expectFailure("slope -2 DN");
  estimator->SetMask(ConstantImage<MaskType>(Size, 0));
  expectFailure("the 0 pixels of the regression");
}

TEST(NoiseRegressionEstimator, ReadNoiseBelowItsErrorsIsNotIdentifiable)
{
  const auto estimator = ExactEstimator();
  estimator->SetOffset(Offset - 2.0 * ReadNoise * ReadNoise / Gain); // sigma^2 = 36 - 72 < 0
  estimator->Update();
  EXPECT_EQ(estimator->GetReport().offset.status, EstimateStatus::Identified);
  EXPECT_EQ(estimator->GetReport().readNoise.status, EstimateStatus::NotIdentifiable);
  ASSERT_EQ(estimator->GetReport().warnings.size(), 1u);
  EXPECT_EQ(estimator->GetReport().warnings[0].code, sensornoise::WarningCode::ReadNoiseNotIdentifiable);
}

// A sample variance of T frames is V chi^2_n / n with n = T-1. (v - V)^2 / (2 V^2 / n) has the mean 1 and the variance
// 2 + 12/n, so that its average over N pixels has the standard deviation sqrt((2 + 12/n) / N). The standard error of
// the slope is below the standard error of the regression with the largest of all variances, sqrt(2/n) V_max / (sd of
// the mean x sqrt(N)).
TEST(NoiseRegressionEstimator, SampledVariancesAreTestedAsNoise)
{
  constexpr double                      n = 24.0;
  const auto                            mean = RandomMean();
  std::mt19937_64                       random(11);
  std::chi_squared_distribution<double> chiSquared(n);
  const auto                            estimator = EstimatorType::New();
  estimator->SetMean(mean);
  estimator->SetVariance(VarianceOf(mean, [&] { return chiSquared(random) / n; }));
  estimator->SetMask(ConstantImage<MaskType>(Size, 1));
  estimator->SetNumberOfFrames(25);
  estimator->Update();
  const sensornoise::Report & report = estimator->GetReport();
  const double                pixels = 31.0 * 17.0;
  EXPECT_NEAR(*report.fit.reducedChi2, 1.0, 5.0 * std::sqrt((2.0 + 12.0 / n) / pixels));
  EXPECT_NEAR(*report.fit.curvatureZ, 0.0, 5.0);
  const double meanSd = (3000.0 - 50.0) / std::sqrt(12.0);
  EXPECT_NEAR(
    *report.gain.value, Gain, 5.0 * std::sqrt(2.0 / n) * (Gain * 3000.0 + Intercept) / (meanSd * std::sqrt(pixels)));
  EXPECT_EQ(report.frames, 25u);
}

TEST(NoiseRegressionEstimator, WrongInputIsRefused)
{
  const auto estimator = ExactEstimator();
  estimator->SetVariance(ConstantImage<FrameType>({ { 31, 18 } }, 1.0));
  EXPECT_SAYS(ErrorOf(estimator), "[31, 18]");
  EXPECT_SAYS(ErrorOf(estimator), "expected the same");
  estimator->SetVariance(VarianceOf(estimator->GetMean(), [] { return 1.0; }));
  estimator->SetMask(ConstantImage<MaskType>({ { 30, 17 } }, 1));
  EXPECT_SAYS(ErrorOf(estimator), "[30, 17]");
  estimator->SetMask(ConstantImage<MaskType>(Size, 1));
  EXPECT_EQ(ErrorOf(estimator), "no error");
  ExpectTheLine(estimator->GetReport());
  const auto moved = ExactEstimator();
  moved->SetMean(MovedTo<FrameType>({ { 1, 0 } }, moved->GetMean()));
  EXPECT_SAYS(ErrorOf(moved), "expected the same");
}

TEST(NoiseRegressionEstimator, MissingInputsAreNamed)
{
  const auto estimator = ExactEstimator();
  estimator->SetMask(nullptr);
  EXPECT_SAYS(ErrorOf(estimator), "Input Mask is required but not set");
  estimator->SetVariance(nullptr);
  estimator->SetMask(ConstantImage<MaskType>(Size, 1));
  EXPECT_SAYS(ErrorOf(estimator), "Input Variance is required but not set");
  estimator->SetVariance(ConstantImage<FrameType>(Size, 1.0));
  estimator->SetMean(nullptr);
  EXPECT_SAYS(ErrorOf(estimator), "Input Mean is required but not set");
}

TEST(NoiseRegressionEstimator, SecondUpdateDoesNoWorkAndAParameterDoes)
{
  const auto   estimator = ExactEstimator();
  unsigned int runs = 0;
  estimator->AddObserver(itk::EndEvent(), [&runs](const itk::EventObject &) { ++runs; });
  estimator->Update();
  estimator->Update();
  estimator->GetReportOutput()->Update();
  EXPECT_EQ(runs, 1u);
  estimator->SetNumberOfFrames(20);
  estimator->Update();
  EXPECT_EQ(runs, 2u);
  EXPECT_NEAR(*estimator->GetReport().fit.reducedChi2, 0.0, 1e-12);
  estimator->SetOffset(Offset);
  estimator->Update();
  EXPECT_EQ(runs, 3u);
}
