// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <string>

namespace
{
/** --check. */
class EstimateCheckTool : public EstimateToolTest
{
protected:
  /** Simulates a burst of the same camera, or of a camera with other options. */
  std::string
  Burst(const std::string & name,
        int                 seed,
        const std::string & options = "",
        const std::string & stack = "--reference texture --size 128x96 --frames 40")
  {
    EXPECT_EQ(RunCommand("\"" + ToolFolder() + "/simulate-sensor-noise\" --output " + name + " --seed " +
                         std::to_string(seed) + " " + stack + " " + options),
              0)
      << m_Message;
    return name;
  }
};
} // namespace

TEST_F(EstimateCheckTool, ModelIsHeldAgainstOtherFrames)
{
  const std::string frames = Burst("a.mha", 1);
  const auto        same = ReportOf(frames + " --check " + Burst("b.mha", 2, "--flicker-sd 0.02"));
  EXPECT_EQ(same["schema"], "itk-sensornoise-report/1");
  EXPECT_EQ(same["check"]["schema"], "itk-sensornoise-check/1");
  EXPECT_EQ(same["check"]["verdict"], "fits") << same["check"];
  EXPECT_GE(same["check"]["bands"].size(), 5U);
  const auto other = ReportOf(frames + " --check " + Burst("c.mha", 2, "--gain 1.2"));
  EXPECT_EQ(other["check"]["verdict"], "does-not-fit") << other["check"];
  EXPECT_EQ(other["gain"], same["gain"]); // gain of the first frames
}

TEST_F(EstimateCheckTool, WithoutANameOfTheFramesThemselves)
{
  const std::string frames = Burst("a.mha", 1);
  const auto        report = ReportOf(frames);
  EXPECT_FALSE(report.contains("check"));
  const auto checked = ReportOf(frames + " --check");
  EXPECT_EQ(checked["check"]["verdict"], "fits") << checked["check"];
  EXPECT_EQ(checked["total_intercept"], report["total_intercept"]);
  EXPECT_EQ(Run(frames + " --check"), 0) << m_Message;
  EXPECT_NE(m_Output.find("variance/model"), std::string::npos) << m_Output;
  EXPECT_NE(m_Output.find("DN: this model can be used\n"), std::string::npos) << m_Output;
}

// The published method's scatter has its own errors on both sides: frames are measured by the refined method.
TEST_F(EstimateCheckTool, ReportOfThePublishedMethodIsHeldAgainstTheSameVariance)
{
  const std::string frames = Burst("a.mha", 3, "--camera B --condition 3");
  const auto        published = ReportOf(frames + " --method published --check");
  EXPECT_EQ(published["check"], ReportOf(frames + " --method published --check " + frames)["check"]);
  // same frames, the bands of the check of the refined report, and the models' quotient between the ratios
  const auto   refined = ReportOf(frames + " --check");
  const auto & bands = published["check"]["bands"];
  const auto & others = refined["check"]["bands"];
  ASSERT_EQ(bands.size(), others.size());
  const auto variance = [](const nlohmann::json & report, const nlohmann::json & band) {
    const double level = 0.5 * (band["low"].get<double>() + band["high"].get<double>());
    const double slope = report["variance_slope"]["value"];
    const double intercept = report["total_intercept"]["value"];
    return slope * level + intercept;
  };
  for (std::size_t i = 0; i < bands.size(); ++i)
  {
    EXPECT_EQ(bands[i]["pixels"], others[i]["pixels"]);
    const double quotient = variance(refined, bands[i]) / variance(published, bands[i]);
    const double found = bands[i]["variance"].get<double>() / others[i]["variance"].get<double>();
    EXPECT_NEAR(found, quotient, 0.01) << bands[i]; // the band's pixels are not all at its middle
  }
}

