// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"
#include "files/FrameReader.h"
#include "helpers/BurstFilesTestHelper.h"
#include "helpers/FrameFileTestHelper.h"

#include <stdexcept>
#include <string>
#include <vector>

// Frames in a file that does not say how they lie there.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

std::string
SaidOfLayout(const std::string & text)
{
  try
  {
    ReadRawLayout(text);
    return "";
  }
  catch (const std::invalid_argument & error)
  {
    return error.what();
  }
}

class RawFile : public FrameFileTest
{
protected:
  std::string
  SaidOfRaw(const std::string & bytes, const std::string & layout) const
  {
    try
    {
      InspectRawFile(Write("a.raw", bytes), ReadRawLayout(layout));
      return "";
    }
    catch (const FileError & error)
    {
      return error.what();
    }
  }

  template <typename TPixel>
  std::vector<TPixel>
  Read(const std::string & bytes, const std::string & layout, std::size_t first, std::size_t count) const
  {
    const FrameFile     file = InspectRawFile(Write("a.raw", bytes), ReadRawLayout(layout));
    std::vector<TPixel> pixels(file.width * file.height * count);
    EXPECT_EQ(SizeOf(file.pixel), sizeof(TPixel));
    EXPECT_NE(file.format, nullptr);
    file.reader->Read(file, first, count, pixels.data());
    return pixels;
  }
};

TEST_F(RawFile, EachTypeIsReadAsItLies)
{
  using Shorts = std::vector<unsigned short>;
  const GreyValues  greyValues{ 1, 2, 300, 1000, 5, 6, 7, 1023 }; // two frames of 2 x 2
  const Shorts      second{ 5, 6, 7, 1023 };
  const std::string little = BytesOfGreyValues(greyValues, 2);
  EXPECT_EQ(Read<unsigned short>(little, "2x2:uint16le", 1, 1), second);
  EXPECT_EQ(Read<unsigned short>(little, "2x2:MONO10", 1, 1), second);
  EXPECT_EQ(Read<unsigned short>(little, "2x2:SRGGB10", 1, 1), second);
  EXPECT_EQ(Read<unsigned short>("skip" + little, "2x2:uint16le:4", 1, 1), second);
  EXPECT_EQ(Read<unsigned short>(BytesOfGreyValues(greyValues, 2, true), "2x2:uint16be", 1, 1), second);
  EXPECT_EQ(Read<short>(BytesOfGreyValues({ 0xFFFF }, 2), "1x1:int16le", 0, 1), std::vector<short>{ -1 });
  EXPECT_EQ(Read<unsigned char>("abcd", "2x1:uint8", 1, 1), (std::vector<unsigned char>{ 'c', 'd' }));
  EXPECT_EQ(Read<unsigned short>(BitStream(greyValues, 10, false), "2x2:Mono10p", 1, 1), second);
  EXPECT_EQ(Read<unsigned short>(BitStream(greyValues, 12, false), "2x2:BayerGR12p", 1, 1), second);
  EXPECT_EQ(Read<unsigned short>(BitStream(greyValues, 12, true), "2x2:uint12msb", 1, 1), second);
  EXPECT_EQ(Read<unsigned short>(GigEPacked(greyValues, 12), "2x2:Mono12Packed", 1, 1), second);
  EXPECT_EQ(Read<unsigned short>(GigEPacked(greyValues, 10), "2x2:Mono10Packed", 1, 1), second);
  EXPECT_EQ(Read<unsigned short>(MipiPacked(greyValues, 10), "2x2:RAW10", 1, 1), second);
  EXPECT_EQ(Read<unsigned short>(MipiPacked(greyValues, 12), "2x2:SBGGR12P", 1, 1), second);
  EXPECT_EQ(Read<unsigned short>(MipiPacked(greyValues, 14), "2x2:raw14", 1, 1), second);
}

TEST_F(RawFile, RowsMayHaveAGapBehindThem)
{
  const std::string row = "ab--cd--ef--gh--"; // two frames of 2 x 2
  EXPECT_EQ(Read<unsigned char>("!" + row, "2x2:uint8:1:4", 1, 1), (std::vector<unsigned char>{ 'e', 'f', 'g', 'h' }));
  EXPECT_NE(SaidOfRaw(row, "2x2:uint16le:0:3").find("3 bytes from a row to the next, but a row of 2 pixels has 4"),
            std::string::npos);
  const std::string packed = MipiPacked({ 1, 2, 3, 4 }, 10) + "---" + MipiPacked({ 5, 6, 7, 1023 }, 10) + "---";
  EXPECT_EQ(Read<unsigned short>(packed, "4x2:RAW10:0:8", 0, 1),
            (std::vector<unsigned short>{ 1, 2, 3, 4, 5, 6, 7, 1023 }));
}

// A spool file has a frame and what follows it; FITS fills its last block up.
TEST_F(RawFile, BytesMayLieBehindFramesAndAtTheEnd)
{
  const std::vector<unsigned char> second{ 'e', 'f', 'g', 'h' };
  EXPECT_EQ(Read<unsigned char>("!abcd--efgh--", "2x2:uint8:1:0:2", 1, 1), second);
  EXPECT_EQ(Read<unsigned char>("!abcd--efgh", "2x2:uint8:1:0:2", 1, 1), second);
  EXPECT_EQ(Read<unsigned char>("!abcd--efgh...", "2x2:uint8:1:0:2:3", 1, 1), second);
  EXPECT_EQ(Read<unsigned char>("abcdefgh...", "2x2:uint8:0:0:0:3", 1, 1), second);
  EXPECT_EQ(Read<unsigned char>("ab-cd-!ef-gh-!", "2x2:uint8:0:3:1", 1, 1), second);
  EXPECT_EQ(InspectRawFile(Path("a.raw"), ReadRawLayout("2x2:uint8:0:0:10")).frames, 1u);
  const auto refused = [this](const std::string & layout, const std::string & part) {
    const std::string said = SaidOfRaw("abcd--efgh...", layout);
    EXPECT_NE(said.find(part), std::string::npos) << layout << ": " << said;
  };
  refused("2x2:uint8",
          "3 frames and 1 bytes more; expected a whole number of frames, or in the layout the bytes behind");
  refused("2x2:uint8:0:0:2", "at 4 bytes a frame of 2 x 2 pixels, 2 behind each 2 frames and 1 bytes more");
  refused("2x2:uint8:0:0:2:4", "2 behind each, 4 behind the last 1 frames and 3 bytes more");
  refused("2x2:uint8:0:0:2:14", "0 frames");
  refused("2x2:uint8:0:0:900000000000000000", "13 bytes of pixels; expected 4, 4 bytes a frame of 2 x 2 pixels, 9");
}

