// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/DngTestHelper.h"
#include "helpers/EstimateToolTestHelper.h"
#include "sensornoise/NoiseExport.h"

#include <cmath>
#include <sstream>

/** Runs export-noise-model on a report: a = 0.5 DN/e-, b = -30 DN^2, mu = 64 DN, sigma = 1.4 DN. */
class ExportToolTest : public EstimateToolTest
{
protected:
  void
  SetUp() override
  {
    EstimateToolTest::SetUp();
    const auto quantity = [](const nlohmann::json & value) {
      return nlohmann::json{ { "value", value }, { "status", value.is_null() ? "upper-limit" : "identified" } };
    };
    m_Report = { { "schema", "itk-sensornoise-report/1" },
                 { "channel", "mono" },
                 { "variance_slope", quantity(0.5) },
                 { "total_intercept", quantity(-30.0) },
                 { "gain", quantity(0.5) },
                 { "offset", quantity(64.0) },
                 { "read_noise", quantity(1.4) },
                 { "clip_high", nullptr },
                 { "scatter", { { "mean", { 150, 1000, 3500 } } } },
                 { "camera", { { "black_level", 64.0 }, { "white_level", nullptr } } } };
    WriteText("report.json", m_Report.dump());
  }

  void
  IsRefusedBy(const std::string & arguments, const std::vector<std::string> & parts, int exitCode)
  {
    SCOPED_TRACE(arguments);
    const std::set<std::string> before = FilesLeft();
    EXPECT_EQ(Export(arguments), exitCode) << m_Message;
    SaysInOneSentence(parts);
    EXPECT_EQ(m_Output, "");
    EXPECT_EQ(FilesLeft(), before);
  }

  nlohmann::json m_Report;
};

TEST_F(ExportToolTest, WritesTextToStandardOutputOrAFile)
{
  ASSERT_EQ(Export("report.json --format dng --white 1088"), 0) << m_Message;
  std::istringstream numbers(m_Output);
  double             scale = 0.0;
  double             offset = 0.0;
  numbers >> scale >> offset;
  // The black level is the report's: S = 0.5 / 1024, O = (-30 + 0.5 x 64) / 1024^2.
  EXPECT_DOUBLE_EQ(scale, 0.5 / 1024.0);
  EXPECT_DOUBLE_EQ(offset, 2.0 / (1024.0 * 1024.0));
  EXPECT_EQ(m_Message, "");
  const std::string text = m_Output;
  ASSERT_EQ(Export("report.json --format dng --white 1088 --output profile.txt"), 0) << m_Message;
  EXPECT_EQ(m_Output, "");
  EXPECT_EQ(ReadText(Path("profile.txt")), text);
}

TEST_F(ExportToolTest, ListsAllFormatsAndPrintsNotes)
{
  ASSERT_EQ(Export("--list"), 0) << m_Message;
  for (const auto & format : sensornoise::ExportFormats())
  {
    EXPECT_NE(m_Output.find(std::string(format.name) + ' '), std::string::npos) << format.name;
    EXPECT_NE(m_Output.find(format.fields), std::string::npos) << format.name;
  }
  ASSERT_EQ(Export("report.json --format anscombe-transform"), 0);
  EXPECT_EQ(m_Message.find("note: The zero level is rounded from 60 DN"), 0U) << m_Message;
}

TEST_F(ExportToolTest, WritesTheTagIntoACopyOfADngFile)
{
  const std::string dng = sensornoise::test::DngOfLevels(64, 1088);
  WriteText("photo.dng", dng);
  for (const char * levels : { "", "--white 1088", "--white 1088 --black 64" })
  {
    ASSERT_EQ(Export(std::string("report.json --format dng --into photo.dng --output copy.dng ") + levels), 0)
      << m_Message;
    EXPECT_EQ(ReadText(Path("photo.dng")), dng);
    EXPECT_EQ(ReadText(Path("copy.dng")),
              sensornoise::WithNoiseProfile(dng, { { 0.5 / 1024.0, 2.0 / (1024.0 * 1024.0) } }));
  }
  IsRefusedBy("report.json --format dng --white 1088 --into photo.dng --output photo.dng", { "photo.dng" }, 2);
  IsRefusedBy("report.json --format dng --white 1088 --into photo.dng", { "--output COPY.dng" }, 2);
  IsRefusedBy("report.json --format fits --into photo.dng --output copy", { "--format dng" }, 2);
  const std::string into = "report.json --format dng --output x.dng --into ";
  IsRefusedBy(into + "photo.dng --white 4095",
              { "photo.dng (--into)", "white level is 4095 DN", "has 1088 DN (tag 50717)", "Leave the level out" },
              2);
  IsRefusedBy(into + "photo.dng --black 0", { "black level is 0 DN", "has 64 DN (tag 50714)" }, 2);
  WriteText("plain.tif", std::string("II*\0\x08\0\0\0\0\0\0\0\0\0", 14)); // a directory without tags
  IsRefusedBy(into + "plain.tif", { "plain.tif (--into)", "without the tag DNGVersion", "expected a DNG file" }, 2);
  IsRefusedBy("report.json --format dng --white 1088 --into report.json --output x.dng",
              { "report.json (--into)", "no classic TIFF" },
              2);
}

