// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameReader.h"
#include "helpers/FrameFileTestHelper.h"
#include "helpers/TiffTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// Tiles of a TIFF. The frame has 37 x 21 pixels, so that tiles of 16 x 16 are filled up at the right and at the bottom.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

constexpr std::size_t Width = 37;
constexpr std::size_t Height = 21;

class TiffTiles : public FrameFileTest
{
protected:
  static TiffOf
  Tiled(std::size_t tileWidth = 16, std::size_t tileLength = 16)
  {
    TiffOf tiff;
    tiff.width = Width;
    tiff.height = Height;
    tiff.tileWidth = tileWidth;
    tiff.tileLength = tileLength;
    return tiff;
  }

  static TiffOf
  TiledWith(const TiffTags & tags)
  {
    TiffOf tiff = Tiled();
    tiff.pages.assign(3, tags);
    return tiff;
  }

  /** Expects that the file is accepted, and that each pixel has the value that the helper gave it. */
  template <typename TPixel>
  void
  IsRead(const TiffOf & tiff, FramePixel pixel) const
  {
    const FrameFile     file = IsFrames("a.tif", tiff.Bytes(), pixel, Width, Height, 3);
    std::vector<TPixel> pixels(Width * Height * 3);
    file.reader->Read(file, 0, 3, pixels.data());
    std::vector<TPixel> expected;
    for (std::size_t page = 0; page < 3; ++page)
    {
      for (std::size_t y = 0; y < Height; ++y)
      {
        for (std::size_t x = 0; x < Width; ++x)
        {
          expected.push_back(static_cast<TPixel>(TiffOf::Sample(page, x, y)));
        }
      }
    }
    EXPECT_TRUE(pixels == expected) << tiff.compression << ' ' << tiff.bits << ' ' << tiff.predictor;
  }
};

TEST_F(TiffTiles, OfEveryCompressionOrderAndSizeAreRead)
{
  for (const unsigned compression : { 1u, 8u, 32946u, 32773u, 5u })
  {
    for (const unsigned kind : { 0u, 1u, 2u, 3u })
    {
      for (const auto & [width, length] : { std::pair<std::size_t, std::size_t>{ 16, 16 },
                                            { 32, 16 },
                                            { 16, 32 },
                                            { 48, 64 } }) // a tile above the frame
      {
        TiffOf tiff = Tiled(width, length);
        tiff.isBig = (kind & 1) != 0;
        tiff.isBigEndian = (kind & 2) != 0;
        tiff.compression = compression;
        IsRead<std::uint16_t>(tiff, FramePixel::UnsignedShort);
      }
    }
  }
  IsRead<std::uint16_t>(Tiled(37, 7), FramePixel::UnsignedShort); // not of 16 pixels, and none of them filled up
}

TEST_F(TiffTiles, OfEveryPixelTypeAreRead)
{
  TiffOf bytes = Tiled();
  bytes.bits = 8;
  IsRead<std::uint8_t>(bytes, FramePixel::UnsignedChar);
  IsRead<std::int16_t>(TiledWith({ { 339, { 3, { 2 } } } }), FramePixel::Short);
  for (const bool isBigEndian : { false, true })
  {
    TiffOf sums = Tiled();
    sums.bits = 32;
    sums.isBigEndian = isBigEndian;
    IsRead<double>(sums, FramePixel::Double);
    sums.pages.assign(3, { { 339, { 3, { 2 } } } });
    IsRead<double>(sums, FramePixel::Double);
  }
}

// The differences begin anew in each row of a tile.
TEST_F(TiffTiles, PredictorsAreUndoneInTheRowsOfTiles)
{
  for (const unsigned compression : { 8u, 5u })
  {
    for (const unsigned bits : { 8u, 16u, 32u })
    {
      TiffOf tiff = TiledWith({ { 317, { 3, { 2 } } } });
      tiff.compression = compression;
      tiff.predictor = 2;
      tiff.bits = bits;
      bits == 8    ? IsRead<std::uint8_t>(tiff, FramePixel::UnsignedChar)
      : bits == 16 ? IsRead<std::uint16_t>(tiff, FramePixel::UnsignedShort)
                   : IsRead<double>(tiff, FramePixel::Double);
    }
  }
}

