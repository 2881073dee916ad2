// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/StaticScene.h"
#include "sensornoise/Report.h"
#include "helpers/FrameTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr FrameGeometry Geometry{ 256, 192, 1 };
constexpr double        OffsetDn = 300.0;
constexpr double        GainDn = 0.5;
constexpr double        ReadNoiseDn = 3.0;
constexpr double        Dof = 31.0;

double
SensorVariance(double meanDn)
{
  return GainDn * (meanDn - OffsetDn) + ReadNoiseDn * ReadNoiseDn;
}

/** Returns the maps of 32 frames of a wavy scene with levels from 300 to 1700 DN. Pixels above their full well, \a
 * fullDn with the standard deviation \a spreadDn, have its level and the read noise. The others have the variance
 * variance(level). */
StackMaps
MapsOf(double fullDn, double spreadDn, const std::function<double(double)> & variance = SensorVariance)
{
  std::mt19937               random(12);
  std::normal_distribution<> normal;
  std::gamma_distribution<>  gamma(0.5 * Dof, 2.0 / Dof); // variance of 32 frames over its expectation
  StackMaps                  maps;
  maps.mean = WavyScene(Geometry.width, Geometry.height);
  maps.valid.assign(maps.mean.size(), 1);
  for (double & mean : maps.mean)
  {
    const double full = fullDn + spreadDn * normal(random);
    const bool   isFull = mean > full;
    mean = isFull ? full : mean;
    maps.variance.push_back((isFull ? ReadNoiseDn * ReadNoiseDn : variance(mean)) * gamma(random));
  }
  return maps;
}

constexpr double NoWellDn = 1e5;
} // namespace

TEST(SensorNoiseFullWells, LevelAndDispersionAreFound)
{
  for (const double spreadDn : { 2.0, 10.0, 25.0 })
  {
    const auto wells = FindFullWells(MapsOf(1200.0, spreadDn), Geometry);
    ASSERT_TRUE(wells) << spreadDn;
    // Pixels whose scene is not far above their well select low wells: less than a standard deviation.
    EXPECT_NEAR(wells->levelDn, 1200.0, 0.5 * spreadDn + 1.0) << spreadDn;
    EXPECT_NEAR(wells->spreadDn, spreadDn, 0.2 * spreadDn) << spreadDn;
    // Below all wells, less the noise of the pixels, by 4.5 standard deviations of both.
    const double guard = 4.5 * std::hypot(wells->spreadDn, std::sqrt(SensorVariance(1200.0)));
    EXPECT_NEAR(wells->firstLevelDn, wells->levelDn - guard, 0.05 * guard) << spreadDn;
  }
}

TEST(SensorNoiseFullWells, ASensorBelowSaturationHasNone)
{
  EXPECT_FALSE(FindFullWells(MapsOf(NoWellDn, 0.0), Geometry));
  // Read noise alone.
  EXPECT_FALSE(FindFullWells(MapsOf(NoWellDn, 0.0, [](double) { return 9.0; }), Geometry));
  // Flicker of 5 %.
  EXPECT_FALSE(FindFullWells(
    MapsOf(NoWellDn, 0.0, [](double mean) { return SensorVariance(mean) + std::pow(0.05 * (mean - OffsetDn), 2); }),
    Geometry));
}

TEST(SensorNoiseFullWells, AGammaCurveIsNoSaturation)
{
  // Light L after a gamma of 1/2.4: dark levels have more than 20 times the variance of bright ones, but it falls
  // gradually.
  const auto variance = [](double mean) {
    const double light = std::max(0.01, (mean - OffsetDn) / 1400.0);
    return 100.0 * (light + 0.2) * std::pow(light, 2.0 / 2.4 - 2.0); // a fifth of the range is read noise
  };
  ASSERT_GT(variance(OffsetDn), 20.0 * variance(1700.0));
  EXPECT_FALSE(FindFullWells(MapsOf(NoWellDn, 0.0, variance), Geometry));
}

