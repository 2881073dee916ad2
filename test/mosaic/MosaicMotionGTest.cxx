// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "mosaic/MosaicPasses.h"
#include "refined/RefinedPasses.h"
#include "sensornoise/MosaicMethod.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/Simulator.h"
#include "helpers/StackTestHelper.h"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>

/** \file
 * Planes see edges through every second pixel; all four together find the motion of the sensor. */

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t side = 256; // side of the mosaic [pixel]

/** Returns a camera with a mosaic, and a scene that vibrates with the standard deviations \a sdX and \a sdY [pixel]. */
SimulationSettings
VibratingMosaic(double flickerSd, double sdX, double sdY)
{
  SimulationSettings settings = FlickeringSettings(60);
  settings.conditions = { flickerSd, sdX, sdY };
  settings.flaws.filters.pattern = BayerPattern::RGGB;
  return settings;
}
} // namespace

TEST(MosaicMotion, OfAllPlanesIsThatOfTheSensor)
{
  SimulationSettings settings = VibratingMosaic(0.01, 0.1, 0.05);
  for (const std::uint64_t seed : { 1U, 2U, 3U })
  {
    settings.seed = seed;
    const StackSimulator simulator(MakeTargetScene(side, side), side, side, settings);
    const auto           stack = Simulate<std::uint16_t>(settings, side, side);
    const MosaicGeometry geometry{ { side, side, 1 }, BayerPattern::RGGB };
    using Method = RefinedPasses<std::uint16_t>;
    MosaicPasses<std::uint16_t, Method> method(
      geometry,
      [&](BayerPlane, const ParallelFor & parallelFor) {
        return Method(RefinedSettings(), geometry.Plane(), stack.frames, {}, parallelFor);
      },
      Threads(2));
    while (!method.IsDone())
    {
      method.AddFrames(stack.pixels.data(), stack.frames);
      method.EndPass();
    }
    const auto reports = MakeChannelReports(BayerPattern::RGGB, BayerSource::Given, method.GetReports());
    ASSERT_TRUE(reports.motion);
    const auto & truth = simulator.GetTruth();
    // In pixels of a plane; 3 standard errors.
    EXPECT_NEAR(
      *reports.motion->sdX.value, 0.5 * truth.realisedVibrationSdXPixels, 3.0 * *reports.motion->sdX.standardError)
      << seed;
    EXPECT_NEAR(
      *reports.motion->sdY.value, 0.5 * truth.realisedVibrationSdYPixels, 3.0 * *reports.motion->sdY.standardError)
      << seed;
    EXPECT_LT(*reports.motion->sdX.standardError, 0.03 * *reports.motion->sdX.value);
    for (const Report & channel : reports.channels)
    {
      EXPECT_NEAR(
        *channel.vibrationSdX.value, 0.5 * truth.realisedVibrationSdXPixels, 3.0 * *channel.vibrationSdX.standardError)
        << channel.channel;
    }
  }
}

TEST(MosaicMotion, OfPlanesIsFoundWhereEdgesAreSharperThanTheirPixels)
{
  SimulationSettings settings = VibratingMosaic(0.0088, 0.094, 0.38);
  for (const std::uint64_t seed : { 1U, 2U, 3U })
  {
    settings.seed = seed;
    const StackSimulator simulator(MakeTargetScene(side, side), side, side, settings);
    const auto           stack = Simulate<std::uint16_t>(settings, side, side);
    using Method = MosaicMethod<std::uint16_t, RefinedMethod<std::uint16_t>>;
    Method method(RefinedSettings(), { side, side, 1 }, BayerPattern::RGGB, stack.frames);
    while (!method.IsDone())
    {
      method.AddFrames(stack.pixels.data(), stack.frames);
      method.EndPass();
    }
    const auto & truth = simulator.GetTruth();
    for (const Report & channel : method.GetReports())
    {
      // In pixels of a plane; 3 standard errors, which are at most a fifth.
      const Quantity & sdY = channel.vibrationSdY;
      EXPECT_NEAR(*sdY.value, 0.5 * truth.realisedVibrationSdYPixels, 3.0 * *sdY.standardError) << seed;
      EXPECT_LT(*sdY.standardError, 0.2 * *sdY.value) << seed;
    }
  }
}
