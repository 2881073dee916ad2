// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/EstimateToolTestHelper.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>

namespace
{
/** --bayer. */
class EstimateBayerTool : public EstimateToolTest
{
protected:
  std::string
  Mosaic(const std::string & name, const std::string & options = "--bayer GRBG --transmission 0.6,1,0.4")
  {
    EXPECT_EQ(RunCommand("\"" + ToolFolder() +
                         "/simulate-sensor-noise\" --reference texture --size 128x96 --frames 40 "
                         "--output " +
                         name + " " + options),
              0)
      << m_Message;
    return name;
  }
};
} // namespace

TEST_F(EstimateBayerTool, RecordHasFourChannels)
{
  const auto record = ReportOf(Mosaic("m.mha") + " --bayer GRBG");
  EXPECT_EQ(record["schema"], "itk-sensornoise-report/1");
  EXPECT_EQ(record["bayer"]["pattern"], "GRBG");
  EXPECT_EQ(record["bayer"]["source"], "given");
  ASSERT_EQ(record["channels"].size(), 4U);
  const char * const names[] = { "R", "G1", "G2", "B" };
  for (std::size_t k = 0; k < 4; ++k)
  {
    const auto & channel = record["channels"][k];
    EXPECT_EQ(channel["channel"], names[k]);
    EXPECT_EQ(channel["width"], 64);
    EXPECT_EQ(channel["settings"]["bayer"], "GRBG");
    const double error = channel["gain"]["standard_error"];
    EXPECT_NEAR(channel["gain"]["value"], 1.0, 4.0 * error);
  }
  EXPECT_GT(record["joint"]["precision_gain"], 1.0);
  EXPECT_NEAR(
    record["joint"]["offset"]["value"], 100.0, 4.0 * record["joint"]["offset"]["standard_error"].get<double>());
}

TEST_F(EstimateBayerTool, AutoIsTheDefaultAndNoneIsMono)
{
  const auto record = ReportOf(Mosaic("m.mha"));
  EXPECT_EQ(record["bayer"]["pattern"], "GRBG");
  EXPECT_EQ(record["bayer"]["source"], "levels");
  EXPECT_EQ(record["warnings"][0]["code"], "red-or-blue");
  const auto mono = ReportOf("m.mha --bayer none");
  EXPECT_EQ(mono["channel"], "mono");
  bool isSaid = false;
  for (const auto & warning : mono["warnings"])
  {
    isSaid = isSaid || warning["code"] == "mosaic";
  }
  EXPECT_TRUE(isSaid) << mono["warnings"];
  EXPECT_EQ(ReportOf(Mosaic("p.mha", ""))["channel"], "mono");
}

TEST_F(EstimateBayerTool, TableHasALineAChannel)
{
  EXPECT_EQ(Run(Mosaic("m.mha") + " --bayer GRBG"), 0) << m_Message;
  for (const char * expected :
       { "40 frames, planes of 64 x 48 pixels of a GRBG mosaic (given)", "\nG2 ", "sigma_gamma", "joint offset: " })
  {
    EXPECT_NE(m_Output.find(expected), std::string::npos) << expected << "\n" << m_Output;
  }
}

TEST_F(EstimateBayerTool, RegionShiftsThePattern)
{
  Mosaic("m.mha");
  const auto cut = ReportOf("m.mha --bayer GRBG --roi 3,5,80,80");
  EXPECT_EQ(cut["bayer"]["pattern"], "GBRG");
  EXPECT_EQ(ReportOf("m.mha --roi 3,5,80,80")["bayer"]["pattern"], "GBRG");
  EXPECT_EQ(cut["channels"][0]["settings"]["roi_x"], 3);
}

TEST_F(EstimateBayerTool, PatternIsTheFilesIfItHasOne)
{
  // Frames without a header, of a type whose name has the pattern: what the levels say, GRBG, is not asked.
  const std::string file = ReadText(Path(Mosaic("m.mha")));
  const std::size_t bytes = std::size_t{ 128 } * 96 * 40 * 2;
  ASSERT_GT(file.size(), bytes);
  std::ofstream(Path("m.raw"), std::ios::binary) << file.substr(file.size() - bytes);
  const auto record = ReportOf("--raw 128x96:SGBRG12 m.raw");
  EXPECT_EQ(record["bayer"]["pattern"], "GBRG");
  EXPECT_EQ(record["bayer"]["source"], "file");
  EXPECT_EQ(ReportOf("--raw 128x96:SGBRG12 m.raw --roi 1,0,64,64")["bayer"]["pattern"], "BGGR");
  EXPECT_EQ(ReportOf("--raw 128x96:SGBRG12 m.raw --bayer none")["channel"], "mono");
}

TEST_F(EstimateBayerTool, ChecksAreOfEachChannel)
{
  const auto record = ReportOf(Mosaic("m.mha") + " --bayer GRBG --check " +
                               Mosaic("n.mha", "--bayer GRBG --transmission 0.6,1,0.4 --seed 5 --gain 1.2"));
  ASSERT_EQ(record["checks"].size(), 4U);
  for (const auto & check : record["checks"])
  {
    EXPECT_EQ(check["verdict"], "does-not-fit") << check;
  }
  const auto same = ReportOf("m.mha --bayer GRBG --check");
  EXPECT_EQ(same["checks"][1]["verdict"], "fits") << same["checks"][1];
}

TEST_F(EstimateBayerTool, MapsAreThoseOfTheMosaic)
{
  ReportOf(Mosaic("m.mha") + " --bayer GRBG --maps maps");
  EXPECT_EQ(std::filesystem::file_size(Path("maps/pixel_use.mha")) / (128 * 96), 1U);
}

TEST_F(EstimateBayerTool, SmallPlanesAreRefusedWithTheirMosaic)
{
  IsRefused(Mosaic("m.mha") + " --bayer GRBG --roi 0,0,5,7",
            { "the frames of the mosaic have 5 x 7 pixels", "each plane of it 2 x 3", "at least 6 x 6 pixels" });
}

TEST_F(EstimateBayerTool, UnknownPatternsAreRefused)
{
  EXPECT_EQ(Run(Mosaic("m.mha") + " --bayer RGBG"), 2);
  EXPECT_NE(m_Message.find("--bayer"), std::string::npos) << m_Message;
}
