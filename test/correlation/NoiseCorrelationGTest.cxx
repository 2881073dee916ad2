// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"
#include "correlation/FrameSample.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/CorrelationTestHelper.h"
#include "helpers/SimulatorTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Size = 256;
constexpr std::size_t Frames = 30;

/** Returns the residuals of a static scene with camera B, without quantization. The sensitivity of each pixel drifts by
 * \a driftRms [1] until the last frame. */
NoiseResiduals
ComputeResiduals(const SensorFlaws & flaws, std::size_t size = Size, std::size_t frames = Frames, double driftRms = 0.0)
{
  SimulationSettings settings = simulator::StaticSettings('B', frames);
  settings.flaws = flaws;
  const StackSimulator            simulator(MakeTextureScene(size, size), size, size, settings);
  const std::size_t               pixels = size * size;
  std::vector<double>             stack(pixels * frames);
  std::vector<double>             mean(pixels, 0.0);
  const std::vector<std::uint8_t> take(pixels, 1);
  auto                            sample = FrameSample::Of<double>({ size, size, 1 }, frames);
  for (std::size_t t = 0; t < frames; ++t)
  {
    simulator.RenderFrame(t, stack.data() + t * pixels);
    std::mt19937               random(41);
    std::normal_distribution<> normal;
    const double               drift = driftRms * static_cast<double>(t + 1) / static_cast<double>(frames);
    for (std::size_t p = 0; p < pixels; ++p)
    {
      stack[t * pixels + p] += drift * normal(random) * (stack[t * pixels + p] - settings.camera.offsetDn);
      mean[p] += stack[t * pixels + p] / static_cast<double>(frames);
    }
  }
  sample.AddFrames(stack.data(), 0, frames, mean);
  return { sample.TakeNoise(mean), Eigen::MatrixXd(), { mean, take, settings.camera.offsetDn }, SerialFor };
}

/** Returns the residuals of a dark frame with a few spots of 3 x 3 pixels, whose illumination scatters by \a twinkle
 * [1] from frame to frame, each spot by itself. */
NoiseResiduals
ResidualsOfStars(double twinkle, std::size_t stars = 40, unsigned seed = 5)
{
  constexpr std::size_t           pixels = Size * Size;
  std::mt19937                    random(seed);
  std::normal_distribution<>      normal;
  std::vector<double>             mean(pixels);
  std::vector<double>             stack(pixels * Frames);
  const std::vector<std::uint8_t> take(pixels, 1);
  for (std::size_t t = 0; t < Frames; ++t)
  {
    std::vector<double> signal(pixels, 4.0);
    for (std::size_t star = 0; star < stars; ++star)
    {
      const std::size_t corner = (6 * star + 2) * Size + 37 * star % (Size - 4);
      const double      change = 1.0 + twinkle * normal(random);
      for (std::size_t k = 0; k < 9; ++k)
      {
        signal[corner + k / 3 * Size + k % 3] += 400.0 * change * (k == 4 ? 2.0 : 1.0);
      }
    }
    for (std::size_t p = 0; p < pixels; ++p)
    {
      const double value = signal[p] + std::sqrt(9.0 + signal[p]) * normal(random); // gain 1 DN/e-
      stack[t * pixels + p] = value;
      mean[p] += value / static_cast<double>(Frames);
    }
  }
  auto sample = FrameSample::Of<double>({ Size, Size, 1 }, Frames);
  sample.AddFrames(stack.data(), 0, Frames, mean);
  return { sample.TakeNoise(mean), Eigen::MatrixXd(), { mean, take, 0.0 }, SerialFor };
}

/** Number of frames with which the rings of lags are known within half a per cent, which ends the reach. */
constexpr std::size_t ManyFrames = 100;

NoiseCorrelation
Measure(const SensorFlaws & flaws, std::size_t frames = Frames)
{
  return MeasureNoiseCorrelation(ComputeResiduals(flaws, Size, frames), 0.0, SerialFor);
}

SensorFlaws
With(void (*change)(SensorFlaws &))
{
  SensorFlaws flaws;
  change(flaws);
  return flaws;
}

MeasuredNumber
CoefficientAt(const std::vector<LagCoefficient> & lags, const Lag & at)
{
  const auto found = std::find_if(lags.begin(), lags.end(), [&](const LagCoefficient & lag) {
    return lag.lag.x == at.x && lag.lag.y == at.y && lag.lag.t == at.t;
  });
  return found == lags.end() ? MeasuredNumber{ std::nan(""), 0.0 } : found->coefficient;
}

