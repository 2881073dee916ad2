// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifdef SENSORNOISE_OPENCV
#  include "helpers/EstimateToolTestHelper.h"

#  include "itkRGBPixel.h"

/** Runs examples/opencv/stabilise-mats. */
class StabiliseMatsTest : public EstimateToolTest
{
protected:
  int
  RunMats(const std::string & arguments)
  {
    return RunCommand("\"" + ToolFolder() + "/stabilise-mats\" " + arguments);
  }
};

// OpenCV and ITK read the same pixels: every quantity equals the quantity of the tool, to the last digit.
TEST_F(StabiliseMatsTest, MeasuresAsTheTool)
{
  const std::string names = Joined(WriteList<unsigned short>(MakeBurst(24, "96x96"), ".png"));
  ASSERT_EQ(RunMats("mats.json " + names), 0) << m_Message;
  const std::string label = "noise of a stabilised frame: ";
  const auto        found = m_Output.find(label);
  ASSERT_NE(found, std::string::npos) << m_Output;
  // 96 x 95 steps, each in two others as well: a standard error of 0.015
  EXPECT_NEAR(std::stod(m_Output.substr(found + label.size())), 1.0, 0.05);
  const nlohmann::json mats = nlohmann::json::parse(ReadText(Path("mats.json")));
  const nlohmann::json tool = ReportOf(names);
  for (const char * name : { "gain", "offset", "read_noise", "variance_slope", "total_intercept", "flicker" })
  {
    EXPECT_EQ(mats[name], tool[name]) << name;
  }
}

// As a video, by the first file's name and by a pattern, the same 16-bit frames: nothing becomes colour, or 8 bits.
TEST_F(StabiliseMatsTest, VideoOfImagesMeasuresAsTheImages)
{
  const auto names = WriteList<unsigned short>(MakeBurst(24, "96x96"), ".png");
  ASSERT_EQ(RunMats("mats.json " + Joined(names)), 0) << m_Message;
  if (RunMats("first.json --video " + names[0]) != 0 && m_Message.find("videoio, which") != std::string::npos)
  {
    GTEST_SKIP() << m_Message;
  }
  EXPECT_EQ(ReadText(Path("first.json")), ReadText(Path("mats.json"))) << m_Message;
  for (std::size_t t = 0; t < names.size(); ++t)
  {
    std::filesystem::rename(Path(names[t]), Path("from_0_" + std::to_string(t) + ".png"));
  }
  ASSERT_EQ(RunMats("pattern.json --video from_0_%d.png"), 0) << m_Message;
  EXPECT_EQ(ReadText(Path("pattern.json")), ReadText(Path("mats.json")));
  using ColourType = itk::Image<itk::RGBPixel<unsigned char>, 2>;
  Write<ColourType>("c_00.png", Make<ColourType>({ { 16, 16 } }, ColourType::PixelType()));
  EXPECT_EQ(RunMats("none.json --video c_00.png"), 2);
  SaysInOneSentence({ "c_00.png", "3 channels", "not raw" });
  EXPECT_EQ(RunMats("none.json --video none_%03d.png"), 2);
  SaysInOneSentence({ "none_%03d.png", "cannot be opened", "expected a file" });
}

TEST_F(StabiliseMatsTest, ColourIsNotRaw)
{
  using ColourType = itk::Image<itk::RGBPixel<unsigned char>, 2>;
  ColourType::PixelType grey;
  grey.Fill(100);
  const auto colour = Make<ColourType>({ { 16, 16 } }, grey);
  Write<ColourType>("a.png", colour);
  Write<ColourType>("b.png", colour);
  EXPECT_EQ(RunMats("mats.json a.png b.png"), 2);
  SaysInOneSentence({ "a.png", "3 channels", "not raw" });
  EXPECT_EQ(RunMats("mats.json none.png b.png"), 2);
  SaysInOneSentence({ "none.png", "no image" });
  EXPECT_EQ(RunMats("a.png b.png b.png"), 2);
  SaysInOneSentence({ "a.png", "report" });
  EXPECT_EQ(FilesLeft(), (std::set<std::string>{ "a.png", "b.png" }));
}
#endif