/** The pixels are floating-point numbers with the same bits as the helper's integers. */
TEST_F(TiffTiles, FloatingPointPredictorIsUndone)
{
  TiffOf tiff = TiledWith({ { 317, { 3, { 3 } } }, { 339, { 3, { 3 } } } });
  tiff.compression = 8;
  tiff.predictor = 3;
  tiff.bits = 32;
  const FrameFile            file = IsFrames("a.tif", tiff.Bytes(), FramePixel::Float, Width, Height, 3);
  std::vector<std::uint32_t> bits(Width * Height * 3);
  file.reader->Read(file, 0, 3, bits.data());
  EXPECT_EQ(bits[Width * 20 + 36], TiffOf::Sample(0, 36, 20));
  EXPECT_EQ(bits[Width * (2 * Height + 17) + 15], TiffOf::Sample(2, 15, 17));
}

TEST_F(TiffTiles, AndStripsOfAnyCompressionMayBeMixed)
{
  TiffOf packed = Tiled();
  packed.compression = 8;
  packed.pages.resize(1);
  const std::string bytes = packed.Bytes();
  // a second page of one strip, whose directory lies behind it
  TiffOf strips = Tiled();
  strips.tileWidth = 0;
  strips.rowsPerStrip = Height;
  const std::string pixels = strips.StripOf(1, 0, Height);
  const TiffTags    tags{ { 256, { 4, { Width } } }, { 257, { 4, { Height } } },       { 258, { 3, { 16 } } },
                          { 262, { 3, { 1 } } },     { 273, { 4, { bytes.size() } } }, { 279, { 4, { pixels.size() } } } };
  std::string       both = bytes + pixels;
  std::size_t       directory = 0;
  for (std::size_t byte = 4; byte-- > 0;)
  {
    directory = directory * 256 + static_cast<unsigned char>(bytes[4 + byte]);
  }
  const std::size_t link = directory + 2 + 12 * static_cast<unsigned char>(bytes[directory]);
  both.replace(link, 4, strips.Number(both.size(), 4));
  both += strips.Directory(tags, both.size());
  const FrameFile            file = IsFrames("a.tif", both, FramePixel::UnsignedShort, Width, Height, 2);
  std::vector<std::uint16_t> read(Width * Height * 2);
  file.reader->Read(file, 0, 2, read.data());
  EXPECT_EQ(read[Width * 20 + 36], TiffOf::Sample(0, 36, 20));
  EXPECT_EQ(read[Width * (Height + 20) + 36], TiffOf::Sample(1, 36, 20));
}

TEST_F(TiffTiles, WhatTheirTagsMustSayIsRequired)
{
  const auto isRefused = [this](const TiffTags & tags, const std::string & words) {
    IsRefused("a.tif", TiledWith(tags).Bytes(), { words });
  };
  isRefused({ { 322, {} } }, "has no tag 322 (TileWidth)");
  isRefused({ { 323, {} } }, "has no tag 323 (TileLength)");
  isRefused({ { 324, {} } }, "its tag 324 (TileOffsets) has 0 values; expected 6, one for each tile");
  isRefused({ { 325, {} } }, "its tag 325 (TileByteCounts) has 0 values; expected 6, one for each tile");
  isRefused({ { 322, { 4, { 48 } } } }, "its tag 324 (TileOffsets) has 6 values; expected 2, one for each tile");
  isRefused({ { 257, { 4, { 40 } } } }, "its tag 324 (TileOffsets) has 6 values; expected 9, one for each tile");
  isRefused({ { 325, { 4, { 512 } } } }, "its tag 325 (TileByteCounts) has 1 values; expected 6");
  isRefused({ { 324, { 2, { 8, 8, 8, 8, 8, 8 } } } }, "its tag 324 (TileOffsets) has 6 values of type 2; expected 6");
  isRefused({ { 322, { 4, { 0 } } } }, "its tiles have a size of 0 x 16 pixels; expected at least 1 x 1");
  isRefused({ { 323, { 4, { 0 } } } }, "its tiles have a size of 16 x 0 pixels; expected at least 1 x 1");
  isRefused({ { 322, { 4, { 100000 } } }, { 323, { 4, { 100000 } } } },
            "its tiles have a size of 100000 x 100000 pixels; expected at most 67108864 pixels");
  isRefused({ { 322, { 16, { UINT64_MAX } } }, { 323, { 16, { UINT64_MAX } } } }, "expected at most 67108864 pixels");
  isRefused({ { 273, { 4, { 8 } } } }, "has tags of strips and of tiles; expected one of both");
  isRefused({ { 279, { 4, { 8 } } } }, "has tags of strips and of tiles; expected one of both");
}

