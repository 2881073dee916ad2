// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/BurstFilesTestHelper.h"
#include "helpers/EstimateToolTestHelper.h"

#include <filesystem>
#include <string>
#include <vector>

// The same frames in every format have the same report.

namespace
{
using namespace sensornoise::test;

class BurstFormatsTool : public EstimateToolTest
{
protected:
  /** Writes the burst in every format; the command lines that read it. */
  std::vector<std::string>
  WriteAll()
  {
    const auto                   burst = MakeBurst();
    const itk::Size<3>           size = burst->GetLargestPossibleRegion().GetSize();
    const unsigned short * const first = burst->GetBufferPointer();
    const GreyValues             greyValues(first, first + size[0] * size[1] * size[2]);
    const std::string            raw = " --raw 64x64:";
    WriteText("a.ser", SerText(greyValues));
    CihxOf header;
    header.width = header.height = 64;
    header.frames = 24;
    WriteText("a.cihx", header.Bytes());
    WriteText("a.mraw", BitStream(greyValues, 12, true));
    WriteText("whole", "head" + BytesOfGreyValues(greyValues, 2));
    WriteText("big", BytesOfGreyValues(greyValues, 2, true));
    WriteText("p12", BitStream(greyValues, 12, false));
    WriteText("gige", GigEPacked(greyValues, 12));
    WriteText("mipi", MipiPacked(greyValues, 12));
    return { Write("a.mha", burst.GetPointer()),
             Write("a.tif", burst.GetPointer()),
             "a.ser",
             "a.cihx",
             "a.mraw",
             "whole" + raw + "uint16le:4",
             "big" + raw + "uint16be",
             "p12" + raw + "Mono12p",
             "gige" + raw + "Mono12Packed",
             "mipi" + raw + "RAW12" };
  }

  /** Returns the report without the camera settings of the file. */
  std::string
  MeasuredOf(const std::string & arguments)
  {
    std::string       text = JsonTextOf(arguments);
    const std::string member = "\"camera\": {";
    const std::size_t begin = text.find(member);
    return begin == std::string::npos ? text : text.erase(begin, text.find("}, ", begin) + 3 - begin);
  }

  static std::string
  SerText(const GreyValues & greyValues)
  {
    SerOf ser;
    ser.width = ser.height = 64;
    ser.frames = 24;
    ser.pixels = BytesOfGreyValues(greyValues, 2);
    return ser.Bytes();
  }
};

TEST_F(BurstFormatsTool, GiveTheReportOfTheMetaImage)
{
  const std::vector<std::string> all = WriteAll();
  const std::string              expected = JsonTextOf(all.front() + " --bit-depth 12");
  EXPECT_NE(expected.find("\"gain\""), std::string::npos);
  for (const std::string & arguments : all)
  {
    EXPECT_EQ(MeasuredOf(arguments + " --bit-depth 12"), expected) << arguments;
  }
}

TEST_F(BurstFormatsTool, RawIsOfDarkFramesAndThoseToBeCheckedToo)
{
  WriteAll();
  const std::string expected = JsonTextOf("a.mha --dark a.mha --check a.mha --bit-depth 12", 0);
  EXPECT_EQ(MeasuredOf("p12 --dark p12 --check p12 --raw 64x64:Mono12p --bit-depth 12"), expected);
  // Settings in the file count as given.
  EXPECT_EQ(MeasuredOf("p12 --raw 64x64:Mono12p"), JsonTextOf("a.mha --bit-depth 12"));
}

TEST_F(BurstFormatsTool, WhatDoesNotFitIsOneSentence)
{
  WriteAll();
  const auto isRefused = [this](const std::string & arguments, const std::string & words) {
    EXPECT_EQ(Run(arguments), 2) << arguments;
    EXPECT_NE(m_Message.find(words), std::string::npos) << m_Message;
    EXPECT_EQ(m_Message.find('\n'), m_Message.size() - 1) << m_Message;
  };
  isRefused("p12 --raw 64x63:Mono12p",
            "p12: 147456 bytes of pixels, at 6048 bytes a frame of 64 x 63 pixels 24 frames");
  isRefused("p12 --raw 64x64:Mono13p", "\"64x64:Mono13p\" is no layout of raw frames");
  isRefused("p12", "p12: no image in a format that can be checked");
}

TEST_F(BurstFormatsTool, ARecordingThatWasNotClosedHasAWarning)
{
  WriteAll();
  std::string text = ReadText(Path("a.ser"));
  text.replace(38, 4, std::string(4, '\0'));
  WriteText("open.ser", text);
  EXPECT_EQ(MeasuredOf("open.ser --bit-depth 12"), JsonTextOf("a.mha --bit-depth 12"));
  EXPECT_EQ(Run("open.ser --bit-depth 12"), 0);
  EXPECT_NE(m_Message.find("warning: open.ser: says 0 frames, but holds 24"), std::string::npos) << m_Message;
}

// The other file of a recording is no place for a report.
TEST_F(BurstFormatsTool, NeitherFileOfARecordingIsOverwritten)
{
  WriteAll();
  std::filesystem::create_symlink("a.mraw", Path("pixels.json"));
  std::filesystem::create_symlink("a.cihx", Path("header.json"));
  EXPECT_EQ(Run("a.cihx --json pixels.json"), 2);
  EXPECT_NE(m_Message.find("the pixels of the frame a.cihx"), std::string::npos) << m_Message;
  EXPECT_EQ(Run("a.mraw --json header.json"), 2);
  EXPECT_NE(m_Message.find("the header of the frame a.mraw"), std::string::npos) << m_Message;
}
} // namespace
