// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/LagSums.h"
#include "simulation/Random.h"
#include "helpers/CorrelationTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::correlation;

namespace
{
constexpr FrameGeometry Geometry{ 128, 128, 1 };
constexpr std::size_t   Frames = 40;
constexpr double        NoiseDn = 4.0;
constexpr double        BrightestDn = 200.0;

/** Standard deviations of the components that are common to all pixels, to a row or to a column, beside white noise of
 * 4 DN. */
struct Common
{
  double illumination{ 0.0 }; ///< common to all pixels, relative to the signal [1]
  double rowDn{ 0.0 };
  double columnDn{ 0.0 };
};

std::vector<double>
Signal()
{
  return Ramp(Geometry, 0.0, BrightestDn);
}

FrameOf
NoiseWith(const Common & common)
{
  return [=](std::size_t t) {
    DoubleFrame               frame = NormalFrame(Geometry.width, Geometry.height, 900 + t);
    const std::vector<double> signal = Signal();
    CounterSeededRandom       random(17, 3, t);
    const double              flicker = common.illumination * random.Normal();
    std::vector<double>       rows(Geometry.height);
    std::vector<double>       columns(Geometry.width);
    for (double & row : rows)
    {
      row = common.rowDn * random.Normal();
    }
    for (double & column : columns)
    {
      column = common.columnDn * random.Normal();
    }
    for (std::size_t p = 0; p < signal.size(); ++p)
    {
      frame.values[p] =
        NoiseDn * frame.values[p] + flicker * signal[p] + rows[p / Geometry.width] + columns[p % Geometry.width];
    }
    return frame;
  };
}

std::vector<DistantCovariance>
SumDistantSignalCovariance(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  return OfTiles(residuals, parallelFor, [&](std::size_t i) { return SumDistantCovariance(residuals, i); });
}

/** Returns the common illumination, the covariances of rows 0 ... 6 apart, and of columns 0 ... 6 apart. */
JackknifeEstimate
Measure(const FrameOf & noise)
{
  const auto residuals = ComputeResiduals(Geometry, Frames, Signal(), noise);
  return Jackknife(SumDistantSignalCovariance(residuals, SerialFor), [](const DistantCovariance & sums) {
    const CommonNoise common = FindCommonNoise(sums);
    Eigen::VectorXd   figures(1 + 2 * DistantCovariance::Lines);
    figures(0) = common.illumination;
    for (std::size_t d = 0; d < DistantCovariance::Lines; ++d)
    {
      figures(static_cast<Eigen::Index>(1 + d)) = common.rows[d];
      figures(static_cast<Eigen::Index>(1 + DistantCovariance::Lines + d)) = common.columns[d];
    }
    return figures;
  });
}

constexpr Eigen::Index Lines = DistantCovariance::Lines;
} // namespace

TEST(SensorNoiseCommonNoise, WhiteNoiseHasNothingInCommon)
{
  const auto found = Measure(NoiseWith({}));
  ExpectFigure(found, 0, 0.0, 1e-5);
  for (Eigen::Index d = 0; d < 2 * Lines; ++d)
  {
    // Six pairs of segments of 8 pixels in each of 32 rows of 16 tiles: 16 DN^2 / sqrt(6 x 64 x 512 x 39) = 0.006 DN^2.
    ExpectFigure(found, 1 + d, 0.0, 0.02);
  }
}

TEST(SensorNoiseCommonNoise, RowNoiseIsThatOfOneRowAndOfNoColumn)
{
  const auto found = Measure(NoiseWith({ 0.0, 1.0, 0.0 }));
  // 128 rows, 39 degrees of freedom: 4.5 sqrt(2 / (128 x 39)) = 0.09 of the variance.
  EXPECT_NEAR(found.value(1), 1.0, 0.1);
  for (Eigen::Index d = 1; d < 2 * Lines; ++d)
  {
    EXPECT_NEAR(found.value(1 + d), 0.0, 0.07) << d; // half of it, as products of different numbers scatter less
  }
  EXPECT_NEAR(found.value(0), 0.0, 1e-5);
}

TEST(SensorNoiseCommonNoise, ColumnNoiseIsThatOfOneColumnAndOfNoRow)
{
  const auto found = Measure(NoiseWith({ 0.0, 0.0, 1.0 }));
  EXPECT_NEAR(found.value(1 + Lines), 1.0, 0.1);
  for (Eigen::Index d = 0; d < 2 * Lines; ++d)
  {
    EXPECT_NEAR(d == Lines ? 0.0 : found.value(1 + d), 0.0, 0.07) << d;
  }
}

