// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/FrameSample.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <vector>

// Echoes: a fraction of the value of a pixel is added to a pixel some columns or rows away, as by a reflection in a
// cable.

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Size = 256;
constexpr std::size_t Frames = 30;

/** Returns the residuals of noise whose values are (1 - c) of a pixel's own and c of the value at \a lag. Where \a
 * inPlaces, only a sixteenth of the frame has the echo. */
NoiseResiduals
ResidualsWithEcho(double c, const Lag & lag, bool inPlaces = false)
{
  constexpr std::size_t      pixels = Size * Size;
  std::mt19937               random(11);
  std::normal_distribution<> normal;
  std::vector<double>        stack(pixels * Frames);
  std::vector<double>        mean(pixels, 0.0);
  std::vector<double>        noise(pixels);
  for (std::size_t t = 0; t < Frames; ++t)
  {
    for (double & value : noise)
    {
      value = 20.0 * normal(random);
    }
    for (std::size_t p = 0; p < pixels; ++p)
    {
      const std::size_t x = (p % Size + Size - static_cast<std::size_t>(lag.x)) % Size;
      const std::size_t y = (p / Size + Size - static_cast<std::size_t>(lag.y)) % Size;
      const double      own = inPlaces && (p % Size >= Size / 4 || p / Size >= Size / 4) ? 0.0 : c;
      stack[t * pixels + p] = 400.0 + static_cast<double>(p % 101) + (1.0 - own) * noise[p] + own * noise[y * Size + x];
      mean[p] += stack[t * pixels + p] / static_cast<double>(Frames);
    }
  }
  const std::vector<std::uint8_t> take(pixels, 1);
  auto                            sample = FrameSample::Of<double>({ Size, Size, 1 }, Frames);
  sample.AddFrames(stack.data(), 0, Frames, mean);
  return { sample.TakeNoise(mean), Eigen::MatrixXd(), { mean, take, 0.0 }, SerialFor };
}
} // namespace

TEST(SensorNoiseEchoes, SumOverTheLagsIsTheVarianceBeforeTheEcho)
{
  for (const Lag & lag : { Lag{ 5, 0, 0 }, Lag{ 0, 3, 0 }, Lag{ 16, 0, 0 } })
  {
    constexpr double       c = 0.05;
    const NoiseCorrelation found = MeasureNoiseCorrelation(ResidualsWithEcho(c, lag), 0.0, SerialFor);
    EXPECT_EQ(found.kind, NoiseKind::Filtered) << lag.x << ' ' << lag.y;
    const double left = (1.0 - c) * (1.0 - c) + c * c; // fraction of the variance
    EXPECT_NEAR(found.spaceFactor.value, 1.0 / left, 4.5 * found.spaceFactor.standardError);
    EXPECT_LT(found.spaceFactor.standardError, 0.02); // three rings of lags at most
    const auto echo = std::find_if(found.space.begin(), found.space.end(), [&](const LagCoefficient & own) {
      return own.lag.x == lag.x && own.lag.y == lag.y;
    });
    ASSERT_NE(echo, found.space.end());
    EXPECT_NEAR(echo->coefficient.value, c * (1.0 - c) / left, 4.5 * echo->coefficient.standardError);
  }
}

TEST(SensorNoiseEchoes, NoiseInPlacesAndWhiteNoiseHaveNone)
{
  EXPECT_EQ(MeasureNoiseCorrelation(ResidualsWithEcho(0.0, { 5, 0, 0 }), 0.0, SerialFor).kind, NoiseKind::White);
  const NoiseCorrelation inPlaces = MeasureNoiseCorrelation(ResidualsWithEcho(0.3, { 5, 0, 0 }, true), 0.0, SerialFor);
  EXPECT_EQ(inPlaces.kind, NoiseKind::White);
}
