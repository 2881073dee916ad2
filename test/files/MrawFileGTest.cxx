// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/BurstFilesTestHelper.h"
#include "files/FrameReader.h"
#include "helpers/FrameFileTestHelper.h"

#include <filesystem>
#include <string>
#include <vector>

// Recordings of Photron cameras.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

GreyValues
SomeGreyValues(std::size_t count, unsigned bits)
{
  GreyValues        greyValues;
  const std::string bytes = RandomBytes(2 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    greyValues.push_back(
      (static_cast<unsigned char>(bytes[2 * i]) * 256U + static_cast<unsigned char>(bytes[2 * i + 1])) >> (16 - bits));
  }
  return greyValues;
}

std::string
PixelsOf(const GreyValues & greyValues, unsigned bits)
{
  return bits == 8 || bits == 16 ? BytesOfGreyValues(greyValues, bits / 8) : BitStream(greyValues, bits, true);
}

class MrawFile : public FrameFileTest
{
protected:
  template <typename TPixel>
  static GreyValues
  Read(const FrameFile & file)
  {
    std::vector<TPixel> pixels(file.width * file.height * file.frames);
    file.reader->Read(file, 0, file.frames, pixels.data());
    return { pixels.begin(), pixels.end() };
  }

  void
  HeaderIsRefused(const CihxOf & header, const std::string & pixels, const std::vector<std::string> & parts) const
  {
    Write("a.mraw", pixels);
    IsRefused("a.cihx", header.Bytes(), parts);
  }
};

TEST_F(MrawFile, IsReadByEitherOfItsNames)
{
  for (const unsigned bits : { 8U, 10U, 12U, 16U })
  {
    CihxOf header;
    header.bits = bits;
    header.depth = bits;
    const FramePixel  pixel = bits == 8 ? FramePixel::UnsignedChar : FramePixel::UnsignedShort;
    const GreyValues  greyValues = SomeGreyValues(160, bits);
    const std::string bytes = PixelsOf(greyValues, bits);
    Write("a.mraw", bytes);
    const FrameFile byHeader = IsFrames("a.cihx", header.Bytes(), pixel, 8, 5, 4);
    const FrameFile byPixels = IsFrames("a.mraw", bytes, pixel, 8, 5, 4);
    for (const FrameFile & file : { byHeader, byPixels })
    {
      EXPECT_EQ(bits == 8 ? Read<unsigned char>(file) : Read<unsigned short>(file), greyValues) << bits;
      EXPECT_EQ(file.camera.bitDepth, bits);
      EXPECT_EQ(file.camera.camera, "FASTCAM Mini");
      EXPECT_DOUBLE_EQ(file.camera.exposureSeconds, 1.0 / 5000.0);
      EXPECT_EQ(file.identities.size(), 2u);
    }
  }
}

TEST_F(MrawFile, AnOlderHeaderIsReadToo)
{
  const GreyValues greyValues = SomeGreyValues(160, 12);
  Write("a.mraw", BitStream(greyValues, 12, true));
  const std::string header = "#Camera Information Header\r\nCamera Type : SA5\r\nShutter Speed(s) : 1/1000.0\r\n"
                             "Total Frame : 4\r\nImage Width : 8\r\nImage Height : 5\r\nColor Type : Mono\r\n"
                             "Color Bit : 12\r\nFile Format : MRaw\r\nEffectiveBit Depth : 12\r\n"
                             "EffectiveBit Side : Lower\r\nEND\r\n";
  const FrameFile   file = IsFrames("a.cih", header, FramePixel::UnsignedShort, 8, 5, 4);
  EXPECT_EQ(Read<unsigned short>(file), greyValues);
  EXPECT_EQ(file.camera.camera, "SA5");
  EXPECT_EQ(file.camera.exposureSeconds, 0.001);
}

TEST_F(MrawFile, EndingsMayHaveCapitals)
{
  const GreyValues  greyValues = SomeGreyValues(160, 12);
  const std::string pixels = BitStream(greyValues, 12, true);
  Write("a.Mraw", pixels);
  EXPECT_EQ(Read<unsigned short>(IsFrames("a.CIHX", CihxOf{}.Bytes(), FramePixel::UnsignedShort, 8, 5, 4)), greyValues);
  EXPECT_EQ(DataFilesOf(Path("a.CIHX")), std::vector<std::string>{ Path("a.Mraw") });
  EXPECT_EQ(DataFilesOf(Path("a.Mraw")), std::vector<std::string>{ Path("a.CIHX") });
  IsFrames("a.Mraw", pixels, FramePixel::UnsignedShort, 8, 5, 4);
}