TEST(SensorNoiseCommonNoise, ResidualIlluminationIsTheCoefficientOfTheSquaredSignal)
{
  // 1 % of a mean of 100 DN is 1 DN, as large as the noise of the rows above.
  const auto            white = NoiseWith({});
  const auto            signal = Signal();
  const Eigen::VectorXd wave = Eigen::VectorXd::NullaryExpr(
    Frames, [](Eigen::Index t) { return 0.01 * std::sqrt(2.0) * std::cos(2.1 * static_cast<double>(t)); });
  const auto   found = Measure([&](std::size_t t) {
    DoubleFrame frame = white(t);
    for (std::size_t p = 0; p < signal.size(); ++p)
    {
      frame.values[p] += wave(static_cast<Eigen::Index>(t)) * signal[p];
    }
    return frame;
  });
  const double variance =
    (wave.array() - wave.mean()).square().sum() / (Frames - 1.0); // sample variance of this temporal component
  ExpectFigure(found, 0, variance, 0.03 * variance);
  for (Eigen::Index d = 0; d < 2 * Lines; ++d)
  {
    ExpectFigure(found, 1 + d, 0.0, 0.05);
  }
}

TEST(SensorNoiseCommonNoise, BandsAreCommonToRowsNextToEachOther)
{
  constexpr double turn = 6.283185307179586;
  constexpr double wavenumber = turn / 24.0; // period 24 rows
  const auto       white = NoiseWith({});
  const auto       found = Measure([&](std::size_t t) {
    const double phase = turn * 7.0 * static_cast<double>(t) / Frames; // uniformly distributed, without chance
    DoubleFrame  frame = white(t);
    for (std::size_t p = 0; p < frame.values.size(); ++p)
    {
      frame.values[p] += std::sqrt(2.0) * std::sin(wavenumber * static_cast<double>(p / frame.width) + phase);
    }
    return frame;
  });
  for (Eigen::Index d = 0; d < Lines; ++d)
  {
    // The mean over the frames is 0, but one degree of freedom is subtracted for it.
    const double expected = std::cos(wavenumber * static_cast<double>(d)) * Frames / (Frames - 1.0);
    EXPECT_NEAR(found.value(1 + d), expected, 4.5 * 0.01) << d; // error 0.006 DN^2, with the band 0.01
    // The phases of distant pixels of a column cancel: 16 rows have twice the weight at -1/2, 24 rows once at 1.
    EXPECT_NEAR(found.value(1 + Lines + d), 0.0, 4.5 * 0.01) << d;
  }
}

TEST(SensorNoiseCommonNoise, IsSubtractedFromTheSumsOfItsLag)
{
  CommonNoise common;
  common.illumination = 0.5;
  common.rows = { 3.0, 2.0 };
  common.columns = { 7.0, 0.0, 5.0 };
  LagSums sums;
  for (std::size_t b = 0; b < sums.bins.size(); ++b)
  {
    sums.bins[b] = { 100.0, 40.0, 10.0 + static_cast<double>(b), 20.0, 30.0 };
  }
  const auto taken = [&](const Lag & lag, std::size_t bin) {
    return sums.bins[bin].covariance - common.Subtract(sums, lag).bins[bin].covariance;
  };
  EXPECT_DOUBLE_EQ(taken({ 0, 0, 0 }, 0), 10.0 * (3.0 + 7.0) + 0.5 * 30.0);
  EXPECT_DOUBLE_EQ(taken({ -2, 1, 0 }, 0), 10.0 * (2.0 + 5.0) + 0.5 * 30.0);
  EXPECT_DOUBLE_EQ(taken({ -2, 1, 0 }, 3), 13.0 * (2.0 + 5.0) + 0.5 * 30.0);
  EXPECT_DOUBLE_EQ(taken({ 9, 9, 0 }, 0), 0.5 * 30.0); // lines at this distance are not used
  EXPECT_EQ(common.Subtract(sums, { 1, 1, 0 }).bins[1].pairs, 100.0);
  EXPECT_EQ(common.Subtract(sums, { 1, 1, 0 }).bins[1].square, 30.0);
}

TEST(SensorNoiseCommonNoise, SameBitsForAnyNumberOfThreads)
{
  const auto residuals = ComputeResiduals(Geometry, Frames, Signal(), NoiseWith({ 0.01, 1.0, 1.0 }));
  const auto serial = SumDistantSignalCovariance(residuals, SerialFor);
  const auto threads = SumDistantSignalCovariance(residuals, Threads(3));
  ASSERT_EQ(serial.size(), threads.size());
  for (std::size_t i = 0; i < serial.size(); ++i)
  {
    EXPECT_EQ(serial[i].far.signalCovariance, threads[i].far.signalCovariance);
    EXPECT_EQ(serial[i].rows[2].covariance, threads[i].rows[2].covariance);
    EXPECT_EQ(serial[i].columns[0].covariance, threads[i].columns[0].covariance);
  }
}