// The number of bytes that are read is in proportion to the frames: 4 times their pixels, and 2^20 = 1024 x 1024 more.
TEST_F(TiffTiles, FarAboveTheFrameAreRefused)
{
  TiffOf tiff = Tiled(1024, 1024);
  tiff.compression = 8;
  IsRead<std::uint16_t>(tiff, FramePixel::UnsignedShort); // 1024 x 1024 <= 4 x 777 + 2^20
  tiff.tileWidth = 1027;
  IsRead<std::uint16_t>(tiff, FramePixel::UnsignedShort); // 3072 pixels above 2^20, of 3108
  tiff.tileWidth = 1028;
  IsRefused("a.tif",
            tiff.Bytes(),
            { "its tiles have a size of 1028 x 1024 pixels, far above a frame of 37 x 21; expected at most 4 times" });
  tiff = Tiled();
  tiff.width = 1;
  tiff.height = 1;
  tiff.pages.assign(3, { { 322, { 4, { 8192 } } }, { 323, { 4, { 8192 } } } }); // 128 MiB a page
  IsRefused("a.tif", tiff.Bytes(), { "8192 x 8192 pixels, far above a frame of 1 x 1" });
}

TEST_F(TiffTiles, OutsideOfTheFileAreRefused)
{
  IsRefused(
    "a.tif", TiledWith({ { 325, { 4, { 512, 512, 0, 512, 512, 512 } } } }).Bytes(), { "its tile 2 has 0 bytes" });
  IsRefused("a.tif",
            TiledWith({ { 324, { 4, { 8, 520, 1032, 1544, 2056, 100000 } } } }).Bytes(),
            { "truncated: its tile 5 has 512 bytes from byte 100000 on, but the file has" });
  IsRefused("a.tif",
            TiledWith({ { 324, { 4, { 0, 520, 1032, 1544, 2056, 2568 } } } }).Bytes(),
            { "its tile 0 has 512 bytes from byte 0" });
  const std::string good = Tiled().Bytes();
  for (std::size_t size = 1; size < good.size(); size += 7)
  {
    ASSERT_NE(SaidOf("a.tif", good.substr(0, size)), "") << size << " bytes";
  }
}

TEST_F(TiffTiles, WhoseBytesAreReadTwiceAreRefused)
{
  for (const std::int64_t move : { -1, 1, -20, 20, -600 })
  {
    TiffOf tiff = Tiled();
    tiff.moveStrip = move;
    IsRefused(
      "a.tif", tiff.Bytes(), { "damaged: the byte", "belongs to two of its strips or tiles, or to one of them" });
  }
  TiffOf deflated =
    TiledWith({ { 324, { 4, { 8, 8, 8, 8, 8, 8 } } }, { 325, { 4, { 900, 900, 900, 900, 900, 900 } } } });
  deflated.compression = 8;
  IsRefused("a.tif", deflated.Bytes(), { "its tiles overlap, or lie in more places than can be checked" });
  TiffOf same = TiledWith({ { 324, { 4, { 8, 8, 8, 8, 8, 8 } } } });
  IsRefused("a.tif", same.Bytes(), { "damaged: the byte 8 belongs to two" });
}