TEST(SensorNoiseFullWells, QuietAreasUnderSteadyIlluminationAreNoSaturation)
{
  // Two light sources: the dim areas flicker by 20 %, the bright ones do not. These have the noise of their own
  // electrons, which is more than the noise of the darkest ones.
  const auto variance = [](double mean) {
    return SensorVariance(mean) + (mean < 1450.0 ? std::pow(0.2 * (mean - OffsetDn), 2) : 0.0);
  };
  EXPECT_FALSE(FindFullWells(MapsOf(NoWellDn, 0.0, variance), Geometry));
}

TEST(SensorNoiseFullWells, PaperBesideThingsThatMoveIsNoSaturation)
{
  // The left two thirds rise to the level of the paper in the right third. Motion adds more to them than noise.
  StackMaps                  maps = MapsOf(NoWellDn, 0.0);
  std::mt19937               random(13);
  std::normal_distribution<> normal(0.0, 2.0);
  for (std::size_t p = 0; p < maps.mean.size(); ++p)
  {
    const double place = 1.5 * static_cast<double>(p % Geometry.width) / static_cast<double>(Geometry.width);
    const double own = SensorVariance(maps.mean[p]);
    maps.mean[p] = OffsetDn + 1300.0 * std::min(1.0, place) + normal(random);
    maps.variance[p] *= (SensorVariance(1600.0) + (place < 1.0 ? 1e4 : 0.0)) / own;
  }
  EXPECT_TRUE(FindFullWells(maps, Geometry)); // by the fall of the variance alone
  maps.summary.dnRange.clipLowDn = 0.0;
  EXPECT_FALSE(FindFullWells(maps, Geometry));
  StackMaps full = MapsOf(1200.0, 10.0);
  full.summary.dnRange.clipLowDn = 0.0;
  EXPECT_TRUE(FindFullWells(full, Geometry));
}

TEST(SensorNoiseFullWells, TooFewPixelsShowNothing)
{
  StackMaps maps = MapsOf(1200.0, 10.0);
  std::fill(maps.valid.begin() + 900, maps.valid.end(), std::uint8_t{ 0 });
  EXPECT_FALSE(FindFullWells(maps, Geometry));
}

TEST(SensorNoiseFullWells, BecomeTheUpperClipLevelOfTheScene)
{
  StackMaps maps = MapsOf(1200.0, 10.0);
  DnRange & dnRange = maps.summary.dnRange;
  dnRange.quantisationStepDn = 1.0;
  dnRange.clipLowDn = 0.0;
  dnRange.clipHighDn = 4095.0;
  for (const bool isFound : { false, true })
  {
    dnRange.SetClipSources(isFound ? "pile-up" : "code range", "code range");
    const StaticScene scene = MakeStaticScene(maps, {}, Geometry, 32, std::vector<double>(32, 900.0), {}, {}).scene;
    ASSERT_FALSE(scene.failureReason);
    ASSERT_TRUE(scene.fullWells);
    EXPECT_EQ(scene.summary.dnRange.clipHighDn, std::round(scene.fullWells->levelDn));
    EXPECT_EQ(scene.summary.dnRange.clipSource,
              std::string("low: ") + (isFound ? "pile-up" : "code range") + ", high: full wells");
    EXPECT_EQ(scene.summary.clippedHigh, scene.summary.clipped);
    std::size_t clipped = 0;
    for (std::size_t p = 0; p < maps.mean.size(); ++p)
    {
      const bool isClipped = scene.pixelUse[p] == static_cast<std::uint8_t>(PixelUse::Clipped);
      clipped += isClipped ? 1 : 0;
      EXPECT_EQ(isClipped, maps.mean[p] > scene.fullWells->firstLevelDn);
      EXPECT_FALSE(scene.frame.usable[p] != 0 && isClipped);
    }
    EXPECT_EQ(scene.summary.clipped, clipped);
    EXPECT_NEAR(scene.model.slopeDn, GainDn, 0.05); // slope of the pixels that are not full
  }
}

TEST(SensorNoiseFullWells, DeadPixelsDoNotHideThem)
{
  StackMaps maps = MapsOf(1200.0, 10.0);
  for (std::size_t p = 0; p < 4 * Geometry.width; ++p)
  {
    maps.mean[p] = 0.0;
    maps.variance[p] = 0.0;
  }
  const auto wells = FindFullWells(maps, Geometry);
  ASSERT_TRUE(wells);
  EXPECT_NEAR(wells->levelDn, 1200.0, 5.0);
}
