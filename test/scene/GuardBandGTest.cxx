// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/UsablePixels.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/StepResults.h"
#include "helpers/FrameTestHelper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 60;
constexpr std::size_t Height = 50;

struct Scene
{
  SyntheticFrames frames{ Width, Height, std::vector<FrameChange>(20) };
  DnRange         dnRange;

  /** Returns the guard band of frames whose means lie in this range about their average [DN], with a known offset. */
  std::vector<std::uint8_t>
  Guarded(double lowestDn, double highestDn, double offsetDn = 500.0) const
  {
    return this->Guarded({ lowestDn, highestDn, offsetDn, offsetDn, std::numeric_limits<double>::infinity() });
  }
  std::vector<std::uint8_t>
  Guarded(const IlluminationRange & range) const
  {
    return FindGuardBand(frames.reference, frames.model, dnRange, range, SerialFor, 3.0);
  }
};

std::size_t
Count(const std::vector<std::uint8_t> & map)
{
  return static_cast<std::size_t>(std::count(map.begin(), map.end(), std::uint8_t{ 1 }));
}
} // namespace

TEST(SensorNoiseGuardBand, WithoutClipLevelsNothingIsGuarded)
{
  EXPECT_EQ(Count(Scene().Guarded(-100.0, 1e4)), 0u);
}

TEST(SensorNoiseGuardBand, ExtremesOfTheNoiseDecide)
{
  // Steady illumination without motion: level ± 3 sd is compared with the clip levels, half a step inside.
  Scene scene;
  scene.dnRange.clipLowDn = 700.0;
  scene.dnRange.clipHighDn = 1400.0;
  scene.dnRange.quantisationStepDn = 4.0;
  const auto guarded = scene.Guarded(0.0, 0.0);
  ASSERT_GT(Count(guarded), 0u);
  for (std::size_t p = 0; p < guarded.size(); ++p)
  {
    const double level = scene.frames.reference.neighbourMean[p];
    const double reach = 3.0 * std::sqrt(scene.frames.model.NoiseVariance(level));
    const bool   isNear = level + reach >= 1400.0 - 2.0 || level - reach <= 700.0 + 2.0;
    ASSERT_EQ(guarded[p] != 0, scene.frames.take[p] != 0 && isNear) << p;
  }
}

TEST(SensorNoiseGuardBand, BrighterFramesAndMotionWidenTheBand)
{
  Scene scene;
  scene.dnRange.clipHighDn = 1500.0;
  const auto steady = scene.Guarded(0.0, 0.0);
  const auto flickering = scene.Guarded(-50.0, 50.0);
  scene.frames.model.vibrationXPixels2 = 0.5;
  const auto moving = scene.Guarded(-50.0, 50.0);
  EXPECT_LT(Count(steady), Count(flickering));
  EXPECT_LT(Count(flickering), Count(moving));
  for (std::size_t p = 0; p < steady.size(); ++p)
  {
    ASSERT_LE(steady[p], flickering[p]);
    ASSERT_LE(flickering[p], moving[p]);
  }
}

TEST(SensorNoiseGuardBand, LevelsThatAreReachedDecide)
{
  // With the known offset of 500 the darkest frame has a tenth of the signal, and the brightest frame twice the signal.
  Scene scene;
  scene.dnRange.clipLowDn = 505.0;
  scene.dnRange.clipHighDn = 2200.0;
  scene.dnRange.quantisationStepDn = 4.0;
  const InitialNoiseModel & model = scene.frames.model;
  const double              signal = model.centreDn - 500.0;
  const auto                guarded = scene.Guarded(-0.9 * signal, signal);
  ASSERT_GT(Count(guarded), 0u);
  ASSERT_LT(Count(guarded), Count(scene.frames.take) / 2);
  for (std::size_t p = 0; p < guarded.size(); ++p)
  {
    const double own = scene.frames.reference.neighbourMean[p] - 500.0;
    const double low = 500.0 + 0.1 * own;
    const double high = 500.0 + 2.0 * own;
    const bool   isNear = high + 3.0 * std::sqrt(model.NoiseVariance(high)) >= 2200.0 - 2.0 ||
                        low - 3.0 * std::sqrt(model.NoiseVariance(low)) <= 505.0 + 2.0;
    ASSERT_EQ(guarded[p] != 0, scene.frames.take[p] != 0 && isNear) << p;
  }
  // An unknown offset widens the band.
  const auto wider = scene.Guarded({ -0.9 * signal, signal, 450.0, 500.0, std::numeric_limits<double>::infinity() });
  EXPECT_GT(Count(wider), Count(guarded));
  for (std::size_t p = 0; p < guarded.size(); ++p)
  {
    ASSERT_LE(guarded[p], wider[p]);
  }
}
