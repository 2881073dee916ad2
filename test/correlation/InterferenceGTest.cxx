// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/Constants.h"
#include "correlation/NoiseCorrelation.h"
#include "helpers/CorrelationTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

// Sine waves across the frames with a phase of their own in each frame: found, subtracted, and without influence on the
// noise correlation.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::correlation;

namespace
{
constexpr FrameGeometry Geometry{ 160, 160, 1 };
constexpr std::size_t   Frames = 30;
const double            TwoPi = 2.0 * std::acos(-1.0);

struct Wave
{
  double cyclesPerColumn;
  double cyclesPerRow;
  double rmsDn;
};

/** Returns a wave alone, with a phase in each frame that depends on \a number. */
FrameOf
OneWave(const Wave & wave, std::size_t number)
{
  return [=](std::size_t t) {
    DoubleFrame  frame = NormalFrame(Geometry.width, Geometry.height, 0);
    const double phase = TwoPi * NormalFrame(1, 1, 31 * t + number).values.front();
    for (std::size_t p = 0; p < frame.values.size(); ++p)
    {
      const double cycles = wave.cyclesPerColumn * static_cast<double>(p % Geometry.width) +
                            wave.cyclesPerRow * static_cast<double>(p / Geometry.width);
      frame.values[p] = std::sqrt(2.0) * wave.rmsDn * std::sin(TwoPi * cycles + phase);
    }
    return frame;
  };
}

/** Returns the noise \a frameOf with waves. */
FrameOf
WithWaves(const FrameOf & frameOf, const std::vector<Wave> & waves)
{
  return [=](std::size_t t) {
    DoubleFrame frame = frameOf(t);
    for (std::size_t k = 0; k < waves.size(); ++k)
    {
      const DoubleFrame wave = OneWave(waves[k], k)(t);
      std::transform(
        wave.values.begin(), wave.values.end(), frame.values.begin(), frame.values.begin(), std::plus<double>());
    }
    return frame;
  };
}

/** Returns \a frameOf after averaging each pixel with its neighbour on the right. */
FrameOf
Averaged(const FrameOf & frameOf)
{
  return [=](std::size_t t) {
    DoubleFrame frame = frameOf(t);
    for (std::size_t p = 0; p + 1 < frame.values.size(); ++p)
    {
      frame.values[p] = 0.5 * (frame.values[p] + frame.values[p + 1]);
    }
    return frame;
  };
}

NoiseResiduals
ResidualsOf(const FrameOf & frameOf)
{
  return ComputeResiduals(Geometry, Frames, std::vector<double>(Geometry.Pixels(), 100.0), frameOf);
}

double
VarianceOf(const NoiseResiduals & residuals)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < residuals.GetTiles().origins.size(); ++i)
  {
    const float * const squares = residuals.SquaresOf(i);
    sum = std::accumulate(squares, squares + residuals.GetTiles().Pixels(), sum);
  }
  const auto pixels = static_cast<double>(residuals.GetTiles().origins.size() * residuals.GetTiles().Pixels());
  return sum / residuals.GetDof() / pixels;
}

/** Returns the error of the variance of white noise of 1 DN [DN^2]. */
double
ErrorOfVariance(const NoiseResiduals & residuals)
{
  const auto pixels = static_cast<double>(residuals.GetTiles().origins.size() * residuals.GetTiles().Pixels());
  return std::sqrt(2.0 / (residuals.GetDof() * pixels));
}
} // namespace

TEST(SensorNoiseInterference, PowerIsTheSquaredFourierTransform)
{
  constexpr std::size_t side = 16;
  const DoubleFrame     frame = NormalFrame(side, side, 3);
  Eigen::MatrixXd       values(side, side);
  for (std::size_t p = 0; p < frame.values.size(); ++p)
  {
    values(static_cast<Eigen::Index>(p / side), static_cast<Eigen::Index>(p % side)) = frame.values[p];
  }
  const TileSpectrum    spectrum(side);
  const Eigen::ArrayXXd power = spectrum.PowerOf(values);
  ASSERT_EQ(power.rows(), 32);
  for (const auto & [v, u] :
       { std::pair(0, 0), std::pair(3, 5), std::pair(16, 1), std::pair(9, 30), std::pair(31, 16) })
  {
    std::complex<double> sum = 0.0;
    for (std::size_t p = 0; p < frame.values.size(); ++p)
    {
      const double cycles = (v * static_cast<double>(p / side) + u * static_cast<double>(p % side)) / 32.0;
      sum += frame.values[p] * std::polar(1.0, TwoPi * cycles);
    }
    EXPECT_NEAR(power(v, u), std::norm(sum), 1e-9) << v << " " << u;
  }
}

TEST(SensorNoiseInterference, WhiteNoiseHasNoWave)
{
  NoiseResiduals         residuals = ResidualsOf(WhiteNoise(Geometry, 4));
  const NoiseCorrelation found = MeasureWithoutInterference(residuals, 0.0, SerialFor);
  EXPECT_EQ(found.kind, NoiseKind::White);
  EXPECT_TRUE(found.interference.empty());
}

// The spectrum of a filter has no narrow line.
TEST(SensorNoiseInterference, FilterHasNoWave)
{
  NoiseResiduals         residuals = ResidualsOf(Averaged(WhiteNoise(Geometry, 5)));
  const NoiseCorrelation found = MeasureWithoutInterference(residuals, 0.0, SerialFor);
  EXPECT_TRUE(found.IsCorrelated());
  EXPECT_TRUE(found.interference.empty());
}

