// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"
#include "helpers/CorrelationTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

// Illumination changes that are common to the pixels of a row in a frame, in white noise of 1 DN.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::correlation;

namespace
{
constexpr FrameGeometry Geometry{ 128, 128, 1 };
constexpr std::size_t   Frames = 30;

/** Estimates the mean square of the relative illumination changes of the rows. Their rms is \a sd; the dark offsets of
 * the rows have the rms \a offsetDn. */
MeasuredNumber
FindOfRows(double sd, double offsetDn)
{
  const auto noise = WhiteNoise(Geometry, 5);
  const auto signal = Ramp(Geometry, 50.0, 250.0);
  const auto frame = [&](std::size_t t) {
    DoubleFrame       values = noise(t);
    const DoubleFrame changes = NormalFrame(2, Geometry.height, 77 + t);
    for (std::size_t p = 0; p < values.values.size(); ++p)
    {
      const std::size_t y = p / Geometry.width;
      values.values[p] += sd * changes.values[2 * y] * signal[p] + offsetDn * changes.values[2 * y + 1];
    }
    return values;
  };
  return EstimateLineIlluminationChange(ComputeResiduals(Geometry, Frames, signal, frame), LineAxis::Rows, SerialFor);
}
} // namespace

TEST(SensorNoiseEstimateLineIlluminationChange, ChangesOfRowsAreFound)
{
  // 6e-4 of 150 DN is the noise of the mean of 128 pixels of 1 DN, and half of the noise of the mean of a tile.
  for (const double sd : { 6e-4, 6e-3, 6e-2 })
  {
    const MeasuredNumber square = FindOfRows(sd, 0.0);
    EXPECT_NEAR(square.value, sd * sd, 4.0 * square.standardError) << sd;
    EXPECT_GT(square.value, 6.0 * square.standardError) << sd;
  }
}

TEST(SensorNoiseEstimateLineIlluminationChange, NoiseOfRowsIsNone)
{
  for (const double offsetDn : { 0.0, 0.1, 1.0 })
  {
    const MeasuredNumber square = FindOfRows(0.0, offsetDn);
    EXPECT_NEAR(square.value, 0.0, 4.0 * square.standardError) << offsetDn;
  }
}