// More than is held at a time.
TEST_F(RawFile, LargeFramesAreReadInPieces)
{
  const std::size_t gap = 1500000;
  std::string       rows = "ab" + std::string(gap - 2, '-') + "cd" + std::string(gap - 2, '-');
  EXPECT_EQ(Read<unsigned char>(rows, "2x2:uint8:0:" + std::to_string(gap), 0, 1),
            (std::vector<unsigned char>{ 'a', 'b', 'c', 'd' }));
  GreyValues greyValues;
  for (unsigned i = 0; i < 1024 * 1024; ++i)
  {
    greyValues.push_back(i * 2654435761U >> 20);
  }
  EXPECT_EQ(Read<unsigned short>(BitStream(greyValues, 12, false), "1024x1024:Mono12p", 0, 1),
            (std::vector<unsigned short>(greyValues.begin(), greyValues.end())));
}

TEST_F(RawFile, SaysWhatTheTypeSaysOfTheCamera)
{
  const auto camera = [](const std::string & type) { return ReadRawLayout("4x4:" + type).camera; };
  EXPECT_EQ(camera("BayerRG12p").bayerPattern, "RGGB");
  EXPECT_EQ(camera("BayerGR8").bayerPattern, "GRBG");
  EXPECT_EQ(camera("sgbrg10p").bayerPattern, "GBRG");
  EXPECT_EQ(camera("BayerBG12Packed").bayerPattern, "BGGR");
  EXPECT_EQ(camera("BayerRG12p").bitDepth, 12u);
  EXPECT_EQ(camera("RAW10").bitDepth, 10u);
  EXPECT_EQ(camera("Mono14").bitDepth, 14u);
  EXPECT_EQ(camera("uint16le").bitDepth, 0u);
  EXPECT_EQ(camera("uint16le").bayerPattern, "");
}

TEST_F(RawFile, IsAWholeNumberOfFrames)
{
  const std::string bytes(4 * 4 * 2 * 3, 'a');
  EXPECT_EQ(SaidOfRaw(bytes, "4x4:uint16le"), "");
  EXPECT_EQ(InspectRawFile(Path("a.raw"), ReadRawLayout("4x4:uint16le")).frames, 3u);
  const auto refused = [this](const std::string & pixels, const std::string & layout, const std::string & part) {
    const std::string said = SaidOfRaw(pixels, layout);
    EXPECT_NE(said.find(part), std::string::npos) << said;
  };
  refused(
    bytes + "a", "4x4:uint16le", "97 bytes of pixels, at 32 bytes a frame of 4 x 4 pixels 3 frames and 1 bytes more");
  refused(bytes.substr(1), "4x4:uint16le", "2 frames and 31 bytes more; expected a whole number of frames");
  refused(bytes, "4x4:uint16le:96", "0 bytes of pixels");
  refused(bytes, "4x4:uint16le:97", "0 bytes of pixels");
  refused(bytes, "3x3:Mono12p", "3 x 3 pixels, packed 2 in 3 bytes");
  refused(bytes, "2000000000x2000000000:float64le", "more than can be counted");
}

TEST_F(RawFile, LayoutsThatAreNoneAreRefused)
{
  const auto refused = [](const std::string & text, const std::string & part) {
    const std::string said = SaidOfLayout(text);
    EXPECT_NE(said.find(part), std::string::npos) << said;
    EXPECT_NE(said.find("expected WIDTHxHEIGHT:TYPE[:SKIP[:ROW[:GAP[:END]]]]"), std::string::npos) << said;
  };
  refused("", "its size is \"\"");
  refused("4x4", "it has 1 parts");
  refused("4:uint8", "its size is \"4\"");
  refused("4x4x4:uint8", "its size is \"4x4x4\"");
  refused("0x4:uint8", "a size of 0x4 pixels");
  refused("4x-4:uint8", "the height is \"-4\", not a whole number");
  refused("4x99999999999:uint8", "a size of");
  refused("4x4:uint16", "does not say which byte comes first; uint16le or uint16be would");
  refused("4x4:Mono9", "the type \"Mono9\" is not known");
  refused("4x4:Mono14Packed", "is not known");
  refused("4x4:s10p", "is not known");
  refused("4x4:", "the type \"\" is not known");
  refused("4x4:uint8:", "the bytes to skip is \"\"");
  refused("4x4:uint8:1:x", "the bytes of a row is \"x\"");
  refused("4x4:uint8:1:2:x", "the bytes behind a frame is \"x\"");
  refused("4x4:uint8:1:2:3:x", "the bytes at the end is \"x\"");
  refused("4x4:uint8:1:2:3:4:5", "it has 7 parts");
  refused("4x4:int32", "int32le or int32be would");
  refused("4x4:uint64le", "integers of 64 bits (uint64le) are not supported");
}
} // namespace