TEST_F(TiffTiles, ThatDoNotGiveTheirBytesAreRefused)
{
  TiffOf            tiff = Tiled();
  const std::string first = tiff.PixelsOf(0, 0, 0, 16, 16);
  const auto        isRefused = [this, &tiff](const std::string & tile, const std::string & words) {
    tiff.strip = tile;
    IsRefused("a.tif", tiff.Bytes(), { "damaged: its tile 0 ", words });
  };
  isRefused(first.substr(1), "has 511 bytes, but its rows have 512; expected as many");
  isRefused(first + "a", "has 513 bytes, but its rows have 512");
  tiff.compression = 8;
  isRefused(ZlibStream(first.substr(1)), "gives 511 bytes, expected 512 bytes and the end of the stream");
  isRefused(ZlibStream(first + "a"), "gives more than 512 bytes");
  const std::string stream = ZlibStream(first);
  isRefused(stream.substr(0, stream.size() - 1) + "a", "512 bytes and then an error (incorrect data check)");
  tiff.compression = 32773;
  isRefused(PackedBits(std::string(32, 'a')), "ends within row 1 of its PackBits; expected 32 bytes a row");
  isRefused(PackedBits(std::string(104, 'a')), "has a run beyond the end of row 0 of its PackBits");
  tiff.compression = 5;
  isRefused(LzwStream(std::string(511, 'a')), "511 bytes of LZW, expected 512 bytes");
  isRefused(std::string(100, '\0'), "a code without a meaning after 0 bytes");
}

// A strip may end with the image. A tile at the edge may not: it is filled up.
TEST_F(TiffTiles, AtTheEdgeThatEndWithTheImageAreRefused)
{
  TiffOf            tiff = Tiled(48, 32);
  const std::string whole = tiff.PixelsOf(0, 0, 0, 48, 32);
  for (const unsigned compression : { 1u, 8u, 5u })
  {
    tiff.compression = compression;
    const std::string cut = whole.substr(0, 2 * 48 * Height);
    tiff.strip = compression == 8 ? ZlibStream(cut) : compression == 5 ? LzwStream(cut) : cut;
    IsRefused("a.tif", tiff.Bytes(), { "damaged: its tile 0 ", "2016 bytes" });
  }
}

TEST_F(TiffTiles, ImagesBehindATiledPageOfImageJAreRefused)
{
  TiffOf tiff = Tiled(48, 32);
  tiff.pages.assign(1, { { 270, Text("ImageJ=1.53t\nimages=3\n") } });
  const std::string said = SaidOf("a.tif", tiff.Bytes() + std::string(10000, 'a'));
  EXPECT_NE(said.find("pages: 1, but ImageJ's description of it says images=3"), std::string::npos) << said;
  EXPECT_EQ(said.find("--raw"), std::string::npos) << said;
}

// Two pages: in a single page, another width with the same number of tiles would be accepted, because the padding of
// the tiles would be read as pixels.
TEST_F(TiffTiles, AnyChangedBitOfTwoPagesIsRefusedOrLeavesTheSize)
{
  TiffOf tiff = Tiled();
  tiff.width = 13;
  tiff.height = 9;
  tiff.bits = 8;
  tiff.compression = 8;
  tiff.pages.resize(2);
  ChangeEachBit("a.tif", tiff.Bytes(), [](const FrameFile & found, std::size_t bit) {
    ASSERT_EQ(found.width * found.height * found.frames, 13u * 9 * 2) << "bit " << bit;
    std::vector<unsigned char> pixels(found.bytes);
    found.reader->Read(found, 0, 2, pixels.data());
    ASSERT_EQ(pixels[13 * 17 + 12], TiffOf::Sample(1, 12, 8)) << "bit " << bit;
  });
}

} // namespace
