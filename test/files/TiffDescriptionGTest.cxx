// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/FrameFileTestHelper.h"
#include "files/FrameReader.h"
#include "helpers/TiffTestHelper.h"
#include "sensornoise/FrameFile.h"

#include <string>
#include <vector>

// Descriptions by ImageJ and OME of the pages of a TIFF.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

class TiffDescription : public FrameFileTest
{
protected:
  /** Returns a TIFF of so many pages, whose first pixels are 100 + 3 times their number. The first page has the
   * description. */
  static std::string
  Pages(std::size_t pages, const std::string & description)
  {
    TiffOf tiff;
    tiff.pages.assign(pages, {});
    tiff.pages[0] = { { 270, Text(description) } };
    return tiff.Bytes();
  }

  /** Returns a TIFF of one page, whose ImageJ description says that images follow. */
  static std::string
  Described(std::size_t images, const std::string & rest, bool isBigEndian = true)
  {
    TiffOf tiff;
    tiff.isBigEndian = isBigEndian;
    tiff.rowsPerStrip = tiff.height;
    const std::string text =
      "ImageJ=1.53t\nimages=" + std::to_string(images) + "\nslices=" + std::to_string(images) + "\n";
    // ImageJ has the directory before the pixels
    tiff.pages.assign(1, { { 270, Text(text) }, { 273, { 4, { 1000 } } } });
    std::string bytes = tiff.Bytes();
    bytes.resize(1000, '\0');
    return bytes + tiff.StripOf(0, 0, tiff.height) + rest;
  }

  std::string
  SaidOfChoice(const std::string & bytes, const FrameChoice & choice) const
  {
    try
    {
      FrameFile file = InspectFrameFile(Write("a.tif", bytes));
      ChooseFrames(file, choice);
      return "";
    }
    catch (const FileError & error)
    {
      return error.what();
    }
  }

  /** Returns the numbers of the pages that are chosen, by their first pixels. */
  std::vector<int>
  PagesOf(const std::string & bytes, const FrameChoice & choice) const
  {
    FrameFile file = InspectFrameFile(Write("a.tif", bytes));
    ChooseFrames(file, choice);
    std::vector<unsigned short> pixels(file.width * file.height * file.frames);
    file.reader->Read(file, 0, file.frames, pixels.data());
    std::vector<int> pages;
    for (std::size_t t = 0; t < file.frames; ++t)
    {
      pages.push_back((pixels[t * file.width * file.height] - 100) / 3);
    }
    return pages;
  }

  static FrameChoice
  Choice(std::optional<std::size_t> channel, std::optional<std::size_t> plane)
  {
    FrameChoice choice;
    choice.channel = channel;
    choice.plane = plane;
    return choice;
  }
};

const std::string hyperstack = "ImageJ=1.53t\nimages=12\nchannels=2\nslices=3\nframes=2\nhyperstack=true\n";

TEST_F(TiffDescription, ImagesBehindTheOnlyPageOfImageJAreRead)
{
  TiffOf tiff;
  tiff.isBigEndian = true;
  const std::string           rest = tiff.StripOf(1, 0, 9) + tiff.StripOf(2, 0, 9);
  const FrameFile             file = IsFrames("a.tif", Described(3, rest), FramePixel::UnsignedShort, 13, 9, 3);
  std::vector<unsigned short> pixels(2 * 117);
  file.reader->Read(file, 1, 2, pixels.data());
  EXPECT_EQ(pixels[0], 103);
  EXPECT_EQ(pixels[2 * 117 - 1], 100 + 12 * 8 + 6);
  IsFrames("a.tif", Described(3, rest + "some words"), FramePixel::UnsignedShort, 13, 9, 3);
  IsRefused("a.tif",
            Described(3, rest.substr(1)),
            { "pages: 1, but ImageJ's description of it says images=3, which need 702 bytes from byte 1000 on",
              "the file has 1701",
              "or what is there: --raw 13x9:uint16be:1000:0:0:233" });
  IsRefused("a.tif", Described(2, rest), { "images=2, which need 468 bytes", "--raw 13x9:uint16be:1000" });
  IsRefused("a.tif", Described(1000000000, rest), { "images=1000000000, which need 234000000000 bytes" });
  TiffOf packed;
  packed.compression = 8;
  packed.pages.assign(1, { { 270, Text("ImageJ=1.53t\nimages=3\n") } });
  IsRefused("a.tif", packed.Bytes(), { "pages: 1, but ImageJ's description of it says images=3" });
}

