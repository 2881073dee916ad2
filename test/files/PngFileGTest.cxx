// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameReader.h"
#include "helpers/FrameFileTestHelper.h"
#include "helpers/PngTestHelper.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <utility>

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

class PngFile : public FrameFileTest
{};

PngOf
PngWith(const std::string & before, const std::string & after = "")
{
  PngOf png;
  png.before = before;
  png.after = after;
  return png;
}

TEST_F(PngFile, OfEveryKindOfGreyIsAccepted)
{
  for (const unsigned interlacing : { 0u, 1u })
  {
    for (const std::size_t width : { 1, 2, 4, 5, 13 })
    {
      PngOf png;
      png.width = width;
      png.height = 14 - width;
      png.interlacing = interlacing;
      const FrameFile file = IsFrames("a.png", png.Bytes(), FramePixel::UnsignedShort, width, 14 - width, 1);
      EXPECT_STREQ(file.format->name, "PNG");
      EXPECT_EQ(file.identities.size(), 1u);
      png.depth = 8;
      IsFrames("b.png", png.Bytes(), FramePixel::UnsignedChar, width, 14 - width, 1);
    }
  }
  PngOf pieces = PngWith(PngChunkOf("gAMA", "abcd") + PngChunkOf("tEXt", "a"), PngChunkOf("tIME", "1234567"));
  pieces.piece = 10;
  IsFrames("pieces.png", pieces.Bytes() + "what follows is not read", FramePixel::UnsignedShort, 13, 9, 1);
}

TEST_F(PngFile, AnyChangedBitIsRefused)
{
  PngOf png = PngWith(PngChunkOf("tEXt", "a"));
  png.piece = 100;
  const std::string good = png.Bytes();
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit)
  {
    ASSERT_NE(SaidOf("a.png", WithChangedBit(good, bit)), "") << "bit " << bit;
  }
  for (std::size_t size = 0; size < good.size(); ++size)
  {
    ASSERT_NE(SaidOf("a.png", good.substr(0, size)), "") << size << " bytes";
  }
}

TEST_F(PngFile, WhatIsNotGreyIsRefused)
{
  PngOf png;
  for (const auto & [colour, words] : { std::pair{ 2u, "3 components a pixel" },
                                        std::pair{ 3u, "a palette of colours: 3 components" },
                                        std::pair{ 4u, "2 components" },
                                        std::pair{ 6u, "4 components" },
                                        std::pair{ 5u, "the colour type 5" } })
  {
    png.colour = colour;
    IsRefused("a.png", png.Bytes(), { words });
  }
  IsRefused("a.png", PngWith(PngChunkOf("tRNS", "ab")).Bytes(), { "transparent", "2 components a pixel" });
  png = {};
  png.depth = 4;
  png.rows = "x";
  IsRefused("a.png", png.Bytes(), { "4 bits a pixel; expected 8 or 16" });
}

TEST_F(PngFile, ChunksThatAreMissingOrAtAWrongPlaceAreRefused)
{
  const std::string png = PngOf{}.Bytes();
  const std::string header = PngChunkOf("IHDR", PngOf{}.Header());
  const std::string end = PngChunkOf("IEND", "");
  const std::string text = PngChunkOf("tEXt", "a");
  IsRefused("a.png", png.substr(0, png.size() - 12), { "truncated", "without the IEND chunk" });
  IsRefused("a.png", Replaced(png, header, text), { "begins with the chunk tEXt; expected IHDR first" });
  IsRefused("a.png", Replaced(png, header, header + header), { "two IHDR chunks" });
  IsRefused("a.png", png.substr(0, 8) + header + end, { "no IDAT chunk" });
  IsRefused("a.png", Replaced(png, header, PngChunkOf("IHDR", "abc")), { "an IHDR chunk of 3 bytes; expected 13" });
  IsRefused("a.png", PngWith(PngChunkOf("PLTE", "abc")).Bytes(), { "its chunk PLTE of 3 bytes has no place" });
  IsRefused("a.png", PngWith(PngChunkOf("ABCD", "abc")).Bytes(), { "its chunk ABCD" });
  IsRefused("a.png", PngWith(PngChunkOf("a1CD", "abc")).Bytes(), { "no chunk of PNG at byte 33" });
  IsRefused("a.png", PngWith("", text + PngChunkOf("IDAT", "a")).Bytes(), { "IDAT chunks apart from each other" });
  IsRefused("a.png", PngWith("", PngChunkOf("IDAT", "a")).Bytes(), { "compressed pixels give 243 bytes after" });
  PngOf otherEnd;
  otherEnd.end = PngChunkOf("IEND", "a");
  IsRefused("a.png", otherEnd.Bytes(), { "IEND of 1 bytes" });
  PngOf otherInterlacing;
  otherInterlacing.interlacing = 2;
  IsRefused(
    "a.png", otherInterlacing.Bytes(), { "compression 0, filters 0, interlacing 2; expected 0, 0, and 0 or 1" });
}

TEST_F(PngFile, AChunkWithAWrongChecksumOrBeyondTheEndIsRefused)
{
  std::string png = PngOf{}.Bytes();
  png[20] = static_cast<char>(png[20] ^ 1);
  IsRefused("a.png", png, { "damaged: the checksum of its chunk IHDR at byte 8 is wrong" });
  png = PngWith(std::string("\0\0\1\0tEXt", 8)).Bytes();
  IsRefused("a.png", png.substr(0, 200), { "truncated: its chunk tEXt of 256 bytes from byte 41 on does not end" });
}

