// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "browser/GainPlan.h"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>

// The planner of the page that measures bursts in a browser: what is enough reaches the goal exactly.

namespace
{
using namespace sensornoise::browser;

PlannedBurst
With(PlannedBurst burst, double contrast, double flickerSd)
{
  burst.contrast = contrast;
  burst.flickerSd = flickerSd;
  return burst;
}
} // namespace

TEST(BrowserPlan, TheLeastContrastReachesTheGoal)
{
  PlannedBurst burst;
  burst.megapixels = 0.5;
  burst.frames = 20.0;
  const GainPlan plan = PlanBurst(burst);
  EXPECT_GT(plan.contrastForGain, 1.0);
  EXPECT_GT(plan.contrastForOffset, 1.0);
  EXPECT_NEAR(PlanBurst(With(burst, plan.contrastForGain, burst.flickerSd)).gainPercent, 1.0, 1e-6);
  EXPECT_NEAR(PlanBurst(With(burst, plan.contrastForOffset, burst.flickerSd)).offsetDn, 1.0, 1e-6);
  EXPECT_LT(PlanBurst(With(burst, 1.01 * plan.contrastForGain, burst.flickerSd)).gainPercent, 1.0);
  EXPECT_LT(PlanBurst(With(burst, 1.01 * plan.contrastForOffset, burst.flickerSd)).offsetDn, 1.0);
}

TEST(BrowserPlan, TheLeastFlickerReachesTheGoal)
{
  PlannedBurst   burst;
  const GainPlan plan = PlanBurst(burst);
  EXPECT_GT(plan.flickerForOffset, 0.0);
  EXPECT_NEAR(PlanBurst(With(burst, burst.contrast, plan.flickerForOffset)).offsetDn, 1.0, 1e-6);
  EXPECT_LT(PlanBurst(With(burst, burst.contrast, 1.01 * plan.flickerForOffset)).offsetDn, 1.0);
  // The standard error of the offset is inversely proportional to the flicker.
  EXPECT_NEAR(plan.flickerForOffset, burst.flickerSd * plan.offsetDn, 1e-6 * burst.flickerSd);
}

TEST(BrowserPlan, AGoalOutOfReachIsInfinite)
{
  PlannedBurst burst;
  burst.megapixels = 0.001;
  burst.frames = 2.0;
  const GainPlan few = PlanBurst(burst);
  EXPECT_TRUE(std::isinf(few.contrastForGain));
  burst = PlannedBurst();
  burst.flickerSd = 0.0;
  const GainPlan steady = PlanBurst(burst);
  EXPECT_TRUE(std::isinf(steady.contrastForOffset));
  EXPECT_TRUE(std::isfinite(steady.flickerForOffset));
  EXPECT_TRUE(std::isfinite(steady.contrastForGain));
  EXPECT_THROW(PlanBurst(With(burst, 0.5, 0.0)), std::invalid_argument);
}
