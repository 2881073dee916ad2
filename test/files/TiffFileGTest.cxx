// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameReader.h"
#include "helpers/FrameFileTestHelper.h"
#include "helpers/TiffTestHelper.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

class TiffFile : public FrameFileTest
{};

template <typename TPixel>
std::vector<TPixel>
PixelsOf(const FrameFile & file)
{
  std::vector<TPixel> pixels(file.width * file.height * file.frames);
  file.reader->Read(file, 0, file.frames, pixels.data());
  return pixels;
}

TEST_F(TiffFile, OfEveryKindThatITKReadsIsAccepted)
{
  for (const bool isBig : { false, true })
  {
    for (const bool isBigEndian : { false, true })
    {
      for (const unsigned compression : { 1u, 8u, 32946u, 32773u, 5u })
      {
        TiffOf tiff;
        tiff.isBig = isBig;
        tiff.isBigEndian = isBigEndian;
        tiff.compression = compression;
        const FrameFile file = IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedShort, 13, 9, 3);
        EXPECT_STREQ(file.format->name, "TIFF");
        tiff.pages.resize(1);
        IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedShort, 13, 9, 1);
        tiff.bits = 8;
        tiff.rowsPerStrip = 9;
        IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedChar, 13, 9, 1);
      }
    }
  }
  IsFrames("a.tif", TiffWith({ { 339, { 3, { 2 } } } }).Bytes(), FramePixel::Short, 13, 9, 3);
  TiffOf real = TiffWith({ { 339, { 3, { 3 } } } });
  real.bits = 32;
  IsFrames("a.tif", real.Bytes(), FramePixel::Float, 13, 9, 3);
}

TEST_F(TiffFile, WhatWritersAddIsAccepted)
{
  const auto isAccepted = [this](const TiffOf & tiff) {
    IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedShort, 13, 9, 3);
  };
  isAccepted(TiffWith({ { 254, { 4, { 0 } } } }));      // full images
  isAccepted(TiffWith({ { 254, { 4, { 2 } } } }));      // pages
  isAccepted(TiffWith({ { 336, { 3, { 0, 255 } } } })); // ink levels
  isAccepted(TiffWith({ { 262, { 3, { 0 } } } }));      // 0 is white
  isAccepted(TiffWith({ { 270, Text("ImageJ=1.53t\nimages=3\nslices=3\n") } }));
  isAccepted(TiffWith({ { 305, Text("a program") }, { 50839, { 1, { 1, 2, 3, 4, 5, 6 } } } }));
  for (const unsigned compression : { 1u, 8u })
  {
    TiffOf filledUp;
    filledUp.compression = compression;
    filledUp.fillUp = 3;
    isAccepted(filledUp);
  }
  TiffOf apart;
  apart.between = std::string(100, 'x');
  isAccepted(apart);
  apart.between = std::string(1000, 'x'); // what a program keeps there
  isAccepted(apart);
  TiffOf predicted = TiffWith({ { 317, { 3, { 2 } } } });
  predicted.compression = 8;
  isAccepted(predicted);
}

// TIFF 6.0 gives these tags a default, and writers leave them out: ImageJ of before 2022 had no tag 259.
TEST_F(TiffFile, TagsThatAreMissingHaveTheDefaultOfTiff)
{
  TiffOf tiff;
  tiff.rowsPerStrip = tiff.height;
  tiff.pages.assign(3, { { 259, {} }, { 277, {} }, { 278, {} } });
  IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedShort, 13, 9, 3);
  IsRefused("a.tif", TiffWith({ { 258, {} } }).Bytes(), { "1-bit unsigned samples" });
  TiffOf mixed;
  mixed.pages[0] = { { 254, { 4, { 0 } } } }; // the default, once said and twice not
  mixed.pages[2] = { { 254, { 4, { 2 } } } }; // a page among others
  IsFrames("a.tif", mixed.Bytes(), FramePixel::UnsignedShort, 13, 9, 3);
}

