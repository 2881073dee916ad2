// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMaps.h"
#include "moments/TemporalMoments.h"

#include <cstddef>
#include <gtest/gtest.h>

using namespace sensornoise;

namespace
{
/** Returns pixels with means from \a lowest to \a highest counts, where a count is \a step DN. Their variance is the
 * variance of counts, plus \a readNoise squared [counts^2]. */
TemporalMaps<unsigned short>
MapsOf(double lowest, double highest, double readNoise, double step = 1.0)
{
  TemporalMaps<unsigned short> maps;
  constexpr std::size_t        pixels = 20000;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    const double mean = lowest + (highest - lowest) * static_cast<double>(p) / pixels;
    maps.mean.push_back(step * mean);
    maps.variance.push_back(step * step * (mean + readNoise * readNoise));
    maps.minimum.push_back(-32768);
    maps.maximum.push_back(-32668);
  }
  return maps;
}
} // namespace

TEST(SensorNoiseCountsFromZero, TheirVarianceIsInProportionToTheirMean)
{
  EXPECT_TRUE(AreCountsFromZero(MapsOf(0.1, 30.0, 0.0), 1.0));
  EXPECT_TRUE(AreCountsFromZero(MapsOf(0.1, 30.0, 0.0, 4.0), 4.0));
  EXPECT_TRUE(AreCountsFromZero(MapsOf(5.0, 30.0, 0.0), 1.0));
  EXPECT_FALSE(AreCountsFromZero(MapsOf(0.1, 30.0, 0.3), 1.0));
  EXPECT_FALSE(AreCountsFromZero(MapsOf(0.1, 30.0, 1.0), 1.0));
  EXPECT_FALSE(AreCountsFromZero(MapsOf(5.0, 30.0, 1.0), 1.0));
}

TEST(SensorNoiseCountsFromZero, OneLevelShowsNoCounts)
{
  EXPECT_FALSE(AreCountsFromZero(MapsOf(4.0, 6.0, 0.0), 1.0));
  EXPECT_FALSE(AreCountsFromZero(MapsOf(40.0, 60.0, 0.0), 1.0));
}
