// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <algorithm>
#include <string>
#include <vector>

namespace
{
/** --exposures. */
class EstimateExposuresTool : public EstimateToolTest
{
protected:
  static constexpr unsigned int Frames = 24;

  void
  SetUp() override
  {
    EstimateToolTest::SetUp();
    std::string factors;
    for (unsigned int t = 0; t < Frames; ++t)
    {
      const std::string exposure = ExposureOf(t);
      m_List += (t > 0 ? "," : "") + exposure;
      factors += exposure + "\n";
    }
    WriteText("factors.txt", factors);
    ASSERT_EQ(RunCommand("\"" + ToolFolder() +
                         "/simulate-sensor-noise\" --output s.mha --seed 3 --size 64x64 --flicker-sd 0.001 "
                         "--vibration-sd 0 0 --illumination factors.txt --frames 24 --response quadratic,0.08"),
              0)
      << m_Message;
  }

  /** Six exposures, one after the other, four times. */
  static std::string
  ExposureOf(unsigned int t)
  {
    return std::vector<std::string>{ "0.1", "0.2", "0.4", "0.6", "0.8", "1" }[t % 6];
  }

  std::string m_List;
};
} // namespace

TEST_F(EstimateExposuresTool, ListAndFileSayTheSame)
{
  const nlohmann::json report = ReportOf("s.mha --exposures " + m_List);
  const nlohmann::json linearity = report["linearity"];
  EXPECT_EQ(linearity["status"], "identified");
  EXPECT_EQ(linearity["levels"].size(), 6u);
  EXPECT_EQ(linearity["levels"][0]["frames"], 4);
  // A quadratic response with a size of 8 % deviates from its line by 1.0 to 1.3 % on average; the brightest cells
  // decide.
  EXPECT_NEAR(linearity["linearity_error_percent"]["value"], 1.15, 0.3);
  EXPECT_EQ(report["settings"]["exposures"].size(), Frames);

  std::string table = "file;exposure [s]\r\n# warm\r\n\r\n";
  for (unsigned int t = 0; t < Frames; ++t)
  {
    table += "frame" + std::to_string(t) + ";" + ExposureOf(t) + "\r\n";
  }
  EXPECT_EQ(ReportOf("s.mha --exposures " + WriteText("table.csv", table)), report);
  EXPECT_EQ(ReportOf("s.mha --exposures factors.txt"), report);
}

TEST_F(EstimateExposuresTool, DecimalCommasAreReadBesideOtherSeparators)
{
  const auto with = [](const std::string & header, const std::string & separator, bool hasFrame) {
    std::string text = "# Kamera 1, 2 m; innen\n" + header;
    for (unsigned int t = 0; t < Frames; ++t)
    {
      std::string exposure = ExposureOf(t);
      std::replace(exposure.begin(), exposure.end(), '.', ',');
      text += (hasFrame ? std::to_string(t) + separator : "") + exposure + "\n";
    }
    return text;
  };
  const nlohmann::json report = ReportOf("s.mha --exposures " + m_List);
  EXPECT_EQ(ReportOf("s.mha --exposures " + WriteText("a.csv", with("Bild;Belichtung\n", ";", true))), report);
  EXPECT_EQ(ReportOf("s.mha --exposures " + WriteText("b.tsv", with("", "\t", true))), report);
  IsRefused("s.mha --exposures " + WriteText("c.txt", with("", "", false)),
            { "line 7 of c.txt has 1 columns", "point" });
  IsRefused("s.mha --exposures " + WriteText("d.txt", "0,1\n0,2\n0,4\n"),
            { "each line of d.txt is two whole numbers", "decimal comma", "first line, as frame,exposure" });
  IsRefused("s.mha --exposures " + WriteText("e.txt", "frame,exposure\n0,1\n1,2\n"), { "holds 2 numbers" });
}

TEST_F(EstimateExposuresTool, FramesThatAreLeftOutTakeTheirExposuresAlong)
{
  const nlohmann::json report = ReportOf("s.mha --frames 1:19 --exposures " + m_List);
  EXPECT_EQ(report["settings"]["exposures"].size(), 18u);
  EXPECT_EQ(report["settings"]["exposures"][0], 0.2);
  EXPECT_EQ(report["linearity"]["levels"][0]["frames"], 3);
}

TEST_F(EstimateExposuresTool, WithoutThemLinearityIsNotIdentifiable)
{
  const nlohmann::json linearity = ReportOf("s.mha")["linearity"];
  EXPECT_EQ(linearity["status"], "not-identifiable");
  EXPECT_EQ(linearity["reason"], "no exposures were given");
  EXPECT_EQ(linearity["linearity_error_percent"]["status"], "not-identifiable");
}

TEST_F(EstimateExposuresTool, WrongUseIsRefused)
{
  IsRefused("s.mha --exposures 1,2,3", { "--exposures holds 3 numbers", "there are 24 frames" });
  IsRefused("s.mha --frames 0:20 --exposures 1,2,3", { "there are 24 frames", "--frames leaves out" });
  IsRefused("s.mha --exposures no.csv", { "no.csv", "neither a list of numbers with commas nor a file" });
  IsRefused("s.mha --method published --exposures " + m_List, { "--exposures", "--method refined" });
  IsRefused("s.mha --exposures=-" + m_List, { "the exposure of frame 0 is -0.1" });
  const auto ofFile = [this](const std::string & text, const std::vector<std::string> & parts) {
    IsRefused("s.mha --exposures " + WriteText("e.csv", text), parts);
  };
  ofFile("t,e\n0,1\n1,2\n2\n", { "line 4 of e.csv has 1 columns", "expected 2" });
  ofFile("t,e\n0,1\n1,two\n", { "line 3 of e.csv ends with \"two\"", "expected a number" });
  ofFile("only a header\n", { "holds no exposures" });
}

TEST_F(EstimateExposuresTool, TheFileIsNotOverwritten)
{
  std::string text = m_List;
  std::replace(text.begin(), text.end(), ',', '\n');
  IsRefused("s.mha --exposures " + WriteText("e.html", text) + " --plot e.html", { "e.html", "--exposures" });
}
