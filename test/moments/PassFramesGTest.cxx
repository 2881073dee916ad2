// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackFrames.h"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <sstream>
#include <stdexcept>
#include <vector>

using namespace sensornoise;

namespace
{
/** Returns a pass over five frames to which only frame \a t was added. */
PassFrames
Only(std::size_t t)
{
  PassFrames frames(5);
  frames.Skip(t);
  EXPECT_EQ(frames.Add(1), t);
  return frames;
}
} // namespace

TEST(SensorNoisePassFrames, GivesEachFrameItsPlace)
{
  PassFrames frames(5);
  EXPECT_EQ(frames.GetPass(), 0u);
  EXPECT_EQ(frames.Add(2), 0u);
  frames.Skip(1);
  EXPECT_EQ(frames.Add(2), 3u);
}

TEST(SensorNoisePassFrames, HasNoMoreFramesThanThePass)
{
  PassFrames frames(5);
  EXPECT_THROW(frames.Add(6), std::logic_error);
  EXPECT_THROW(frames.Skip(6), std::logic_error);
  frames.Add(3);
  EXPECT_THROW(frames.Add(3), std::logic_error);
  EXPECT_EQ(frames.Add(2), 3u); // refused frames do not change the next frame
  EXPECT_THROW(frames.Skip(1), std::logic_error);
}

TEST(SensorNoisePassFrames, PassEndsWithAllFramesOnly)
{
  PassFrames frames(5);
  frames.Add(2);
  frames.Skip(1);
  frames.Add(2);
  EXPECT_THROW(frames.EndPass(), std::logic_error);
  frames.Merge(Only(2));
  frames.EndPass();
  EXPECT_EQ(frames.GetPass(), 1u);
  EXPECT_EQ(frames.Add(5), 0u);
}

TEST(SensorNoisePassFrames, AFrameThatIsMissingIsNamed)
{
  PassFrames frames(5);
  frames.Add(3);
  frames.Merge(Only(4));
  try
  {
    frames.EndPass();
    FAIL();
  }
  catch (const std::logic_error & error)
  {
    EXPECT_STREQ(error.what(), "pass 1 held 4 frames; expected 5: frame 3 is missing");
  }
}

TEST(SensorNoisePassFrames, FramesMayComeInAnyOrderAndBeForgotten)
{
  PassFrames frames(5);
  frames.GoTo(3);
  EXPECT_EQ(frames.Add(2), 3u);
  frames.GoTo(0);
  EXPECT_EQ(frames.Add(2), 0u);
  EXPECT_EQ(frames.GetHas(), (std::vector<std::uint8_t>{ 1, 1, 0, 1, 1 }));
  frames.GoTo(1);
  EXPECT_THROW(frames.Add(1), std::logic_error);
  EXPECT_THROW(frames.GoTo(5), std::logic_error);
  frames.Forget();
  EXPECT_EQ(frames.Add(5), 0u);
  frames.EndPass();
  EXPECT_EQ(frames.GetPass(), 1u);
}

TEST(SensorNoisePassFrames, NoFrameComesTwice)
{
  PassFrames frames = Only(1);
  EXPECT_THROW(frames.Merge(Only(1)), std::runtime_error);
  EXPECT_THROW(frames.RequireApart(Only(1)), std::runtime_error);
  EXPECT_NO_THROW(frames.RequireApart(Only(2)));
  frames.Merge(Only(3));
  EXPECT_EQ(frames.Add(1), 2u);
  EXPECT_THROW(frames.Add(1), std::logic_error); // frame 3 was merged
}

TEST(SensorNoisePassFrames, TravelInAStreamOfTheSamePass)
{
  std::stringstream stream;
  Only(4).Save(stream);
  Only(4).Save(stream);
  PassFrames frames(5);
  frames.Merge(frames.ReadOther(stream));
  frames.Add(4);
  frames.EndPass();
  EXPECT_THROW(frames.ReadOther(stream), std::runtime_error); // frames of the previous pass
}