TEST_F(EstimateCheckTool, PublishedReportThatIsRightFits)
{
  // a strong and even flicker, on a floor that rests
  const std::string frames = Burst("a.mha", 3, "--flicker-sd 0.05 --vibration-sd 0,0", "--size 160x128 --frames 60");
  const auto        report = ReportOf(frames + " --method published --check");
  EXPECT_EQ(report["check"]["verdict"], "fits") << report["check"];
}

TEST_F(EstimateCheckTool, FramesThatAreNotThereOrGetOverwrittenAreRefused)
{
  const std::string frames = Burst("a.mha", 1);
  EXPECT_EQ(Run(frames + " --check nowhere.mha"), 2);
  EXPECT_NE(m_Message.find("nowhere.mha"), std::string::npos) << m_Message;
  EXPECT_EQ(m_Output, "");
  Burst("b.mha", 2);
  EXPECT_EQ(Run(frames + " --check b.mha --json b.mha"), 2) << m_Output;
}

TEST_F(EstimateCheckTool, FramesAreInspectedBeforeTheReportIsMeasured)
{
  const std::string frames = Burst("a.mha", 1);
  const auto        isRefused = [&](const std::string & options, const std::string & words) {
    EXPECT_EQ(Run(frames + " " + options), 2) << m_Output;
    EXPECT_EQ(m_Message.rfind("error: --check: ", 0), 0U) << m_Message;
    EXPECT_NE(m_Message.find(words), std::string::npos) << m_Message;
  };
  isRefused("--check nowhere.mha", "nowhere.mha: does not exist");
  isRefused("--check " + Burst("few.mha", 2, "", "--size 128x96 --frames 4"), "the stack has 4 frames; expected at");
  const std::string small = Burst("small.mha", 2, "", "--size 64x96 --frames 10");
  isRefused("--roi 0,0,100,90 --check " + small, "but the stack has 64 x 96 pixels");
  const auto mask = Write("mask.mha", Make<itk::Image<unsigned char, 2>>({ { 128, 96 } }, 1).GetPointer());
  isRefused("--mask " + mask + " --check " + small, "128 x 96 pixels, but the frames have 64 x 96");
}

TEST_F(EstimateCheckTool, ReportIsWrittenIfTheFramesCannotBeMeasured)
{
  const std::string frames = Burst("a.mha", 1);
  const std::string bright = Burst("bright.mha", 2, "--bit-depth 14 --offset 6000");
  EXPECT_EQ(Run(frames + " --bit-depth 12 --check " + bright + " --json a.json"), 3) << m_Message;
  EXPECT_NE(m_Message.find("error: the noise model cannot be checked: the data hold the level"), std::string::npos)
    << m_Message;
  const auto report = nlohmann::json::parse(ReadText(Path("a.json")));
  EXPECT_EQ(report["gain"]["status"], "identified");
  EXPECT_FALSE(report.contains("check"));
}

TEST_F(EstimateCheckTool, ExposuresAreOfTheFramesOfTheReport)
{
  std::string exposures;
  for (int t = 0; t < 24; ++t)
  {
    exposures += std::to_string(1 + t % 4) + "\n";
  }
  WriteText("exposures.txt", exposures);
  const std::string options = "--flicker-sd 0.001 --vibration-sd 0,0 --illumination exposures.txt --electrons 500";
  const std::string frames = Burst("a.mha", 1, options, "--size 64x64 --frames 24");
  const auto        report = ReportOf(frames + " --exposures exposures.txt --check " + Burst("b.mha", 2));
  EXPECT_EQ(report["settings"]["exposures"].size(), 24U);
  EXPECT_TRUE(report["check"].contains("verdict")) << report;
}

TEST_F(EstimateCheckTool, ReportWithoutAModelSaysSo)
{
  const auto constant = Write("c.mha", Make<StackType>({ { 32, 32, 10 } }, 500).GetPointer());
  EXPECT_EQ(Run(constant + " --check"), 3);
  EXPECT_NE(m_Message.find("error: the noise model cannot be checked: the report's variance_slope has no value"),
            std::string::npos)
    << m_Message;
}