TEST_F(PngFile, OtherThanExactlyItsPixelsAreRefused)
{
  PngOf png;
  png.rows = png.Rows().substr(1);
  IsRefused("a.png", png.Bytes(), { "compressed pixels give 242 bytes", "expected 243 bytes" });
  png.rows = PngOf{}.Rows() + "a";
  IsRefused("a.png", png.Bytes(), { "compressed pixels give more than 243 bytes" });
  png.rows = PngOf{}.Rows();
  png.rows[27] = 5;
  IsRefused("a.png", png.Bytes(), { "a row with the filter 5; expected 0 to 4" });
  png = {};
  png.width = 2147483648;
  png.rows = "a";
  IsRefused("a.png", png.Bytes(), { "size 2147483648 along axis 0; expected at least 1 and at most 2147483647" });
  png.width = 2147483647; // no memory is allocated for it
  IsRefused("a.png", png.Bytes(), { "compressed pixels give 1 bytes", "expected 38654705655 bytes" });
  png.width = 0;
  IsRefused("a.png", png.Bytes(), { "size 0 along axis 0" });
}

TEST_F(PngFile, TheSizeOfAPixelIsItsSpacing)
{
  const auto spacingOf = [this](const std::string & scale) {
    const std::string bytes = PngWith(PngChunkOf("sCAL", scale)).Bytes();
    return IsFrames("a.png", bytes, FramePixel::UnsignedShort, 13, 9, 1).geometry.spacing;
  };
  EXPECT_EQ(spacingOf(std::string("\1"
                                  "0.5\0"
                                  "2e-3",
                                  9)),
            (std::array<double, 3>{ 0.5, 2e-3, 1.0 }));
  EXPECT_EQ(spacingOf(std::string("\1"
                                  "0.5\0"
                                  "-2",
                                  7)),
            (std::array<double, 3>{ 1.0, 1.0, 1.0 }));
  EXPECT_EQ(spacingOf("\1"
                      "0.5"),
            (std::array<double, 3>{ 1.0, 1.0, 1.0 }));
}

/** Returns the bytes of a row, filtered by the PNG specification, 9.2. */
std::string
Filtered(const std::string & row, const std::string & above, std::size_t pixelBytes, unsigned filter)
{
  std::string out(1, static_cast<char>(filter));
  for (std::size_t i = 0; i < row.size(); ++i)
  {
    const auto byteOf = [](const std::string & bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
    const int  a = i < pixelBytes ? 0 : byteOf(row, i - pixelBytes);
    const int  b = above.empty() ? 0 : byteOf(above, i);
    const int  c = i < pixelBytes || above.empty() ? 0 : byteOf(above, i - pixelBytes);
    const int  p = a + b - c;
    const int  nearest = std::min({ std::abs(p - a), std::abs(p - b), std::abs(p - c) });
    const int  paeth = std::abs(p - a) == nearest ? a : std::abs(p - b) == nearest ? b : c;
    const int  predictions[]{ 0, a, b, (a + b) / 2, paeth };
    out += static_cast<char>(byteOf(row, i) - predictions[filter]);
  }
  return out;
}

// Sizes at which passes of Adam7 are empty, or end within their grid.
TEST_F(PngFile, PixelsAreThoseThatWereFilteredAndInterlaced)
{
  static constexpr std::size_t adam7[7][4]{ { 0, 0, 8, 8 }, { 4, 0, 8, 8 }, { 0, 4, 4, 8 }, { 2, 0, 4, 4 },
                                            { 0, 2, 2, 4 }, { 1, 0, 2, 2 }, { 0, 1, 1, 2 } };
  static constexpr std::size_t whole[1][4]{ { 0, 0, 1, 1 } };
  for (const std::size_t width : { 1, 3, 5, 13, 17 })
  {
    for (const unsigned kind : { 0u, 1u, 2u, 3u })
    {
      PngOf png;
      png.width = width;
      png.height = 18 - width;
      png.depth = kind % 2 == 0 ? 8 : 16;
      png.interlacing = kind / 2;
      png.piece = 50;
      const std::size_t bytes = png.depth / 8;
      const std::string pixels = RandomBytes(width * png.height * bytes);
      unsigned          filter = 0;
      for (std::size_t pass = 0; pass < (png.interlacing == 1 ? 7u : 1u); ++pass)
      {
        const std::size_t * const grid = png.interlacing == 1 ? adam7[pass] : whole[pass];
        std::string               above;
        for (std::size_t y = grid[1]; y < png.height && grid[0] < width; y += grid[3])
        {
          std::string row;
          for (std::size_t x = grid[0]; x < width; x += grid[2])
          {
            row += pixels.substr((y * width + x) * bytes, bytes);
          }
          png.rows += Filtered(row, above, bytes, filter++ % 5);
          above = row;
        }
      }
      const FrameFile file = InspectFrameFile(Write("a.png", png.Bytes()));
      std::string     found(pixels.size(), '\0');
      file.reader->Read(file, 0, 1, found.data());
      for (std::size_t i = 0; bytes == 2 && i < found.size(); i += 2)
      {
        std::swap(found[i], found[i + 1]); // PNG has the highest byte first
      }
      EXPECT_EQ(found, pixels) << width << ", kind " << kind;
      png.height -= 1;
      png.rows.clear();
      Write("a.png", png.Bytes());
      EXPECT_THROW(file.reader->Read(file, 0, 1, found.data()), FileError) << "another size";
    }
  }
}

} // namespace
