// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"
#include "sensornoise/Simulator.h"
#include "helpers/PublishedTestHelper.h"
#include "helpers/RepeatedTestHelper.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <string>

// Equal frames are counted once: the result has the bits of the result of the distinct frames.

using namespace sensornoise;
using namespace sensornoise::test;

TEST(SensorNoisePublishedRepeatedFrames, AnyWayGiveTheResultOfTheDistinctOnes)
{
  const auto & stack = FlickeringStack();
  const auto   expected = Measure(stack);
  ASSERT_EQ(expected.GetReport().gain.status, EstimateStatus::Identified);
  for (const auto & [name, shown] : WaysToRepeat(stack.frames))
  {
    SCOPED_TRACE(name);
    const auto repeated = Show(stack, shown);
    ExpectResultOfDistinct(Measure(repeated), expected, shown);
    ExpectResultOfDistinct(Measure(repeated, {}, 7, {}, Threads(3)), expected, shown);
  }
}

TEST(SensorNoisePublishedRepeatedFrames, FlickerOfRowsIsThatOfTheDistinctOnes)
{
  SimulationSettings simulation = SettingsOf(0.05, 30);
  simulation.rollingShutterPeriodRows = 40.0;
  const auto        stack = Simulate<float>(simulation, 64, 56, MakeBarsScene(64, 56)); // the row set reaches each row
  PublishedSettings settings;
  settings.rollingShutter = RollingShutter::Fixed;
  settings.sigmaRows = 8.0;
  const auto  expected = Measure(stack, settings);
  const Shown shown = WaysToRepeat(stack.frames)[1].second;
  ASSERT_FALSE(expected.GetReport().flickerRows.empty());
  ExpectResultOfDistinct(Measure(Show(stack, shown), settings), expected, shown);
}

TEST(SensorNoisePublishedRepeatedFrames, TooFewDistinctOnesAreRefused)
{
  const Report report = Measure(Show(FlickeringStack(), Shown{ 0, 1, 2, 3, 0, 1, 2, 3 })).GetReport();
  EXPECT_FALSE(report.IsUsable());
  EXPECT_EQ(report.framesDistinct, 4U);
  EXPECT_TRUE(HasWarning(report, WarningCode::RepeatedFrames));
  EXPECT_EQ(
    report.warnings.back().message,
    "only 4 distinct frames are left, as equal frames are counted once; expected at least 5. Record more frames");
}
