// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/FrameFileTestHelper.h"
#include "helpers/PngTestHelper.h"

#include <string>

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

TEST_F(PngFile, OfEveryKindThatITKReadsIsAccepted)
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
      EXPECT_EQ(file.significantBits, 0u);
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
    std::string damaged = good;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
    ASSERT_NE(SaidOf("a.png", damaged), "") << "bit " << bit;
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
  IsRefused("a.png", png.Bytes(), { "4 bits a pixel, which ITK stretches to 8; expected 8 or 16" });
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
  IsRefused("a.png",
            PngWith(PngChunkOf("tEXt", std::string(8000001, 'a'))).Bytes(),
            { "its chunk tEXt has 8000001 bytes; expected at most 8000000" });
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
  png.width = 1000001;
  png.rows = "a";
  IsRefused("a.png", png.Bytes(), { "1000001 x 9 pixels; expected at most 1000000" });
  png.width = 0;
  IsRefused("a.png", png.Bytes(), { "size 0 along axis 0" });
}

TEST_F(PngFile, SignificantBitsAreToldWhereNothingIsLost)
{
  PngOf png = PngWith(PngChunkOf("sBIT", "\x0C"));
  png.shift = 4;
  for (const unsigned interlacing : { 0u, 1u })
  {
    png.interlacing = interlacing;
    EXPECT_EQ(IsFrames("a.png", png.Bytes(), FramePixel::UnsignedShort, 13, 9, 1).significantBits, 12u);
  }
  png.interlacing = 0;
  png.shift = 3;
  IsRefused("a.png", png.Bytes(), { "sBIT chunk says that 12 of 16 bits", "the others are not 0" });
  png.before = PngChunkOf("sBIT", "\x10");
  EXPECT_EQ(IsFrames("a.png", png.Bytes(), FramePixel::UnsignedShort, 13, 9, 1).significantBits, 0u);
  png.before = PngChunkOf("sBIT", "\x11");
  IsRefused("a.png", png.Bytes(), { "an sBIT chunk of 1 bytes that says 17 bits" });
  png.before = PngChunkOf("sBIT", "ab");
  IsRefused("a.png", png.Bytes(), { "an sBIT chunk of 2 bytes" });
  png.before = "";
  png.after = PngChunkOf("sBIT", "\x0C");
  IsRefused("a.png", png.Bytes(), { "an sBIT chunk", "expected one before the pixels" });
}

// A filtered row is what it is filtered from, though its own bytes are 0.
TEST_F(PngFile, FiltersAreUndoneBeforeBitsAreLookedAt)
{
  for (const unsigned filter : { 1u, 2u, 3u, 4u })
  {
    PngOf png = PngWith(PngChunkOf("sBIT", "\x0C"));
    png.height = 2;
    png.shift = 4;
    std::string second = png.Row(13, filter);
    png.rows = png.Row(13, 0) + second;
    const bool averages = filter == 3; // half of 16 n: bits below 16 appear
    EXPECT_EQ(SaidOf("a.png", png.Bytes()).empty(), !averages) << "filter " << filter;
    second[2] = 1; // the low byte of the first code
    png.rows = png.Row(13, 0) + second;
    IsRefused("a.png", png.Bytes(), { "the others are not 0" });
  }
}

} // namespace
