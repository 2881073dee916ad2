// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/OffsetLine.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr Eigen::Index Frames = 60;
constexpr double       Offset = -1000.0; // minus the centre [DN]
constexpr double       LeastStepDn = 1.0;
const ValueRange       Possible{ -4000.0, -950.0, 2 };

/** Returns the line of frames that flicker about the offset, with steps of the offset in some frames. The level at the
 * centre is known within 0.2 DN. */
OffsetLine
LineWithSteps(const std::map<Eigen::Index, double> & steps, double flicker = 0.01, unsigned int seed = 1)
{
  std::mt19937               random(seed);
  std::normal_distribution<> normal;
  OffsetLine                 line;
  line.contrast = 1.0;
  line.illumination << 25.0, 1000.0, 1000.0, 25.0 * 250.0 * 250.0;
  const Eigen::Matrix2d factor = line.illumination.llt().matrixL();
  line.response.resize(Frames, 2);
  for (Eigen::Index t = 0; t < Frames; ++t)
  {
    const double          gamma = flicker * normal(random);
    const auto            step = steps.find(t);
    const Eigen::Vector2d change(-Offset * gamma + (step == steps.end() ? 0.0 : step->second), gamma);
    const Eigen::Vector2d noise(normal(random), normal(random));
    line.response.row(t) = (line.illumination * change + factor * noise).transpose();
  }
  return line;
}

FrameOffsets
Find(const OffsetLine & line)
{
  return FindFrameOffsets(line, Possible, LeastStepDn);
}
} // namespace

TEST(SensorNoiseFrameOffsets, AreFoundWhateverTheFlicker)
{
  const std::map<Eigen::Index, double> steps = { { 3, 25.0 }, { 4, -30.0 }, { 50, 40.0 } };
  for (const double flicker : { 0.0, 0.003, 0.03 })
  {
    EXPECT_EQ(Find(LineWithSteps(steps, flicker)).unlike, (std::vector<std::size_t>{ 3, 4, 50 })) << flicker;
  }
}

TEST(SensorNoiseFrameOffsets, AreNoneWhereFramesFlickerAlone)
{
  for (unsigned int seed = 1; seed <= 100; ++seed)
  {
    EXPECT_TRUE(Find(LineWithSteps({}, seed % 2 == 0 ? 0.0 : 0.02, seed)).unlike.empty()) << seed;
  }
}

TEST(SensorNoiseFrameOffsets, OfAGroupAreAllFoundWithTheirStep)
{
  std::map<Eigen::Index, double> steps;
  for (Eigen::Index t = 40; t < Frames; ++t)
  {
    steps[t] = 15.0;
  }
  const FrameOffsets found = Find(LineWithSteps(steps));
  EXPECT_EQ(found.unlike.size(), 20U);
  EXPECT_NEAR(found.stepDn, 15.0, 1.0);
}

TEST(SensorNoiseFrameOffsets, BelowTheStepThatCountsAreOfTheBurst)
{
  EXPECT_TRUE(FindFrameOffsets(LineWithSteps({ { 7, 20.0 } }), Possible, 30.0).unlike.empty());
}

TEST(SensorNoiseFrameOffsets, AreNotIdentifiableUnderMotionOrWithoutLevels)
{
  OffsetLine line = LineWithSteps({ { 7, 40.0 } });
  ASSERT_EQ(Find(line).unlike.size(), 1U);
  line.isLevelMotion = true;
  EXPECT_TRUE(Find(line).unlike.empty());
  line.isLevelMotion = false;
  line.contrast = 0.5;
  EXPECT_TRUE(Find(line).unlike.empty());
}