TEST_F(TiffDescription, ChannelsAndPlanesOfImageJAreNotTime)
{
  const std::string bytes = Pages(12, hyperstack);
  EXPECT_NE(SaidOfChoice(bytes, {}).find("a.tif: has 2 channels, 3 planes and 2 times; expected frames that differ in "
                                         "time alone: choose --channel 0 to 1"),
            std::string::npos)
    << SaidOfChoice(bytes, {});
  EXPECT_NE(SaidOfChoice(bytes, Choice(0, {})).find("choose --plane 0 to 2"), std::string::npos);
  EXPECT_NE(SaidOfChoice(bytes, Choice(2, 0)).find("but --channel is 2; expected --channel 0 to 1"), std::string::npos);
  EXPECT_EQ(PagesOf(bytes, Choice(1, 2)), (std::vector<int>{ 5, 11 }));
  EXPECT_EQ(PagesOf(bytes, Choice(0, 0)), (std::vector<int>{ 0, 6 }));
  FrameChoice all;
  all.all = true;
  EXPECT_EQ(PagesOf(bytes, all).size(), 12u);
  IsRefused("a.tif", Pages(12, "ImageJ=1.53t\nchannels=2\nslices=5\n"), { "pages: 12", "has axes for 10 of several" });
}

TEST_F(TiffDescription, OneAxisIsTimeUnlessItIsOfChannels)
{
  for (const std::string text : { "ImageJ=1.53t\nimages=3\nslices=3\n",
                                  "ImageJ=1.53t\nimages=3\nframes=3\n",
                                  "<OME><Image><Pixels DimensionOrder=\"XYCZT\" SizeC=\"1\" SizeZ=\"1\" SizeT=\"3\"/>",
                                  "<OME><Image><Pixels DimensionOrder=\"XYCZT\" SizeC=\"1\" SizeZ=\"3\" SizeT=\"1\"/>",
                                  "three pages" })
  {
    EXPECT_EQ(SaidOfChoice(Pages(3, text), {}), "") << text;
    EXPECT_EQ(SaidOfChoice(Pages(3, text), Choice(0, 0)), "") << text;
    EXPECT_NE(SaidOfChoice(Pages(3, text), Choice(1, {})).find("--channel 1 was given; leave it out"),
              std::string::npos);
  }
  EXPECT_NE(SaidOfChoice(Pages(3, "ImageJ=1.53t\nimages=3\nchannels=3\n"), {}).find("has 3 channels; expected frames"),
            std::string::npos);
}

TEST_F(TiffDescription, AxesOfOmeAreInItsOrder)
{
  const std::string bytes =
    Pages(12, "<?xml?><OME xmlns=\"x\"><Image><Pixels SizeT='3'\nDimensionOrder='XYZTC' SizeC='2' SizeZ='2' Type='u'>");
  EXPECT_EQ(PagesOf(bytes, Choice(1, 0)), (std::vector<int>{ 6, 8, 10 }));
  EXPECT_NE(SaidOfChoice(bytes, {}).find("has 2 planes, 3 times and 2 channels"), std::string::npos);
  const std::string one = "<Image><Pixels SizeT=\"3\"/></Image>";
  IsRefused("a.tif", Pages(3, "<OME>" + one + one + "</OME>"), { "its OME-XML describes several images" });
}
} // namespace