TEST_F(TiffFile, PixelsOfOtherTypesAndOrdersAreRefused)
{
  const auto isRefused = [this](const TiffTags & tags, const std::string & words) {
    IsRefused("a.tif", TiffWith(tags).Bytes(), { words });
  };
  isRefused({ { 258, { 3, { 8 } } }, { 339, { 3, { 2 } } } }, "8-bit signed samples, which are not supported");
  isRefused({ { 339, { 3, { 3 } } } }, "16-bit floating-point samples, which are not supported");
  isRefused({ { 339, { 3, { 0 } } } }, "16-bit format 0 samples");
  isRefused({ { 258, { 3, { 64 } } } }, "64-bit unsigned");
  isRefused({ { 258, { 3, { 12 } } } }, "12-bit unsigned");
  isRefused({ { 277, { 3, { 3 } } } }, "3 components a pixel; expected 1");
  isRefused({ { 262, { 3, { 3 } } } }, "palette of colours");
  isRefused({ { 262, {} } }, "has no tag 262");
  isRefused({ { 274, { 3, { 0 } } } }, "damaged: Orientation is 0; expected 1 to 8");
  isRefused({ { 274, { 3, { 9 } } } }, "damaged: Orientation is 9; expected 1 to 8");
  isRefused({ { 266, { 3, { 2 } } } }, "FillOrder is 2");
  isRefused({ { 32997, { 4, { 2 } } } }, "ImageDepth is 2");
}

TEST_F(TiffFile, OtherCompressionsAreRefusedByName)
{
  for (const auto & [compression, words] : { std::pair{ 7u, "compressed by JPEG, which changes the noise" },
                                             std::pair{ 34712u, "JPEG 2000" },
                                             std::pair{ 34925u, "LZMA" },
                                             std::pair{ 50000u, "Zstandard" },
                                             std::pair{ 50001u, "WebP" },
                                             std::pair{ 4u, "method 4, which cannot be checked" } })
  {
    TiffOf tiff;
    tiff.compression = compression;
    IsRefused("a.tif", tiff.Bytes(), { words, "expected no compression, deflate, LZW or PackBits" });
  }
  TiffOf tiff = TiffWith({ { 317, { 3, { 3 } } } });
  tiff.compression = 8;
  IsRefused("a.tif", tiff.Bytes(), { "Predictor is 3; expected 1 or 2" });
}

// Raw converters add a thumbnail in colours, compressed by JPEG.
TEST_F(TiffFile, ThumbnailsAreLeftOut)
{
  const TiffTags small{ { 254, { 4, { 1 } } },       { 256, { 4, { 4 } } }, { 257, { 4, { 3 } } },
                        { 258, { 3, { 8, 8, 8 } } }, { 259, { 3, { 7 } } }, { 262, { 3, { 6 } } },
                        { 277, { 3, { 3 } } } };
  TiffOf         tiff;
  tiff.pages[1] = small;
  const FrameFile file = IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedShort, 13, 9, 2);
  EXPECT_EQ(PixelsOf<std::uint16_t>(file)[117], TiffOf::Sample(2, 0, 0));
  tiff.pages[2] = small;
  IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedShort, 13, 9, 1);
  tiff.pages[2].erase(254);
  tiff.pages[2][255] = { 3, { 2 } };
  IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedShort, 13, 9, 1);

  tiff.pages[2].erase(255); // a small page that is not said to be a thumbnail
  IsRefused("a.tif", tiff.Bytes(), { "a.tif, page 2: 3 components a pixel" });
  tiff.pages[2] = { { 254, { 4, { 1 } } }, { 256, { 4, { 4 } } } }; // as high as the frames
  IsRefused("a.tif", tiff.Bytes(), { "a.tif, page 2: 4 x 9 pixels, but the first page has 13 x 9" });
  tiff.pages = { small, {}, {} };
  IsRefused("a.tif", tiff.Bytes(), { "a.tif: 3 components a pixel" });
}

// A row of the file is a row of the sensor, and a mosaic keeps its phase, however a viewer turns the frame.
TEST_F(TiffFile, PixelsAreReadAsTheyAreStoredWhateverTheOrientation)
{
  const auto read = [this](const TiffOf & tiff) {
    const FrameFile file = IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedShort, 13, 9, 3);
    return std::pair{ PixelsOf<std::uint16_t>(file), file.warning };
  };
  const auto [expected, silence] = read(TiffOf{});
  EXPECT_EQ(expected[13 + 1], 101);
  EXPECT_EQ(silence, "");
  for (std::uint64_t orientation = 1; orientation <= 8; ++orientation)
  {
    const auto [pixels, warning] = read(TiffWith({ { 274, { 3, { orientation } } } }));
    EXPECT_EQ(pixels, expected) << orientation;
    EXPECT_EQ(
      warning.rfind("its Orientation is " + std::to_string(orientation) + ", so that viewers turn or mirror", 0),
      orientation == 1 ? std::string::npos : 0u)
      << warning;
  }
  TiffOf mixed;
  mixed.pages[1] = { { 274, { 3, { 6 } } } };
  EXPECT_EQ(read(mixed).first, expected);
  EXPECT_NE(read(mixed).second, "");
}

