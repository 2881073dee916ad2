// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"
#include "sensornoise/Report.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/RefinedTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
/** Returns the report of a burst of smooth waves, under flicker, in frames of this size. */
Report
MeasureSized(std::size_t width, std::size_t height)
{
  std::vector<double> scene(width * height);
  for (std::size_t p = 0; p < scene.size(); ++p)
  {
    const auto x = static_cast<double>(p % width);
    const auto y = static_cast<double>(p / width);
    scene[p] = 0.5 + 0.25 * std::sin(0.11 * x + 0.17 * y) + 0.2 * std::sin(0.05 * x - 0.07 * y);
  }
  SimulationSettings settings;
  settings.conditions = { 0.02, 0.0, 0.0 };
  settings.frames = 30;
  settings.seed = 5;
  return Measure(Simulate<std::uint16_t>(settings, width, height, scene)).GetReport();
}
} // namespace

// Frames of a line scan, or of a part of a fast sensor, are narrower than a tile of 16 pixels.
TEST(SensorNoiseNarrowFrames, AreMeasured)
{
  for (const std::size_t side : { 8, 11, 15, 16, 17 })
  {
    SCOPED_TRACE(side);
    for (const Report & report : { MeasureSized(1200, side), MeasureSized(side, 1200) })
    {
      ASSERT_EQ(report.gain.status, EstimateStatus::Identified);
      // Camera B has the gain 1 DN. 4 standard errors.
      EXPECT_NEAR(*report.gain.value, 1.0, 4.0 * *report.gain.standardError);
      EXPECT_LT(*report.gain.standardError, 0.1);
    }
  }
}

TEST(SensorNoiseNarrowFrames, TooFewPixelsEndInAReason)
{
  for (const std::size_t side : { 3, 4, 5, 9, 12, 15 })
  {
    const Report report = MeasureSized(side, side);
    EXPECT_NE(report.gain.status, EstimateStatus::Identified) << side;
    EXPECT_FALSE(report.warnings.empty()) << side;
  }
}