TEST_F(ExportToolTest, WritesTheMapsOfAFolderIntoAFolder)
{
  using MapType = itk::Image<double, 2>;
  std::filesystem::create_directory(Path("maps"));
  std::filesystem::create_directory(Path("out"));
  IsRefusedBy("report.json --format maps --maps maps --output out", { "pixel_offset.mha", "--dark" }, 2);
  Write<MapType>("maps/pixel_offset.mha", Make<MapType>({ { 3, 2 } }, 64.0));
  Write<MapType>("maps/pixel_read_noise.mha", Make<MapType>({ { 3, 2 } }, 1.5));
  IsRefusedBy("report.json --format maps --output out", { "no maps", "--maps" }, 3);
  IsRefusedBy("report.json --format maps --maps maps --output none", { "none", "folder that exists" }, 2);
  ASSERT_EQ(Export("report.json --format maps --maps maps --output out"), 0) << m_Message;
  EXPECT_EQ(Read<MapType>(Path("out/SERIAL_off.tiff"))->GetPixel({ { 2, 1 } }), 64.0);
  EXPECT_EQ(Read<MapType>(Path("out/SERIAL_var.tiff"))->GetPixel({ { 2, 1 } }), 2.25);
  EXPECT_EQ(Read<MapType>(Path("out/variance_ms.tif"))->GetPixel({ { 2, 1 } }), 9.0);
  m_Report["width"] = 128;
  m_Report["height"] = 96;
  WriteText("report.json", m_Report.dump());
  IsRefusedBy("report.json --format maps --maps maps --output out", { "3 x 2 pixels", "report.json have 128 x 96" }, 3);
}

TEST_F(ExportToolTest, RefusesWithASentence)
{
  IsRefusedBy("report.json --format dng", { "report.json", "no white level", "--white" }, 3);
  IsRefusedBy("report.json --format fits --channel G1", { "no channel G1 (--channel)", "it has mono" }, 2);
  IsRefusedBy("report.json --format moon", { "moon", "expected one of dng" }, 2);
  IsRefusedBy("report.json --format libcamera --analogue-gain 0", { "analogue gain is 0", "above 0" }, 2);
  IsRefusedBy("report.json --format dng --black nan", { "black or white level is nan", "finite" }, 2);
  IsRefusedBy("report.json --format dng --white 64", { "white level is 64 DN", "above the black level" }, 2);
  IsRefusedBy("report.json report.json --format dng", { "2 reports were given", "takes one" }, 2);
  IsRefusedBy(
    "report.json --format fits --analogue-gain 3", { "--analogue-gain is for --format libcamera", "fits" }, 2);
  IsRefusedBy("report.json --format dng --max-analogue-iso 3", { "--max-analogue-iso is for --format android" }, 2);
  IsRefusedBy("report.json --format fits --maps maps", { "--maps is for --format maps", "leave the option out" }, 2);
  IsRefusedBy("report.json --format android", { "1 report was given", "2 or more" }, 3);
  IsRefusedBy("report.json", { "--format", "--list" }, 2);
  IsRefusedBy("--format dng", { "REPORT" }, 2);
  IsRefusedBy("report.json --format careamics --white 1088", { "no text", "--output" }, 2);
  IsRefusedBy("report.json --format fits --output report.json", { "report.json" }, 2);
  IsRefusedBy("none.json --format fits", { "none.json", "cannot be read" }, 2);
  IsRefusedBy("report.json --format dng --white many", { "--white" }, 2);
  m_Report["read_noise"]["value"] = nullptr;
  m_Report["read_noise"]["status"] = "upper-limit";
  WriteText("report.json", m_Report.dump());
  IsRefusedBy(
    "report.json --format fits", { "read_noise", "upper-limit", "quantization", "analogue gain", "ndsafir" }, 3);
  IsRefusedBy("report.json --format fits", { "more frames, with dark frames (--dark) where there are none" }, 3);
  m_Report["read_noise"]["status"] = "not-identifiable";
  WriteText("report.json", m_Report.dump());
  IsRefusedBy("report.json --format fits", { "read_noise", "not-identifiable", "Give estimate-sensor-noise dark" }, 3);
}