TEST_F(TiffFile, PagesThatAreNotAlikeAreRefused)
{
  const auto isRefused = [this](const TiffTags & tags, const std::string & words) {
    TiffOf tiff;
    tiff.pages[1] = tags;
    IsRefused("a.tif", tiff.Bytes(), { words });
  };
  isRefused({ { 256, { 4, { 4 } } } }, "a.tif, page 1: 4 x 9 pixels, but the first page has 13 x 9");
  isRefused({ { 339, { 3, { 2 } } } }, "page 1: 16-bit signed samples, but the first page has 16-bit unsigned ones");
  isRefused({ { 254, { 4, { 1 } } } }, "pages: 3, 1 of them marked as thumbnails or masks");
  isRefused({ { 255, { 3, { 2 } } } }, "pages: 3, 1 of them marked as thumbnails");
  IsRefused("a.tif",
            TiffWith({ { 270, Text("ImageJ=1.54\nimages=500\nslices=500\n") } }).Bytes(),
            { "pages: 3, but ImageJ's description of it says images=500" });
  IsRefused("a.tif",
            TiffWith({ { 33629, { 4, { 1, 2, 3, 4, 5, 6, 7 } } } }).Bytes(),
            { "pages: 3, but MetaMorph's description of it says 7 planes" });
}

TEST_F(TiffFile, AChainOfPagesThatIsBrokenOrHasNoEndIsRefused)
{
  const std::string good = TiffOf{}.Bytes();
  const auto        linkOf = [&good](std::size_t page) {
    std::size_t at = 4;
    for (std::size_t i = 0; i < page; ++i)
    {
      std::size_t directory = 0;
      for (std::size_t byte = 4; byte-- > 0;)
      {
        directory = directory * 256 + static_cast<unsigned char>(good[at + byte]);
      }
      at = directory + 2 + 12 * static_cast<unsigned char>(good[directory]);
    }
    return at;
  };
  const TiffOf tiff;
  std::string  damaged = good;
  damaged.replace(linkOf(3), 4, good.substr(4, 4));
  IsRefused("a.tif", damaged, { "a.tif, page 3: damaged: its directory is also the directory of an earlier page" });
  damaged = good;
  damaged.replace(linkOf(1), 4, tiff.Number(100000, 4));
  IsRefused("a.tif", damaged, { "truncated: 1 of its pages can be read, but the file says that more follow" });
  damaged.replace(linkOf(1), 4, tiff.Number(0, 4));
  IsRefused("a.tif", damaged, { "bytes belong to none of its pages, and there is a directory among them" });
  damaged = good;
  damaged.replace(4, 4, tiff.Number(0, 4));
  IsRefused("a.tif", damaged, { "a TIFF without a page" });
  damaged.replace(4, 4, tiff.Number(good.size() - 1, 4));
  IsRefused("a.tif", damaged, { "truncated: its directory is at byte" });
  IsRefused("a.tif", good.substr(0, 6), { "truncated: ends after 6 bytes" });
  const std::string directory = "II*" + std::string(1, '\0') + tiff.Number(8, 4);
  IsRefused("a.tif", directory + tiff.Number(0, 2) + "abcdef", { "its directory at byte 8 has 0 entries; expected 1" });
  IsRefused(
    "a.tif", directory + tiff.Number(4097, 2) + std::string(60000, '\0'), { "has 4097 entries; expected 1 to 4096" });
  IsRefused("a.tif", directory + tiff.Number(99, 2) + std::string(99, '\0'), { "has 99 entries and does not end in" });
  IsRefused("a.tif",
            "II+" + std::string(1, '\0') + tiff.Number(4, 2) + tiff.Number(0, 2) + tiff.Number(16, 8),
            { "a BigTIFF whose offsets have 4 bytes; expected 8" });
  for (std::size_t size = 1; size < good.size(); ++size)
  {
    ASSERT_NE(SaidOf("a.tif", good.substr(0, size)), "") << size << " bytes";
  }
}

TEST_F(TiffFile, MorePagesThan16BitsCountAreRead)
{
  TiffOf tiff;
  tiff.width = 1;
  tiff.height = 1;
  tiff.bits = 8;
  tiff.pages.resize(65535);
  IsFrames("a.tif", tiff.Bytes(), FramePixel::UnsignedChar, 1, 1, 65535);
}

} // namespace
