// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/FrameFileTestHelper.h"
#include "helpers/TiffTestHelper.h"

#include <string>

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

class TiffStrips : public FrameFileTest
{};

TEST_F(TiffStrips, TablesAndStripsOutsideOfTheFileAreRefused)
{
  const auto isRefused = [this](const TiffTags & tags, const std::string & words) {
    IsRefused("a.tif", TiffWith(tags).Bytes(), { words });
  };
  isRefused({ { 257, { 4, { 40 } } } }, "its tag 273 (StripOffsets) has 3 values; expected 10, one for each strip");
  isRefused({ { 279, {} } }, "its tag 279 (StripByteCounts) has 0 values; expected 3");
  isRefused({ { 279, { 3, { 104, 0, 26 } } } }, "its strip 1 has 0 bytes");
  isRefused({ { 273, { 4, { 8, 112, 100000 } } } }, "its strip 2 has 26 bytes from byte 100000 on, but the file has");
  isRefused({ { 273, { 4, { 0, 112, 216 } } } }, "its strip 0 has 104 bytes from byte 0");
  isRefused({ { 256, { 4, { 13, 13 } } } }, "its tag 256 (ImageWidth) has 2 values");
  isRefused({ { 256, { 2, { 13 } } } }, "its tag 256 (ImageWidth) has 1 values of type 2");
  isRefused({ { 256, {} } }, "has no tag 256 (ImageWidth)");
  isRefused({ { 278, { 4, { 0 } } } }, "RowsPerStrip is 0");
  isRefused({ { 256, { 4, { 0 } } } }, "size 0 along axis 0");
  isRefused({ { 305, { 99, { 0 } } } }, "its tag 305 is of type 99");
  TiffOf deflated = TiffWith({ { 259, {} } }); // the default is no compression
  deflated.compression = 8;
  IsRefused("a.tif", deflated.Bytes(), { "its strip 0 has", "bytes, but its rows have 104; expected as many" });
  const TiffOf tiff;
  IsRefused("a.tif",
            Replaced(tiff.Bytes(), tiff.Number(277, 2), tiff.Number(278, 2)),
            { "its tag 278 comes twice; expected each once" });
  TiffOf            outside = TiffWith({ { 305, Text("a long name of a program") } });
  const std::string good = outside.Bytes();
  const std::string entry = outside.Number(305, 2) + outside.Number(2, 2) + outside.Number(24, 4);
  IsRefused("a.tif",
            Replaced(good, entry, outside.Number(305, 2) + outside.Number(2, 2) + outside.Number(0xFFFFFFFF, 4)),
            { "its tag 305 has 4294967295 values of 1 bytes" });
}

TEST_F(TiffStrips, BytesThatAreReadTwiceAreRefused)
{
  for (const std::int64_t move : { -1, 1, -20, 20, -200 })
  {
    TiffOf tiff;
    tiff.moveStrip = move;
    IsRefused("a.tif", tiff.Bytes(), { "damaged: the byte", "expected each byte to be read once" });
  }
  const TiffTags many{ { 273, { 4, { 8, 8, 8 } } }, { 279, { 4, { 500, 500, 500 } } } };
  TiffOf         deflated = TiffWith(many);
  deflated.compression = 8;
  IsRefused("a.tif", deflated.Bytes(), { "its strips overlap, or lie in more places than can be checked" });
  const TiffTags same{ { 273, { 4, { 8, 112, 216 } } } };
  IsRefused("a.tif", TiffWith(same).Bytes(), { "damaged: the byte 8 belongs to two" });
}

TEST_F(TiffStrips, StripsThatDoNotGiveTheirBytesAreRefused)
{
  TiffOf            tiff;
  const std::string first = tiff.StripOf(0, 0, 4);
  const auto        isRefused = [this, &tiff](const std::string & strip, const std::string & words) {
    tiff.strip = strip;
    IsRefused("a.tif", tiff.Bytes(), { "damaged: its strip 0 ", words });
  };
  isRefused(first.substr(1), "has 103 bytes, but its rows have 104; expected as many");
  isRefused(first + "a", "has 105 bytes, but its rows have 104");
  tiff.compression = 8;
  isRefused(ZlibStream(first.substr(1)), "gives 103 bytes, expected 104 bytes and the end of the stream");
  isRefused(ZlibStream(first + "a"), "gives more than 104 bytes");
  const std::string stream = ZlibStream(first);
  isRefused(stream.substr(0, stream.size() - 4), "104 bytes and then an error (no end of the stream)");
  isRefused(stream.substr(0, stream.size() - 1) + "a", "104 bytes and then an error (incorrect data check)");
  isRefused("abc", "0 bytes and then an error (incorrect header check)");
  tiff.compression = 32773;
  isRefused(PackedBits(std::string(26, 'a')), "ends within row 1 of its PackBits; expected 26 bytes a row");
  isRefused(PackedBits(std::string(104, 'a')), "has a run beyond the end of row 0 of its PackBits");
  isRefused("\x05zz", "ends within row 0");
}

TEST_F(TiffStrips, LzwThatDoesNotGiveItsBytesIsRefused)
{
  TiffOf tiff;
  tiff.compression = 5;
  const auto isRefused = [this, &tiff](const std::string & strip, const std::string & words) {
    tiff.strip = strip;
    IsRefused("a.tif", tiff.Bytes(), { "damaged: its strip 0 gives " + words });
  };
  isRefused(LzwStream(std::string(103, 'a')), "103 bytes of LZW, expected 104 bytes");
  isRefused(LzwStream(std::string(105, 'a')), "105 bytes of LZW, expected 104 bytes");
  isRefused(std::string(100, '\0'), "a code without a meaning after 0 bytes");
  LzwWriter codes;
  codes.Add(256, 9);
  codes.Add('a', 9);
  codes.Add('b', 9);
  isRefused(codes.Bytes(), "2 bytes of LZW");
  codes.Add(259, 9); // the string that begins with it: "bb"
  codes.Add(261, 9); // not known before 260
  isRefused(codes.Bytes(), "a code without a meaning after 4 bytes");
}

TEST_F(TiffStrips, LzwOfAnyLengthIsFollowed)
{
  TiffOf tiff;
  tiff.compression = 5;
  tiff.width = 100;
  tiff.height = 100;
  tiff.rowsPerStrip = 100;
  const std::string random = RandomBytes(20000);
  for (const std::string & plain : { random, std::string(20000, 'a'), std::string(10000, 'a') + random.substr(10000) })
  {
    tiff.strip = LzwStream(plain);
    IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedShort, 100, 100, 3);
  }
  tiff.fillUp = 50;
  tiff.rowsPerStrip = 75;
  tiff.strip.clear();
  IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedShort, 100, 100, 3);
}

TEST_F(TiffStrips, AnyChangedBitOfADeflatedPageIsRefusedOrDoesNotMatter)
{
  TiffOf tiff;
  tiff.compression = 8;
  tiff.pages.resize(2);
  ChangeEachBit("a.tif", tiff.Bytes(), [](const FrameFile & found, std::size_t bit) {
    EXPECT_EQ(found.width * found.height * found.frames, 13u * 9 * 2) << "bit " << bit;
  });
}

} // namespace