/** Expects a deviation of at most 4.5 standard errors, and a standard error below \a largestError. */
void
ExpectNumber(const MeasuredNumber & found, double expected, double largestError)
{
  EXPECT_NEAR(found.value, expected, 4.5 * found.standardError);
  EXPECT_GT(found.standardError, 0.0);
  EXPECT_LT(found.standardError, largestError);
}
} // namespace

TEST(SensorNoiseNoiseCorrelation, StarsThatTwinkleAreNotSensorNoise)
{
  const NoiseCorrelation calm = MeasureNoiseCorrelation(ResidualsOfStars(0.0), 0.0, SerialFor);
  EXPECT_EQ(calm.kind, NoiseKind::White);
  EXPECT_EQ(calm.brightCovariance.value, 0.0);
  // The correlation with each of four neighbours is twinkle^2 z^2 / (V + twinkle^2 z^2): 0.13 at 404 DN, 0.24 at 804
  // DN.
  const NoiseCorrelation twinkling = MeasureNoiseCorrelation(ResidualsOfStars(0.02), 0.0, SerialFor);
  EXPECT_EQ(twinkling.kind, NoiseKind::NotLinear);
  EXPECT_FALSE(twinkling.isByIllumination);
  EXPECT_NEAR(twinkling.brightCovariance.value, 4.0 * 0.17, 0.25);
}

TEST(SensorNoiseNoiseCorrelation, FewCalmStarsAreWhite)
{
  // Few pairs of distant bright pixels are left, by which the illumination that they have in common is measured.
  for (unsigned seed = 1; seed <= 12; ++seed)
  {
    const NoiseCorrelation found = MeasureNoiseCorrelation(ResidualsOfStars(0.0, 14, seed), 0.0, SerialFor);
    EXPECT_EQ(found.kind, NoiseKind::White) << seed;
    EXPECT_EQ(found.brightCovariance.value, 0.0) << seed;
  }
}

TEST(SensorNoiseNoiseCorrelation, PlainNoiseIsWhite)
{
  const auto found = Measure({});
  EXPECT_EQ(found.kind, NoiseKind::White);
  EXPECT_FALSE(found.IsCorrelated());
  EXPECT_EQ(found.space.size(), 12U); // half of 5 x 5, without the pixel itself
  EXPECT_EQ(found.time.size(), 3U);
  for (const auto & lags : { found.space, found.time })
  {
    for (const LagCoefficient & lag : lags)
    {
      ExpectNumber(lag.coefficient, 0.0, 0.002); // 1 / sqrt(65536 x 29) = 0.0007; at borders of tiles 0.001
    }
  }
  ExpectNumber(found.rowsDn2, 0.0, 1.0);
  ExpectNumber(found.columnsDn2, 0.0, 1.0);
  EXPECT_NEAR(VarianceInflation(found.space), 1.0, 1e-4);
  EXPECT_EQ(found.timeFactor.value, 1.0);
}

TEST(SensorNoiseNoiseCorrelation, SmoothedFramesAreFilteredAndTheSumIsThatOfTheWeights)
{
  const auto found = Measure(With([](SensorFlaws & flaws) { flaws.smoothing.sdPixels = 0.6; }));
  EXPECT_EQ(found.kind, NoiseKind::Filtered);
  // The sampled kernel. Along each axis it leaves the sum of its squares of the variance of white noise.
  double     weight = 0.0;
  double     square = 0.0;
  double     product = 0.0;
  const auto kernel = [](int x) { return std::exp(-0.5 * x * x / 0.36); };
  for (int x = -4; x <= 4; ++x)
  {
    weight += kernel(x);
    square += kernel(x) * kernel(x);
    product += kernel(x) * kernel(x + 1);
  }
  ExpectNumber(CoefficientAt(found.space, { 1, 0, 0 }), product / square, 0.003);
  ExpectNumber(CoefficientAt(found.space, { -1, 1, 0 }), product * product / (square * square), 0.003);
  const double left = square * square / std::pow(weight, 4.0);
  EXPECT_NEAR(found.Shape(CovarianceShape::Constant).probability, 0.0, 0.1);
  EXPECT_GT(found.Shape(CovarianceShape::Variance).probability, 0.3); // small read noise: other shapes fit, too
  ExpectNumber(found.Shape(CovarianceShape::Variance).coefficient, 1.0 / left - 1.0, 0.05);
  EXPECT_NEAR(VarianceInflation(found.space),
              1.0 + 4.0 * std::pow(product / square, 2.0) + 4.0 * std::pow(product / square, 4.0),
              0.1);
}

