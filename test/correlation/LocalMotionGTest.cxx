// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"
#include "helpers/CorrelationTestHelper.h"
#include "helpers/StackTestHelper.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

// Local motion of the scene, and filters, whose noise does not depend on the slopes of the scene.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::correlation;

namespace
{
constexpr FrameGeometry Geometry{ 192, 128, 1 };
constexpr std::size_t   Frames = 40;
constexpr double        SlopeDn = 20.0; ///< largest slope of the signal [DN/pixel]
constexpr double        Period = 12.0;  ///< period of the signal [pixel]

/** Returns a signal with waves along the rows. */
std::vector<double>
Waves()
{
  std::vector<double> signal;
  for (std::size_t p = 0; p < Geometry.Pixels(); ++p)
  {
    const double turns = static_cast<double>(p % Geometry.width) / Period;
    signal.push_back(1000.0 + SlopeDn * Period / (2.0 * M_PI) * std::sin(2.0 * M_PI * turns));
  }
  return signal;
}

/** Returns white noise of 1 DN in frames in which each strip of 16 rows is displaced independently, by \a rms pixels.
 */
FrameOf
DisplacedRows(double rms)
{
  return [rms](std::size_t t) {
    DoubleFrame frame = NormalFrame(Geometry.width, Geometry.height, 7000 + t);
    for (std::size_t p = 0; p < Geometry.Pixels(); ++p)
    {
      const std::size_t   strip = p / Geometry.width / 16;
      CounterSeededRandom random(11, t, strip);
      const double        slope = SlopeDn * std::cos(2.0 * M_PI * static_cast<double>(p % Geometry.width) / Period);
      frame.values[p] += rms * random.Normal() * slope;
    }
    return frame;
  };
}

/** Returns white noise after a running mean of each value and its right neighbour. */
FrameOf
SmoothedNoise()
{
  return [](std::size_t t) {
    DoubleFrame frame = NormalFrame(Geometry.width, Geometry.height, 9000 + t);
    for (std::size_t p = 0; p + 1 < Geometry.Pixels(); ++p)
    {
      frame.values[p] = 0.5 * (frame.values[p] + frame.values[p + 1]);
    }
    return frame;
  };
}
} // namespace

TEST(SensorNoiseLocalMotion, IsTheMeanSquareOfWhatMoves)
{
  constexpr double     rms = 0.01;
  const double         expected = rms * rms * 0.5 * SlopeDn * SlopeDn; // mean square of a cosine: 0.5
  const MeasuredNumber found =
    FindLocalMotion(ComputeResiduals(Geometry, Frames, Waves(), DisplacedRows(rms)), Threads(3));
  // The variance in the denominator contains the motion, too.
  EXPECT_NEAR(found.value, expected / (1.0 + expected), 4.5 * found.standardError);
  EXPECT_LT(found.standardError, 0.1 * expected);
}

TEST(SensorNoiseLocalMotion, IsNoneOfAFilter)
{
  const MeasuredNumber found = FindLocalMotion(ComputeResiduals(Geometry, Frames, Waves(), SmoothedNoise()), SerialFor);
  EXPECT_NEAR(found.value, 0.0, 4.5 * found.standardError);
  EXPECT_LT(found.standardError, 0.005);
}

TEST(SensorNoiseLocalMotion, IsUnknownWithoutAScene)
{
  const std::vector<double> flat(Geometry.Pixels(), 1000.0);
  EXPECT_EQ(FindLocalMotion(ComputeResiduals(Geometry, Frames, flat, WhiteNoise(Geometry, 3)), SerialFor).value, 0.0);
}
