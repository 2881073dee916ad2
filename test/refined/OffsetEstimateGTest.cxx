// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/GainEstimate.h"
#include "refined/RefinedEstimate.h"
#include "helpers/RefinedResultsTestHelper.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>

// Conditions for an offset from the flicker, and the reasons for a failed estimate, on constructed results.

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
/** Results with a line of gain 1 DN/e- and bounds of 50 and 150 DN. */
struct Results : HandMadeResults
{
  GainEstimate gain;
  OffsetLimits limits;

  Results()
  {
    gain.line.gain = 1.0;
    limits.lowestDn = 50.0;
    limits.highestDn = 150.0;
  }
  OffsetEstimate
  Estimate() const
  {
    return EstimateOffset(this->Get(), gain, limits);
  }
  /** Returns whether the offset is not identifiable, for a reason that begins with \a reason. */
  bool
  IsRefused(const std::string & reason) const
  {
    const OffsetEstimate estimate = this->Estimate();
    return !estimate.IsIdentified() && ReasonOf(estimate, this->Get()).rfind(reason, 0) == 0;
  }
};
} // namespace

TEST(SensorNoiseOffsetEstimate, FlickerDeterminesItWithItsInterval)
{
  const OffsetEstimate offset = Results().Estimate();
  EXPECT_TRUE(offset.IsIdentified());
  EXPECT_DOUBLE_EQ(offset.valueDn, 100.0);
  EXPECT_DOUBLE_EQ(offset.standardErrorDn, 0.5);
  EXPECT_DOUBLE_EQ(*offset.interval.low, 99.0);
  EXPECT_DOUBLE_EQ(*offset.interval.high, 101.0);
}

TEST(SensorNoiseOffsetEstimate, OffsetPatternWidensItInProportionToTheSignal)
{
  Results results;
  results.variance.pattern.offsetFraction = 0.01; // 1 % of 1,000 DN: 10 DN
  const OffsetEstimate offset = results.Estimate();
  EXPECT_DOUBLE_EQ(offset.standardErrorDn, std::hypot(0.5, 10.0));
  EXPECT_DOUBLE_EQ(*offset.interval.low, 99.0 - 19.6);
  EXPECT_DOUBLE_EQ(*offset.interval.high, 101.0 + 19.6);
  results.variance.pattern.offsetFraction = 1e-4; // 0.1 DN: a fifth of the error
  EXPECT_DOUBLE_EQ(results.Estimate().standardErrorDn, 0.5);
}

TEST(SensorNoiseOffsetEstimate, NonlinearResponseWidensIt)
{
  Results results;
  results.gain.below = results.gain.above = 0.02; // 2 % of the gain
  EXPECT_DOUBLE_EQ(results.Estimate().standardErrorDn, std::hypot(0.5, 20.0));
}

TEST(SensorNoiseOffsetEstimate, ReasonOfAnUnidentifiedOffsetIsReported)
{
  const auto refusedWith = [](auto change, const std::string & reason) {
    Results results;
    change(results);
    return results.IsRefused(reason);
  };
  EXPECT_TRUE(refusedWith([](Results & r) { r.reestimated.line.contrast = 0.9; }, "the scene has one intensity"));
  EXPECT_TRUE(refusedWith([](Results & r) { r.reestimated.line.isLevelMotion = true; }, "the scene is a ramp"));
  EXPECT_TRUE(refusedWith([](Results & r) { r.reestimated.line.flickerZ = 6.0; }, "the flicker"));
  EXPECT_TRUE(refusedWith([](Results & r) { r.reestimated.line.low = -std::numeric_limits<double>::infinity(); },
                          "the flicker leaves the offset without bounds"));
  // A quarter of 3,000 DN.
  EXPECT_TRUE(refusedWith([](Results & r) { r.reestimated.line.high = -250.9; }, "the interval of the offset"));
  EXPECT_FALSE(refusedWith([](Results & r) { r.reestimated.line.high = -251.1; }, "the interval of the offset"));
}

TEST(SensorNoiseOffsetEstimate, LimitsHoldButForThreeOfItsErrors)
{
  Results results;
  results.limits.highestDn = 98.4; // 1.6 DN below: 3.2 standard errors
  EXPECT_TRUE(results.IsRefused("the level that does not flicker, 100 DN"));
  results.limits.highestDn = 98.6;
  EXPECT_TRUE(results.Estimate().IsIdentified());
  results.limits.highestDn = 150.0;
  results.limits.lowestDn = 101.6;
  EXPECT_TRUE(results.IsRefused("the level that does not flicker, 100 DN"));
  // The error of the intercept, 0.1 DN^2 over a gain of 1 DN/e-, widens this bound, too.
  results.gain.covariance(1, 1) = 0.01;
  EXPECT_TRUE(results.Estimate().IsIdentified());
}

TEST(SensorNoiseOffsetEstimate, ResponsesToLocalIlluminationDetermineIt)
{
  Results results;
  results.MakeLocal();
  results.reestimated.line.flickerZ = 0.0; // no flicker of the whole frame is needed
  const OffsetEstimate offset = results.Estimate();
  EXPECT_TRUE(offset.IsIdentified());
  EXPECT_DOUBLE_EQ(offset.valueDn, 102.0);
  EXPECT_DOUBLE_EQ(offset.standardErrorDn, 1.0);
  results.reestimated.localOffset->areParallel = true;
  EXPECT_TRUE(results.IsRefused("the level that does not flicker differs from place to place"));
  results.reestimated.localOffset->areParallel = false;
  results.reestimated.localOffset->doLinesMeet = false;
  EXPECT_TRUE(results.IsRefused("areas under different illumination give different offsets"));
  results.reestimated.localOffset.reset();
  EXPECT_TRUE(results.IsRefused("the illumination changes differently over the frame"));
  results.reestimated.isOffsetDrift = true; // then the component is no illumination, and the flicker decides
  EXPECT_TRUE(results.IsRefused("the flicker"));
}

TEST(SensorNoiseOffsetEstimate, OffsetInUseIsKnownOrIdentifiedOrBetweenTheLimits)
{
  Results    results;
  const auto inUse = [&results] {
    return ChooseOffset(results.Get(), results.gain, results.Estimate(), results.limits);
  };
  EXPECT_DOUBLE_EQ(inUse().valueDn, 100.0);
  EXPECT_DOUBLE_EQ(inUse().errorDn, 0.5);
  results.reestimated.line.flickerZ = 0.0;
  EXPECT_DOUBLE_EQ(inUse().valueDn, 100.0); // uniformly distributed from 50 to 150 DN
  EXPECT_DOUBLE_EQ(inUse().errorDn, 100.0 / std::sqrt(12.0));
  results.settings.offset = KnownOffset{ 97.0, 0.2 };
  EXPECT_DOUBLE_EQ(inUse().valueDn, 97.0);
  EXPECT_DOUBLE_EQ(inUse().errorDn, 0.2);
}
