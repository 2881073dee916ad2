// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "itkNoiseCorrelationEstimator.h"
#include "itkSensorNoiseEstimator.h"
#include "helpers/NoiseCorrelationTestHelper.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::correlation;
using sensornoise::NoiseCorrelationRecord;

/** Errors are a jackknife's, from 20 tiles: Student's 99.9 % quantile for 19 is 3.9. */
constexpr double Z = 4.0;

template <typename TEstimator>
void
ExpectTheSum(const TEstimator & estimator, double truth, double mostError)
{
  EXPECT_EQ(ErrorOf(estimator), "no error");
  EXPECT_NEAR(estimator->GetSumOverLags(), truth, Z * estimator->GetSumOverLagsStandardError());
  EXPECT_GT(estimator->GetSumOverLagsStandardError(), 0.0);
  EXPECT_LT(estimator->GetSumOverLagsStandardError(), mostError);
}

const NoiseCorrelationRecord::Lag *
LagOf(const std::vector<NoiseCorrelationRecord::Lag> & lags, int x, int y, int frames)
{
  for (const auto & lag : lags)
  {
    if (lag.x == x && lag.y == y && lag.frames == frames)
    {
      return &lag;
    }
  }
  return nullptr;
}

void
ExpectTheLag(const NoiseCorrelationRecord::Lag * lag, double truth)
{
  ASSERT_NE(lag, nullptr);
  EXPECT_NEAR(lag->value, truth, Z * lag->standardError);
  // 20480 pixels, 28 freedoms, 3 for weights that fall off at the tiles' borders and for the correlation of neighbours.
  EXPECT_LT(lag->standardError, 3.0 / std::sqrt(20480.0 * 28.0));
}
} // namespace

TEST(NoiseCorrelationEstimator, WhiteNoiseIsWhiteAndSumsToOne)
{
  const auto estimator = CorrelationOf<FloatStack>(FlatStack());
  // Eight neighbours: sqrt(2 x 4 x 2) coefficients' errors.
  ExpectTheSum(estimator, 1.0, 4.0 * 3.0 / std::sqrt(20480.0 * 28.0));
  EXPECT_EQ(estimator->GetKind(), "white");
  const auto & result = estimator->GetResult();
  EXPECT_EQ(result.width, Width);
  EXPECT_EQ(result.height, Height);
  EXPECT_EQ(result.frames, Frames);
  EXPECT_EQ(result.framesUsed, Frames);
  EXPECT_EQ(result.pixelsUsed, 20u * 32u * 32u);
  ExpectTheLag(LagOf(result.correlation.space, 1, 0, 0), 0.0);
  ExpectTheLag(LagOf(result.correlation.time, 0, 0, 1), 0.0);
  EXPECT_EQ(result.correlation.rowNoise.status, sensornoise::EstimateStatus::UpperLimit);
  ASSERT_EQ(result.lights.size(), 4u);
  for (const auto & light : result.lights)
  {
    // The signal is measured from 0: a flat field has no dark pixels. The bins are sorted by the pixels' means.
    EXPECT_NEAR(light.lightDn, Level, Z * NoiseSd / std::sqrt(1.0 * Frames));
    EXPECT_NEAR(light.varianceDn2.value, NoiseSd * NoiseSd, Z * light.varianceDn2.standardError);
  }
  EXPECT_LT(result.lights.front().lightDn, result.lights.back().lightDn);
}

// Weights 1/4, 1/2, 1/4: variance 3/8 of before, lag 1 has 1/4 and lag 2 1/16 of it.
TEST(NoiseCorrelationEstimator, SmoothedNoiseSumsToItsClosedForm)
{
  const auto estimator = CorrelationOf<FloatStack>(FlatStack(Kernels{ { 0.25, 0.5, 0.25 }, { 1.0 } }));
  ExpectTheSum(estimator, 8.0 / 3.0, 0.1);
  EXPECT_EQ(estimator->GetKind(), "filtered");
  const auto & result = estimator->GetResult();
  ExpectTheLag(LagOf(result.correlation.space, 1, 0, 0), 2.0 / 3.0);
  ExpectTheLag(LagOf(result.correlation.space, 2, 0, 0), 1.0 / 6.0);
  ExpectTheLag(LagOf(result.correlation.space, 0, 1, 0), 0.0);
  for (const auto & light : result.lights)
  {
    EXPECT_NEAR(light.varianceDn2.value, 0.375 * NoiseSd * NoiseSd, Z * light.varianceDn2.standardError);
    EXPECT_NEAR(*light.sumOverLags.value, 8.0 / 3.0, Z * *light.sumOverLags.standardError);
  }
}