TEST(SensorNoiseNoiseCorrelation, CoupledChargeIsCrosstalkProportionalToTheSignal)
{
  constexpr double c = 0.015;
  const auto       found = Measure(With([](SensorFlaws & flaws) { flaws.coupling.fraction = c; }), ManyFrames);
  EXPECT_EQ(found.kind, NoiseKind::Crosstalk);
  // The covariance with all neighbours is the decrease of the shot noise of the pixel, 1 DN/e-.
  const double lost = 1.0 - std::pow(1.0 - 4.0 * c, 2.0) - 4.0 * c * c;
  ExpectNumber(found.Shape(CovarianceShape::Signal).coefficient, lost, 0.02);
  EXPECT_NEAR(1.0 - found.Shape(CovarianceShape::Constant).probability, 1.0, 0.05);
}

TEST(SensorNoiseNoiseCorrelation, RepellingChargeGrowsWithTheSquareOfTheSignal)
{
  constexpr double k = 2e-6; // 8 k Q = 5 % of the variance at 3000 e-
  const auto       found = Measure(With([](SensorFlaws & flaws) { flaws.brighterFatter.perElectron = k; }), ManyFrames);
  EXPECT_EQ(found.kind, NoiseKind::BrighterFatter);
  EXPECT_GT(found.Shape(CovarianceShape::Square).probability, 0.5);
  ExpectNumber(
    found.Shape(CovarianceShape::Square).coefficient, 8.0 * k, 0.2 * 8.0 * k); // to first order, which is 2 % too large
}

TEST(SensorNoiseNoiseCorrelation, SensitivityThatDriftsIsNoFilterOfFrames)
{
  // The noise of the frames is correlated and grows with the square of the signal; a filter makes it grow with the
  // variance.
  const NoiseCorrelation found = MeasureNoiseCorrelation(ComputeResiduals({}, Size, Frames, 0.02), 0.0, SerialFor);
  EXPECT_EQ(found.kind, NoiseKind::NotLinear);
  EXPECT_TRUE(found.isBySensitivity);
}

TEST(SensorNoiseNoiseCorrelation, MixedFramesAreTemporalAndTheSumIsThatOfTheFilter)
{
  constexpr double a = 0.5;
  auto residuals = ComputeResiduals(With([](SensorFlaws & flaws) { flaws.temporalFilter.weight = a; }), 128, 60);
  residuals.DropFirst(8, SerialFor); // the first frame is not filtered
  const auto found = MeasureNoiseCorrelation(residuals, 0.0, SerialFor);
  EXPECT_EQ(found.kind, NoiseKind::Temporal);
  for (int k = 1; k <= 3; ++k)
  {
    ExpectNumber(CoefficientAt(found.time, { 0, 0, k }), std::pow(a, k), 0.01);
  }
  ExpectNumber(found.timeFactor, (1.0 + a) / (1.0 - a), 0.15);
  EXPECT_NEAR(CoefficientAt(found.space, { 1, 0, 0 }).value, 0.0, 0.01);
}

