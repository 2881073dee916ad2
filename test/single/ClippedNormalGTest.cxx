// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/NoiseLine.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace sensornoise;

namespace
{
/** Moments by the midpoint rule over 10 standard deviations: its error is far below 1e-6 of the unit. */
ClippedMoments
IntegrateClipped(double mean, double sd, const ClipLevels & levels)
{
  constexpr int    steps = 200000;
  constexpr double reach = 10.0;
  double           weight = 0.0;
  double           first = 0.0;
  double           second = 0.0;
  double           inside = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    const double z = -reach + 2.0 * reach * (i + 0.5) / steps;
    const double density = std::exp(-0.5 * z * z);
    const double value = mean + sd * z;
    const double clipped = std::clamp(value, levels.lowDn, levels.highDn);
    weight += density;
    first += density * (clipped - mean);
    second += density * (clipped - mean) * (clipped - mean);
    inside += value == clipped ? density : 0.0;
  }
  first /= weight;
  return { mean + first, second / weight - first * first, inside / weight };
}
} // namespace

TEST(SensorNoiseClippedNormal, MomentsAreThoseOfTheIntegral)
{
  const ClipLevels levels{ 10.0, 30.0 };
  for (const double mean : { 2.0, 9.0, 10.0, 15.0, 20.0, 29.0, 30.0, 36.0 })
  {
    for (const double sd : { 0.5, 3.0, 15.0 })
    {
      const ClippedMoments expected = IntegrateClipped(mean, sd, levels);
      const ClippedMoments moments = MomentsOfClipped(mean, sd, levels);
      EXPECT_NEAR(moments.meanDn, expected.meanDn, 1e-4 * sd) << mean << ' ' << sd;
      EXPECT_NEAR(moments.varianceDn2, expected.varianceDn2, 1e-4 * sd * sd) << mean << ' ' << sd;
      EXPECT_NEAR(moments.unclipped, expected.unclipped, 1e-3) << mean << ' ' << sd;
    }
  }
}

TEST(SensorNoiseClippedNormal, HalfOfTheNoiseAtALevelHasTheClosedForm)
{
  // max(0, z) has the mean 1/sqrt(2 pi) and the variance 1/2 - 1/(2 pi).
  const double         pi = std::acos(-1.0);
  const ClippedMoments moments = MomentsOfClipped(5.0, 2.0, { 5.0, 1e9 });
  EXPECT_NEAR(moments.meanDn, 5.0 + 2.0 / std::sqrt(2.0 * pi), 1e-12);
  EXPECT_NEAR(moments.varianceDn2, 4.0 * (0.5 - 0.5 / pi), 1e-12);
  EXPECT_NEAR(moments.unclipped, 0.5, 1e-12);
}

TEST(SensorNoiseClippedNormal, NothingIsClippedWithoutLevels)
{
  const ClippedMoments moments = MomentsOfClipped(5.0, 2.0, {});
  EXPECT_EQ(moments.meanDn, 5.0);
  EXPECT_EQ(moments.varianceDn2, 4.0);
  EXPECT_EQ(moments.unclipped, 1.0);
}

TEST(SensorNoiseClippedNormal, TheLevelBeforeClippingIsFoundAgain)
{
  const CentredLine line{ 100.0, 2.0, 400.0 };
  const ClipLevels  levels{ 0.0, 1000.0 };
  for (const double level : { -20.0, 0.0, 30.0, 100.0, 700.0, 960.0, 1010.0 })
  {
    const ClippedMoments truth = MomentsOfClipped(level, std::sqrt(std::max(line.At(level), 1.0)), levels);
    const ClippedMoments found = ClippedAtMean(truth.meanDn, line, levels, 1.0);
    EXPECT_NEAR(found.varianceDn2, truth.varianceDn2, 1e-6 * truth.varianceDn2) << level;
    EXPECT_NEAR(found.unclipped, truth.unclipped, 1e-6) << level;
  }
}