// The mean of two frames: variance 1/2 of before, frames next to each other have the correlation 1/2. The variance of
// 30 such frames about their own mean is 1 - 1/30 of that, a little less with more series: the sum is relative to it.
TEST(NoiseCorrelationEstimator, MixedFramesGiveTheVarianceOfBefore)
{
  const auto estimator = CorrelationOf<FloatStack>(FlatStack(Kernels{ { 1.0 }, { 0.5, 0.5 } }));
  ExpectTheSum(estimator, 2.0 / (1.0 - 1.0 / 30.0), 0.05);
  EXPECT_EQ(estimator->GetKind(), "temporal");
  ExpectTheLag(LagOf(estimator->GetResult().correlation.time, 0, 0, 1), 0.5);
  for (const auto & light : estimator->GetResult().lights)
  {
    const double error = *light.sumOverLags.standardError / *light.sumOverLags.value;
    EXPECT_NEAR(light.varianceDn2.value * *light.sumOverLags.value / (NoiseSd * NoiseSd), 1.0, Z * error);
  }
}

TEST(NoiseCorrelationEstimator, RoundingIsNoFiltersNoise)
{
  const auto estimator = CorrelationOf<itk::Image<unsigned short, 3>>(
    FlatStack<itk::Image<unsigned short, 3>>(Kernels{ { 0.5, 0.5 }, { 1.0 } }));
  // Half of the variance and 1/12 of rounding, which is in the sum as it was.
  const double before = NoiseSd * NoiseSd;
  ExpectTheSum(estimator, (before + 1.0 / 12.0) / (0.5 * before + 1.0 / 12.0), 0.05);
}

TEST(NoiseCorrelationEstimator, FlickerIsNoNoise)
{
  const auto stack =
    FlatStack({}, [](std::size_t, std::size_t, std::size_t t) { return 2.0 * std::sin(0.5 * static_cast<double>(t)); });
  const auto estimator = CorrelationOf<FloatStack>(stack);
  estimator->Update();
  EXPECT_EQ(estimator->GetKind(), "white");
  estimator->RemoveFrameMeansOff();
  estimator->Update();
  EXPECT_EQ(estimator->GetKind(), "temporal");
}

TEST(NoiseCorrelationEstimator, SeriesAreTakenOut)
{
  std::vector<double> series(Frames);
  for (std::size_t t = 0; t < Frames; ++t)
  {
    // Its mean is 0: the mean image is signal, whose means of frames are removed.
    series[t] = t % 3 == 0 ? 2.0 : -1.0;
  }
  const auto stack = FlatStack({}, [&](std::size_t x, std::size_t y, std::size_t t) {
    // A wave of less than 1/32 cycle per pixel, which is not taken for interference.
    return 3.0 * std::sin(0.1 * static_cast<double>(x)) * std::cos(0.08 * static_cast<double>(y)) * series[t];
  });
  const auto estimator = CorrelationOf<FloatStack>(stack);
  estimator->Update();
  EXPECT_NE(estimator->GetKind(), "white");
  estimator->AddSeries(series);
  EXPECT_EQ(estimator->GetNumberOfSeries(), 1u);
  estimator->Update();
  EXPECT_EQ(estimator->GetKind(), "white");
  estimator->ClearSeries();
  estimator->Update();
  EXPECT_NE(estimator->GetKind(), "white");
}