// Each frame is mixed with the frame before, or only where both differ by less than two standard deviations.
TEST(SensorNoiseNoiseCorrelation, FramesThatAreMixedOnlyWhereTheyDifferLittleAreNotLinear)
{
  const FrameGeometry      geometry{ 128, 128, 1 };
  std::vector<DoubleFrame> mixed;
  std::vector<DoubleFrame> reduced;
  for (std::size_t t = 0; t < 60; ++t)
  {
    const DoubleFrame own = NormalFrame(geometry.width, geometry.height, 500 + t);
    mixed.push_back(own);
    reduced.push_back(own);
    for (std::size_t p = 0; t > 0 && p < own.values.size(); ++p)
    {
      mixed[t].values[p] -= 0.5 * (own.values[p] - mixed[t - 1].values[p]);
      const double step = own.values[p] - reduced[t - 1].values[p];
      reduced[t].values[p] -= std::abs(step) < 2.0 ? 0.5 * step : 0.0;
    }
  }
  const std::vector<double> signal(geometry.Pixels(), 100.0);
  const auto                measure = [&](const std::vector<DoubleFrame> & frames) {
    auto residuals = correlation::ComputeResiduals(
      geometry, frames.size() - 10, signal, [&](std::size_t t) { return frames[t + 10]; });
    return MeasureNoiseCorrelation(residuals, 0.0, SerialFor);
  };
  const NoiseCorrelation linear = measure(mixed);
  EXPECT_EQ(linear.kind, NoiseKind::Temporal);
  EXPECT_NEAR(linear.kurtosisOfSteps.value, 0.0, 4.0 * linear.kurtosisOfSteps.standardError);
  EXPECT_LT(linear.kurtosisOfSteps.standardError, 0.02);
  const NoiseCorrelation steps = measure(reduced);
  EXPECT_EQ(steps.kind, NoiseKind::NotLinear);
  EXPECT_TRUE(steps.MixesByDifference());
}

TEST(SensorNoiseNoiseCorrelation, CorrectedDefectsAndMediansAreNotLinear)
{
  EXPECT_EQ(Measure(With([](SensorFlaws & flaws) { flaws.defectCorrection.thresholdSd = 1.5; })).kind,
            NoiseKind::NotLinear);
  EXPECT_EQ(Measure(With([](SensorFlaws & flaws) { flaws.median.radiusPixels = 1; })).kind, NoiseKind::NotLinear);
}

TEST(SensorNoiseNoiseCorrelation, NoiseOfRowsAndColumnsIsSubtractedFromTheCorrelation)
{
  const auto found = Measure(With([](SensorFlaws & flaws) {
    flaws.lineNoise.rowNoiseSdDn = 6.0;
    flaws.lineNoise.columnNoiseSdDn = 3.0;
  }));
  EXPECT_EQ(found.kind, NoiseKind::White);
  // 256 lines, 29 degrees of freedom: 4.5 sqrt(2 / (256 x 29)) = 0.07 of the variance.
  EXPECT_NEAR(found.rowsDn2.value, 36.0, 0.08 * 36.0);
  EXPECT_NEAR(found.columnsDn2.value, 9.0, 0.08 * 9.0 + 4.5 * 0.2); // with the error of the white noise
  for (const LagCoefficient & lag : found.space)
  {
    EXPECT_NEAR(lag.coefficient.value, 0.0, 0.005) << lag.lag.x << " " << lag.lag.y;
  }
}

TEST(SensorNoiseNoiseCorrelation, SmallFramesAndShortStacksAreNotMeasured)
{
  EXPECT_EQ(MeasureNoiseCorrelation(ComputeResiduals({}, 24), 0.0, SerialFor).kind, NoiseKind::NotMeasured);
  EXPECT_EQ(MeasureNoiseCorrelation(ComputeResiduals({}, 64, 3), 0.0, SerialFor).kind, NoiseKind::NotMeasured);
  auto residuals = ComputeResiduals({}, 64);
  residuals.Take(std::vector<std::uint8_t>(64 * 64, 0), SerialFor);
  EXPECT_EQ(MeasureNoiseCorrelation(residuals, 0.0, SerialFor).kind, NoiseKind::NotMeasured);
}

TEST(SensorNoiseNoiseCorrelation, SameBitsForAnyNumberOfThreads)
{
  const auto residuals = ComputeResiduals(With([](SensorFlaws & flaws) { flaws.smoothing.sdPixels = 0.5; }), 128, 12);
  const auto serial = MeasureNoiseCorrelation(residuals, 0.0, SerialFor);
  const auto threads = MeasureNoiseCorrelation(residuals, 0.0, Threads(3));
  ASSERT_EQ(serial.space.size(), threads.space.size());
  for (std::size_t k = 0; k < serial.space.size(); ++k)
  {
    EXPECT_EQ(serial.space[k].coefficient.value, threads.space[k].coefficient.value);
    EXPECT_EQ(serial.space[k].coefficient.standardError, threads.space[k].coefficient.standardError);
  }
  EXPECT_EQ(serial.Shape(CovarianceShape::Variance).coefficient.value,
            threads.Shape(CovarianceShape::Variance).coefficient.value);
  EXPECT_EQ(serial.kurtosis[3].value, threads.kurtosis[3].value);
}
