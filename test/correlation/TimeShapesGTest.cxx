// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"
#include "helpers/CorrelationTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::correlation;

namespace
{
const FrameGeometry   Frame{ 192, 128, 1 };
constexpr std::size_t Frames = 40;
constexpr double      ReadNoiseDn2 = 100.0;
constexpr double      DarkestDn = 4.0;
constexpr double      BrightestDn = 200.0;
/** Weight of the previous frame in the recursion that correlates noise, and number of frames before the first one. */
constexpr double      Weight = 0.4;
constexpr std::size_t FramesBefore = 12;

/** Returns the frames of out_t = (1 - a) in_t + a out_(t-1) for white noise of variance 1: over all lags together, the
 * covariance is 1, and the variance is (1 - a) / (1 + a). */
std::vector<DoubleFrame>
RecursiveNoise(std::uint64_t seed)
{
  const FrameOf            white = WhiteNoise(Frame, seed);
  std::vector<DoubleFrame> frames;
  DoubleFrame              last = white(0);
  for (std::size_t t = 1; t < Frames + FramesBefore; ++t)
  {
    const DoubleFrame own = white(t);
    for (std::size_t p = 0; p < last.values.size(); ++p)
    {
      last.values[p] = (1.0 - Weight) * own.values[p] + Weight * last.values[p];
    }
    if (t >= FramesBefore)
    {
      frames.push_back(last);
    }
  }
  frames.push_back(last);
  return frames;
}

std::vector<DoubleFrame>
White(std::uint64_t seed)
{
  std::vector<DoubleFrame> frames;
  for (std::size_t t = 0; t < Frames; ++t)
  {
    frames.push_back(WhiteNoise(Frame, seed)(t));
  }
  return frames;
}

/** Returns the correlation of shot noise of 1 DN/e- and read noise, made of two series of frames. */
NoiseCorrelation
Measure(const std::vector<DoubleFrame> & shot, const std::vector<DoubleFrame> & read)
{
  const std::vector<double> signal = Ramp(Frame, DarkestDn, BrightestDn);
  const NoiseResiduals      residuals = ComputeResiduals(Frame, Frames, signal, [&](std::size_t t) {
    DoubleFrame frame = shot[t];
    for (std::size_t p = 0; p < frame.values.size(); ++p)
    {
      frame.values[p] = std::sqrt(signal[p]) * frame.values[p] + std::sqrt(ReadNoiseDn2) * read[t].values[p];
    }
    return frame;
  });
  return MeasureNoiseCorrelation(residuals, 0.0, SerialFor);
}

/** Returns the slope of the covariance with all other frames, averaged over the shapes, for a variance of this slope
 * [DN/e-]. */
double
SlopeOverTime(const NoiseCorrelation & found, double slopeOfVariance)
{
  double slope = 0.0;
  for (const WeightedShape & shape : found.timeShapes)
  {
    slope += shape.probability * shape.coefficient.value * (shape.ofVariance * slopeOfVariance + shape.ofSignal);
  }
  return slope;
}

/** Largest error of the slope: 4.5 standard errors. A sum over 2 x 7 + 1 lags has about sqrt(15) times the relative
 * error of a variance, sqrt(2 / (24576 x 39)) = 0.0015, and its slope along a ramp sqrt(12) times that. */
constexpr double Tolerance = 4.5 * 3.9 * 3.5 * 0.0015;
} // namespace

TEST(SensorNoiseTimeShapes, ReadNoiseThatIsCorrelatedByItselfDoesNotChangeTheSlope)
{
  const NoiseCorrelation found = Measure(White(31), RecursiveNoise(32));
  EXPECT_EQ(found.kind, NoiseKind::Temporal);
  EXPECT_GT(found.timeShapes[static_cast<std::size_t>(CovarianceShape::Constant)].probability, 0.9);
  EXPECT_NEAR(1.0 + SlopeOverTime(found, 1.0), 1.0, Tolerance);
}

TEST(SensorNoiseTimeShapes, ImageLagIsInProportionToTheSignal)
{
  const NoiseCorrelation found = Measure(RecursiveNoise(33), White(34));
  EXPECT_EQ(found.kind, NoiseKind::Temporal);
  const double left = (1.0 - Weight) / (1.0 + Weight);
  EXPECT_NEAR(left + SlopeOverTime(found, left), 1.0, Tolerance);
}

TEST(SensorNoiseTimeShapes, AFilterAfterTheReadOutIsInProportionToTheVariance)
{
  const NoiseCorrelation found = Measure(RecursiveNoise(35), RecursiveNoise(36));
  EXPECT_EQ(found.kind, NoiseKind::Temporal);
  const double left = (1.0 - Weight) / (1.0 + Weight);
  EXPECT_NEAR(left + SlopeOverTime(found, left), 1.0, Tolerance);
}

TEST(SensorNoiseTimeShapes, ImageLagOfBrightPixelsIsFoundWhereMostPixelsAreDark)
{
  // One pixel in four has signal: a lag of 3 % makes a coefficient of 0.022 there, and of 0.0057 over all pixels.
  constexpr double    a = 0.03;
  std::vector<double> signal(Frame.Pixels(), 1.0);
  const auto          shot = White(37);
  const auto          read = White(38);
  for (std::size_t p = 0; p < signal.size(); p += 4)
  {
    signal[p] = 300.0;
  }
  const NoiseResiduals   residuals = ComputeResiduals(Frame, Frames, signal, [&](std::size_t t) {
    DoubleFrame frame = shot[t];
    for (std::size_t p = 0; p < frame.values.size(); ++p)
    {
      const double lagged = t == 0 ? shot[t].values[p] : (1.0 - a) * shot[t].values[p] + a * shot[t - 1].values[p];
      frame.values[p] = std::sqrt(signal[p]) * lagged + std::sqrt(ReadNoiseDn2) * read[t].values[p];
    }
    return frame;
  });
  const NoiseCorrelation found = MeasureNoiseCorrelation(residuals, 0.0, SerialFor);
  EXPECT_LT(found.time[0].coefficient.value, 0.01); // below the threshold of all pixels
  EXPECT_EQ(found.kind, NoiseKind::Temporal);
}
