/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "sensornoise/scene/GuardBand.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/moments/Codes.h"
#include "helpers/FrameTestHelper.h"

#include <algorithm>
#include <cmath>
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
  CodeRange       codes;

  std::vector<std::uint8_t>
  Guarded(double brightest, double darkest, double sds = 3.0) const
  {
    return FindGuardBand(frames.reference, frames.model, codes, brightest, darkest, SerialFor, sds);
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
  EXPECT_EQ(Count(Scene().Guarded(5.0, -1.0)), 0u);
}

TEST(SensorNoiseGuardBand, ExtremesOfTheNoiseDecide)
{
  // Steady light and no motion: level +- 3 sd against the levels, half a code step inside.
  Scene scene;
  scene.codes.clipLowDn = 700.0;
  scene.codes.clipHighDn = 1400.0;
  scene.codes.quantisationStepDn = 4.0;
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
  scene.codes.clipHighDn = 1500.0;
  const auto steady = scene.Guarded(0.0, 0.0);
  const auto flickering = scene.Guarded(0.1, -0.1);
  scene.frames.model.vibrationXPixels2 = 0.5;
  const auto moving = scene.Guarded(0.1, -0.1);
  EXPECT_LT(Count(steady), Count(flickering));
  EXPECT_LT(Count(flickering), Count(moving));
  for (std::size_t p = 0; p < steady.size(); ++p)
  {
    ASSERT_LE(steady[p], flickering[p]);
    ASSERT_LE(flickering[p], moving[p]);
  }
}

TEST(SensorNoiseGuardBand, UnexplainedPixelsAreThoseFarAboveTheModel)
{
  Scene scene;
  scene.frames.model.largestRatio = 3.0;
  auto &     frame = scene.frames.reference;
  const auto setRatio = [&](std::size_t p, double ratio) {
    frame.squares[p] = 19.0 * ratio * scene.frames.model.RawVariance(frame.neighbourMean[p], 0.0, 0.0);
  };
  for (std::size_t p = 0; p < frame.squares.size(); ++p)
  {
    setRatio(p, 1.0);
  }
  EXPECT_EQ(Count(FindUnexplained(frame, scene.frames.model, SerialFor)), 0u);
  const std::size_t lonely = 20 * Width + 20;
  setRatio(lonely, 3.1);
  setRatio(lonely + 10, 2.9);
  const auto alone = FindUnexplained(frame, scene.frames.model, SerialFor);
  EXPECT_EQ(Count(alone), 1u);
  EXPECT_EQ(alone[lonely], 1);
  // A patch that moves takes along the pixels in it whose variance is small by chance, and is told from single pixels.
  for (std::size_t y = 30; y < 37; ++y)
  {
    for (std::size_t x = 30; x < 37; ++x)
    {
      setRatio(y * Width + x, (x + y) % 3 == 0 ? 1.0 : 10.0);
    }
  }
  const auto moving = FindUnexplained(frame, scene.frames.model, SerialFor);
  for (std::size_t y = 30; y < 37; ++y)
  {
    for (std::size_t x = 30; x < 37; ++x)
    {
      EXPECT_EQ(moving[y * Width + x], 2) << x << ' ' << y;
    }
  }
  EXPECT_EQ(moving[33 * Width + 50], 0);
  EXPECT_EQ(moving[lonely], 1);
}
