// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <gtest/gtest.h>
#include <string>

namespace
{
/** --method single-image. */
class EstimateSingleImageTool : public EstimateToolTest
{
protected:
  std::string
  Simulate(const std::string & name, const std::string & options)
  {
    EXPECT_EQ(
      RunCommand("\"" + ToolFolder() + "/simulate-sensor-noise\" --reference target --output " + name + " " + options),
      0)
      << m_Message;
    return name;
  }
};

const std::string Method = " --method single-image";
} // namespace

TEST_F(EstimateSingleImageTool, OneFrameGivesTheGainAndNoOffset)
{
  const auto record = ReportOf(Simulate("s.mha", "--size 256x256 --frames 1") + Method);
  EXPECT_EQ(record["method"], "single-image");
  EXPECT_EQ(record["frames"], 1);
  EXPECT_NEAR(record["gain"]["value"], 1.0, 4.0 * record["gain"]["standard_error"].get<double>());
  EXPECT_EQ(record["offset"]["status"], "not-identifiable");
  EXPECT_EQ(record["read_noise"]["status"], "not-identifiable");
  EXPECT_EQ(record["single_image"]["frames"].size(), 1U);
  EXPECT_TRUE(record["single_image"]["mean_image"].is_null());
}

TEST_F(EstimateSingleImageTool, AListAndItsStackHaveTheSameRecord)
{
  const auto stack = Read<StackType>(Path(Simulate("s.mha", "--size 160x160 --frames 3")));
  const auto record = MeasuredTextOf("s.mha" + Method);
  EXPECT_EQ(MeasuredTextOf(Joined(WriteList(stack.GetPointer(), ".tif")) + Method), record);
  EXPECT_EQ(MeasuredTextOf("s.mha --threads 1" + Method), record);
}

TEST_F(EstimateSingleImageTool, PartsOfAStackAreNoted)
{
  const auto record = ReportOf(Simulate("s.mha", "--size 256x256 --frames 3") + Method +
                               " --frames 1:2 --roi 10,20,200,180 --clip 0,4095");
  EXPECT_EQ(record["width"], 200);
  EXPECT_EQ(record["frames"], 1);
  EXPECT_EQ(record["settings"]["roi_x"], 10);
  EXPECT_EQ(record["settings"]["frame_range_first"], 1);
  EXPECT_EQ(record["settings"]["clip_high"], 4095);
}

TEST_F(EstimateSingleImageTool, AMosaicHasFourChannels)
{
  const auto record = ReportOf(Simulate("m.mha", "--size 400x400 --frames 1 --bayer GRBG --transmission 0.6,1,0.4") +
                               Method + " --bayer GRBG --plot page.html");
  ASSERT_EQ(record["channels"].size(), 4U);
  for (const auto & channel : record["channels"])
  {
    EXPECT_EQ(channel["width"], 200);
    EXPECT_NEAR(channel["gain"]["value"], 1.0, 4.0 * channel["gain"]["standard_error"].get<double>());
  }
  EXPECT_NE(ReadText(Path("page.html")).find("single-image"), std::string::npos);
}

TEST_F(EstimateSingleImageTool, OptionsOfOtherMethodsAreRefused)
{
  Simulate("s.mha", "--size 64x64 --frames 1");
  IsRefused("s.mha --offset 100" + Method, { "--offset", "single-image" });
  EXPECT_EQ(Run("s.mha --maps folder" + Method), 2);
  SaysInOneSentence({ "--maps", "single-image" });
  IsRefused("s.mha --level-range 1,2" + Method, { "--level-range", "single-image" });
  IsRefused("s.mha --exposures 1" + Method, { "--exposures", "single-image" });
}