// The left half is filtered, the right half is not.
TEST(NoiseCorrelationEstimator, MaskedPixelsAreLeftOut)
{
  const auto white = FlatStack();
  const auto smooth = FlatStack(Kernels{ { 0.5, 0.5 }, { 1.0 } });
  const auto stack = ImageOf<FloatStack>({ { Width, Height, Frames } }, [&](const auto & index) {
    return (index[0] < Width / 2 ? smooth : white)->GetPixel(index);
  });
  const auto estimator = CorrelationOf<FloatStack>(stack);
  estimator->Update();
  EXPECT_EQ(estimator->GetKind(), "filtered");
  estimator->SetMask(
    ImageOf<MaskType>({ { Width, Height } }, [](const auto & index) { return index[0] >= Width / 2; }));
  ExpectTheSum(estimator, 1.0, 0.04);
  EXPECT_EQ(estimator->GetKind(), "white");
}

TEST(NoiseCorrelationEstimator, PixelsThatAreNotFiniteAreLeftOut)
{
  const auto stack = FlatStack();
  const auto mask = ImageOf<MaskType>({ { Width, Height } }, [](const auto & index) { return index[0] % 40 != 7; });
  const auto expected = CorrelationOf<FloatStack>(stack);
  expected->SetMask(mask);
  const auto json = JsonOf(expected);
  EXPECT_LT(expected->GetResult().pixelsUsed, 20u * 32u * 32u);
  const auto broken = FlatStack({}, [](std::size_t x, std::size_t, std::size_t t) {
    return x % 40 == 7 && t == 3 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  });
  const auto estimator = CorrelationOf<FloatStack>(broken);
  EXPECT_EQ(JsonOf(estimator), json);
}

TEST(NoiseCorrelationEstimator, EqualFramesCountOnce)
{
  using Stack = itk::Image<unsigned short, 3>;
  const Stack::Pointer once = FlatStack<Stack>();
  const auto           twice = ImageOf<Stack>({ { Width, Height, 2 * Frames } }, [&](const auto & index) {
    return once->GetPixel({ { index[0], index[1], index[2] / 2 } });
  });
  const auto           expected = CorrelationOf<Stack>(once);
  const auto           estimator = CorrelationOf<Stack>(twice);
  expected->Update();
  estimator->Update();
  EXPECT_EQ(estimator->GetResult().frames, 2 * Frames);
  EXPECT_EQ(estimator->GetResult().framesUsed, Frames);
  EXPECT_EQ(estimator->GetKind(), "white");
  EXPECT_EQ(estimator->GetSumOverLags(), expected->GetSumOverLags());
  EXPECT_EQ(estimator->GetSumOverLagsStandardError(), expected->GetSumOverLagsStandardError());
}

TEST(NoiseCorrelationEstimator, FewPixelsAreNotMeasured)
{
  const auto stack = FlatStack({}, [](std::size_t, std::size_t, std::size_t) { return 0.0; }, 40, 20);
  const auto estimator = CorrelationOf<FloatStack>(stack);
  estimator->Update();
  EXPECT_EQ(estimator->GetKind(), "not-measured");
  EXPECT_TRUE(std::isnan(estimator->GetSumOverLags()));
  EXPECT_TRUE(std::isnan(estimator->GetSumOverLagsStandardError()));
  EXPECT_TRUE(estimator->GetResult().lights.empty());
}

TEST(NoiseCorrelationEstimator, IsTheRecordOfTheSensorNoiseEstimator)
{
  const auto estimator =
    estimator::EstimatorOf<estimator::StackType>(TargetStack<estimator::StackType>(Width, Height, Frames));
  estimator->Update();
  ASSERT_NE(estimator->GetNoiseCorrelation(), nullptr);
  EXPECT_EQ(estimator->GetNoiseCorrelation()->kind, estimator->GetReport().noiseCorrelation->kind);
  EXPECT_EQ(estimator->GetNoiseKind(), "white");
  EXPECT_EQ(estimator->GetNoiseCorrelation()->space.size(), 12u);
  estimator->SetMethod("published");
  estimator->Update();
  EXPECT_EQ(estimator->GetNoiseCorrelation(), nullptr);
  EXPECT_EQ(estimator->GetNoiseKind(), "not-measured");
}
