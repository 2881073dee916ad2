// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RobustnessRun.h"

#include <gtest/gtest.h>

using namespace sensornoise;
using namespace sensornoise::tools;

namespace
{
using StressRun = sensornoise::tools::Run; // a test has a Run() of its own

/** A gain of 1 estimated 2 % too high. */
StressRun
RunOf(StressExpectation expectation, double halfInterval)
{
  StressRun run;
  run.stressCase.expectation = expectation;
  run.gain = 1.0;
  run.report.gain.value = 1.02;
  run.report.gain.interval95 = Interval{ 1.02 - halfInterval, 1.02 + halfInterval };
  run.gainPercent = Compare(run.report.gain, run.gain, 0.01 * run.gain);
  return run;
}
} // namespace

TEST(RobustnessRun, IntervalIsTheCriterionWhereTheResponseBends)
{
  EXPECT_EQ(FindFault(RunOf(StressExpectation::Measured, 0.03)), "gain");
  EXPECT_EQ(FindFault(RunOf(StressExpectation::Bent, 0.03)), "");
  EXPECT_EQ(FindFault(RunOf(StressExpectation::Bent, 0.01)), "gain");
  StressRun refused = RunOf(StressExpectation::Bent, 0.03);
  refused.gainPercent = {};
  EXPECT_EQ(FindFault(refused), "no gain");
  StressRun without = RunOf(StressExpectation::Bent, 0.03);
  without.report.gain.interval95.reset();
  EXPECT_EQ(FindFault(without), "gain");
}