TEST(SensorNoiseInterference, WavesAreFoundAndSubtracted)
{
  // A slanted wave, an alternation of columns, and one between the frequencies of the spectrum.
  const std::vector<Wave> waves{ { 0.173, 0.091, 0.8 }, { 0.5, 0.0, 0.5 }, { -0.2734, 0.3047, 0.3 } };
  NoiseResiduals          residuals = ResidualsOf(WithWaves(WhiteNoise(Geometry, 6), waves));
  const NoiseCorrelation  found = MeasureWithoutInterference(residuals, 0.0, SerialFor);
  EXPECT_EQ(found.kind, NoiseKind::White);
  ASSERT_EQ(found.interference.size(), waves.size());
  for (std::size_t k = 0; k < waves.size(); ++k)
  {
    // A wave equals the wave of both opposite frequencies, and 0.5 equals -0.5.
    const auto isThis = [&](const PeriodicInterference & wave) {
      const double sign = wave.frequency.cyclesPerColumn * waves[k].cyclesPerColumn < 0.0 ? -1.0 : 1.0;
      return std::abs(sign * wave.frequency.cyclesPerColumn - waves[k].cyclesPerColumn) < 5e-4 &&
             std::abs(sign * wave.frequency.cyclesPerRow - waves[k].cyclesPerRow) < 5e-4;
    };
    const auto wave = std::find_if(found.interference.begin(), found.interference.end(), isThis);
    ASSERT_NE(wave, found.interference.end()) << k;
    const double variance = VarianceOf(ResidualsOf(OneWave(waves[k], k))); // with the phases of these frames
    EXPECT_NEAR(wave->varianceDn2.value, variance, 4.0 * wave->varianceDn2.standardError + 0.005 * variance) << k;
    EXPECT_LT(wave->varianceDn2.standardError, 0.05 * variance) << k;
  }
  EXPECT_NEAR(VarianceOf(residuals), 1.0, 4.0 * ErrorOfVariance(residuals) + 2e-3); // 0.1 % of each wave is left
}

// The regression correlates the noise of a tile by up to 2 / 1024; this is given back.
TEST(SensorNoiseInterference, SubtractionLeavesWhiteNoiseWhite)
{
  NoiseResiduals residuals = ResidualsOf(WhiteNoise(Geometry, 9));
  for (int k = 0; k < 8; ++k)
  {
    residuals.SubtractWave({ 0.1 + 0.002 * k, 0.2 }, SerialFor); // nearly the same in a tile
  }
  EXPECT_NEAR(VarianceOf(residuals), 1.0, 4.0 * ErrorOfVariance(residuals));
  const NoiseCorrelation found = MeasureNoiseCorrelation(residuals, 0.0, SerialFor);
  for (const LagCoefficient & lag : found.space)
  {
    EXPECT_NEAR(lag.coefficient.value, 0.0, 4.5 * lag.coefficient.standardError + 1e-4)
      << lag.lag.x << " " << lag.lag.y;
  }
}

// A wave along the columns is the same in a row: without the correction its subtraction would leave a noise of rows
// below 0, and the correction for that would correlate the pixels of a row.
TEST(SensorNoiseInterference, SubtractionLeavesNoNoiseOfRows)
{
  NoiseResiduals residuals = ResidualsOf(WhiteNoise(Geometry, 9));
  for (int k = 0; k < 8; ++k)
  {
    residuals.SubtractWave({ 0.0, 0.05 + 0.02 * k }, SerialFor);
  }
  const NoiseCorrelation found = MeasureNoiseCorrelation(residuals, 0.0, SerialFor);
  EXPECT_NEAR(found.rowsDn2.value, 0.0, 4.0 * found.rowsDn2.standardError);
  EXPECT_EQ(found.kind, NoiseKind::White);
}

TEST(SensorNoiseInterference, FilteredNoiseKeepsItsCorrelation)
{
  NoiseResiduals         plain = ResidualsOf(Averaged(WhiteNoise(Geometry, 8)));
  NoiseResiduals         disturbed = ResidualsOf(WithWaves(Averaged(WhiteNoise(Geometry, 8)), { { 0.3, 0.2, 0.5 } }));
  const NoiseCorrelation expected = MeasureWithoutInterference(plain, 0.0, SerialFor);
  const NoiseCorrelation found = MeasureWithoutInterference(disturbed, 0.0, SerialFor);
  EXPECT_EQ(found.kind, expected.kind);
  EXPECT_EQ(found.interference.size(), 1U);
  // The same noise: what differs is the part of it in the wave, 2 of 1024 amplitudes.
  EXPECT_NEAR(found.spaceFactor.value, expected.spaceFactor.value, 0.01);
}

TEST(SensorNoiseInterference, StructuredNoiseIsTheSumOfWhatIsSignificant)
{
  NoiseCorrelation correlation;
  correlation.rowsDn2 = { 2.0, 0.1 };
  correlation.columnsDn2 = { 0.2, 0.1 };
  correlation.interference = { { { 0.1, 0.2 }, { 5.0, 0.3 } }, { { 0.3, 0.2 }, { 0.5, 0.4 } } };
  EXPECT_DOUBLE_EQ(correlation.LineNoise().value, 2.0);
  EXPECT_DOUBLE_EQ(correlation.SignificantStructuredNoise().value, 7.0);
  EXPECT_DOUBLE_EQ(correlation.SignificantStructuredNoise().standardError, std::hypot(0.1, 0.3));
}