TEST_F(MrawFile, GreyValuesThatWereMovedUpStayUnchanged)
{
  CihxOf header;
  header.bits = 16;
  header.side = "Higher";
  Write("a.mraw", BytesOfGreyValues(GreyValues(160, 0xABC0), 2));
  const FrameFile file = IsFrames("a.cihx", header.Bytes(), FramePixel::UnsignedShort, 8, 5, 4);
  EXPECT_EQ(Read<unsigned short>(file), GreyValues(160, 0xABC0));
  EXPECT_EQ(file.camera.bitDepth, 16u);
  header.side = "Lower";
  EXPECT_EQ(IsFrames("a.cihx", header.Bytes(), FramePixel::UnsignedShort, 8, 5, 4).camera.bitDepth, 12u);
}

TEST_F(MrawFile, WhatIsMissingOrLeftOverIsRefused)
{
  const std::string pixels(240, '\1');
  IsRefused("alone.mraw", pixels, { "has no header beside it; expected the file ", "alone.cihx", "ends in .cih" });
  IsRefused("other.cihx", CihxOf{}.Bytes(), { "has no pixels beside it", "other.mraw" });
  Write("a.mraw", pixels);
  IsFrames("a.cihx", CihxOf{}.Bytes(), FramePixel::UnsignedShort, 8, 5, 4);
  HeaderIsRefused(CihxOf{}, pixels + "a", { "241 bytes of pixels in its data file ", "a.mraw; expected 240" });
  HeaderIsRefused(CihxOf{}, pixels.substr(1), { "truncated: 239 bytes of pixels in its data file " });
  HeaderIsRefused(CihxOf{}, "", { "truncated: 0 bytes of pixels" });
  std::filesystem::remove(Path("a.mraw"));
  std::filesystem::create_directories(Path("a.mraw"));
  IsRefused("a.cihx", CihxOf{}.Bytes(), { "its data file ", "is a folder" });
}

TEST_F(MrawFile, HeadersThatCannotBeTrueAreRefused)
{
  const std::string pixels(240, '\1');
  const auto        refused = [&](const auto & change, const std::vector<std::string> & parts) {
    CihxOf header;
    change(header);
    HeaderIsRefused(header, pixels, parts);
  };
  refused([](CihxOf & h) { h.bits = 36; }, { "colours of 36 bits a pixel" });
  refused([](CihxOf & h) { h.bits = 11; }, { "says 11 bits a pixel; expected 8, 10, 12 or 16" });
  refused([](CihxOf & h) { h.width = 0; }, { "size 0 along axis 0" });
  refused([](CihxOf & h) { h.frames = 0; }, { "size 0 along axis 2" });
  refused([](CihxOf & h) { h.width = 7; }, { "7 x 5 pixels, packed 2 in 3 bytes" });
  refused([](CihxOf & h) { h.frames = 3; }, { "240 bytes of pixels", "expected 180" });
  refused([](CihxOf & h) { h.more = "<frameInfo><totalFrame>5</totalFrame></frameInfo>"; },
          { "says \"two values\" for frameInfo/totalFrame" });
  refused([](CihxOf & h) { h.more = "<open>"; }, { "</cih> where </open> has to be" });
  const std::string sound = CihxOf{}.Bytes();
  Write("a.mraw", pixels);
  IsRefused("a.cihx", sound.substr(0, sound.find("</cih>")), { "ends within its elements" });
  IsRefused("a.cihx", "<?xml version=\"1.0\"?><a></a>", { "has no element <cih>" });
  IsRefused("a.cihx", "nothing", { "its header says \"\" for imageDataInfo/colorInfo/bit (Color Bit)" });
  IsRefused("a.cihx", Replaced(sound, "MRaw", "TIFF"), { "in the format tiff; expected mraw" });
  IsRefused("a.cihx", Replaced(sound, ">4<", ">-4<"), { "says \"-4\" for frameInfo/totalFrame" });
  std::string deep = "<cih>";
  for (int i = 0; i < 70; ++i)
  {
    deep += "<a>";
  }
  IsRefused("a.cihx", deep, { "64 deep" });
}
} // namespace
