// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ProjectedFrames.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <optional>

using namespace sensornoise;

namespace
{
constexpr std::size_t Pixels = 1000;
constexpr std::size_t Frames = 100;

/** Returns the unit for a noise of 100 DN^2 at all levels, and \a varianceDn2 in all usable pixels. */
std::optional<double>
UnitFor(double varianceDn2)
{
  ReferenceFrame frame;
  frame.frames = Frames;
  frame.mean.assign(Pixels, 1000.0);
  frame.variance = std::vector<double>(Pixels, varianceDn2);
  frame.usable.assign(Pixels, 1);
  frame.usable[7] = 0; // an outlier counts for nothing
  frame.variance.Set(7, 1e9);
  InitialNoiseModel model;
  model.interceptDn2 = 100.0;
  model.slopeDn = 0.0;
  return UnitOfNarrowSums(frame, model);
}
} // namespace

TEST(SensorNoiseNarrowSums, HaveAllBitsWhereTheyFit)
{
  // sqrt(99 * 1e4 + 100) = 995 DN times 2^20 is below 2^31, and 99 % of 2^11 DN is the limit.
  EXPECT_EQ(UnitFor(1e4), TemporalBasis::Unit);
  EXPECT_EQ(UnitFor(0.98 * std::exp2(22.0) / 99.0), TemporalBasis::Unit);
  EXPECT_EQ(UnitFor(1.02 * std::exp2(22.0) / 99.0), TemporalBasis::Unit / 2.0);
}

TEST(SensorNoiseNarrowSums, AreNotEnoughIfTheRoundingChangesTheVariance)
{
  // With the unit U the variance V changes by 99 V / 12 U^2, and the limit is 0.01 sqrt(2 / (100 * 999)) * 100 DN^2.
  const double limit = 0.01 * std::sqrt(2.0 / (100.0 * 999.0)) * 100.0;
  const auto   changeFor = [](double variance, double unit) { return 99.0 * variance / (12.0 * unit * unit); };
  bool         isEnough = true;
  for (double variance = 1e4; variance < 1e9; variance *= 2.0)
  {
    const double unit = std::exp2(std::floor(std::log2(2147483647.0 / std::sqrt(99.0 * variance + 100.0) - 6.0)));
    isEnough = changeFor(variance, std::min(unit, TemporalBasis::Unit)) <= limit;
    ASSERT_EQ(UnitFor(variance).has_value(), isEnough) << variance;
  }
  EXPECT_FALSE(isEnough);
  EXPECT_EQ(UnitFor(1e6), TemporalBasis::Unit / 8.0); // 9950 DN is below 2^14
}

TEST(SensorNoiseNarrowSums, NoUsablePixelNeedsNone)
{
  ReferenceFrame frame;
  frame.frames = Frames;
  frame.mean.assign(Pixels, 1000.0);
  frame.variance = std::vector<double>(Pixels, 1.0);
  frame.usable.assign(Pixels, 0);
  EXPECT_FALSE(UnitOfNarrowSums(frame, InitialNoiseModel()));
}

TEST(SensorNoiseSingleVariance, IsEnoughUntilItsRoundingIsAHundredthOfTheNoise)
{
  // The rounding error of v, 2^-24 v / sqrt(3), over V is 0.01 sqrt(2/T) if v is 41,096 V.
  const auto isEnough = [](double ratio) {
    ReferenceFrame frame;
    frame.frames = Frames;
    frame.mean.assign(Pixels, 1000.0);
    frame.variance = std::vector<double>(Pixels, ratio * 100.0);
    frame.usable.assign(Pixels, 1);
    InitialNoiseModel model;
    model.interceptDn2 = 100.0;
    model.slopeDn = 0.0;
    return IsSingleEnough(frame, model);
  };
  EXPECT_TRUE(isEnough(41000.0));
  EXPECT_FALSE(isEnough(41200.0));
}
