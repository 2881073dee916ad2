// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/BurstFilesTestHelper.h"
#include "files/FrameReader.h"
#include "helpers/FrameFileTestHelper.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

// Frames in the format of astronomers.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

using Cards = std::vector<std::pair<std::string, std::string>>;

std::string
FilledUp(std::string text, char with)
{
  text.resize((text.size() + 2879) / 2880 * 2880, with);
  return text;
}

/** Returns a unit of the file: its cards, then END, then its data. */
std::string
UnitOf(const Cards & cards, const std::string & data)
{
  std::string text;
  for (const auto & [key, value] : cards)
  {
    std::string card = key;
    card.resize(8, ' ');
    card += "= " + value;
    card.resize(80, ' ');
    text += card;
  }
  text += "END";
  return FilledUp(text, ' ') + FilledUp(data, '\0');
}

/** Returns the cards of an image of 4 x 2 pixels, two frames, with some more. */
Cards
CardsOf(int bits, const Cards & more = {})
{
  Cards cards{ { "SIMPLE", "                   T" },
               { "BITPIX", std::to_string(bits) + " / bits of a pixel" },
               { "NAXIS", "3" },
               { "NAXIS1", "4" },
               { "NAXIS2", "2" },
               { "NAXIS3", "2" } };
  cards.insert(cards.end(), more.begin(), more.end());
  return cards;
}

std::string
Big(const GreyValues & greyValues, std::size_t bytes)
{
  return BytesOfGreyValues(greyValues, bytes, true);
}

GreyValues
SixteenGreyValues(unsigned first, unsigned step)
{
  GreyValues greyValues;
  for (unsigned i = 0; i < 16; ++i)
  {
    greyValues.push_back(first + step * i);
  }
  return greyValues;
}

class FitsFile : public FrameFileTest
{
protected:
  template <typename TPixel>
  std::vector<TPixel>
  Read(const std::string & bytes, FramePixel pixel, std::size_t first = 0, std::size_t count = 2) const
  {
    const FrameFile     file = IsFrames("a.fits", bytes, pixel, 4, 2, 2);
    std::vector<TPixel> pixels(8 * count);
    EXPECT_STREQ(file.format->name, "FITS");
    file.reader->Read(file, first, count, pixels.data());
    return pixels;
  }
};

TEST_F(FitsFile, EachTypeIsReadExactly)
{
  const GreyValues greyValues = SixteenGreyValues(0, 4369); // 0 to 65535
  const auto       signedOf = [&greyValues](int add) {
    std::vector<int> numbers;
    for (const unsigned greyValue : greyValues)
    {
      numbers.push_back(static_cast<std::int16_t>(greyValue) + add);
    }
    return numbers;
  };
  const auto shorts = signedOf(0);
  const auto unsignedShorts = signedOf(32768);
  EXPECT_EQ(Read<short>(UnitOf(CardsOf(16), Big(greyValues, 2)), FramePixel::Short),
            std::vector<short>(shorts.begin(), shorts.end()));
  const std::string asUnsigned = UnitOf(CardsOf(16, { { "BZERO", "32768" }, { "BSCALE", "1.0" } }), Big(greyValues, 2));
  EXPECT_EQ(Read<unsigned short>(asUnsigned, FramePixel::UnsignedShort),
            std::vector<unsigned short>(unsignedShorts.begin(), unsignedShorts.end()));
  EXPECT_EQ(Read<unsigned short>(asUnsigned, FramePixel::UnsignedShort, 1, 1),
            std::vector<unsigned short>(unsignedShorts.begin() + 8, unsignedShorts.end()));
  EXPECT_EQ(Read<unsigned char>(UnitOf(CardsOf(8), Big(SixteenGreyValues(0, 17), 1)), FramePixel::UnsignedChar)[15],
            255);
  const GreyValues wide = SixteenGreyValues(0x80000000, 100000007);
  EXPECT_EQ(Read<double>(UnitOf(CardsOf(32), Big(wide, 4)), FramePixel::Double)[0], -2147483648.0);
  const std::string wideUnsigned = UnitOf(CardsOf(32, { { "BZERO", "2147483648" } }), Big(wide, 4));
  EXPECT_EQ(Read<double>(wideUnsigned, FramePixel::Double)[15], 1500000105.0);
  EXPECT_EQ(Read<float>(UnitOf(CardsOf(-32), Big(SixteenGreyValues(0x40490FDB, 1), 4)), FramePixel::Float)[0],
            3.14159274F);
  EXPECT_EQ(
    Read<double>(UnitOf(CardsOf(-64), std::string("\x3F\xF8", 2) + std::string(126, '\0')), FramePixel::Double)[0],
    1.5);
}

TEST_F(FitsFile, OtherScalesAndBlanksAreDouble)
{
  const std::string scaled = UnitOf(CardsOf(16, { { "BZERO", "1.5D2" }, { "BSCALE", "0.25" }, { "BLANK", "-1" } }),
                                    Big(SixteenGreyValues(65535, 2), 2));
  const std::vector<double> pixels = Read<double>(scaled, FramePixel::Double);
  EXPECT_TRUE(std::isnan(pixels[0]));
  EXPECT_EQ(pixels[1], 150.25);
  EXPECT_EQ(Read<double>(UnitOf(CardsOf(-32, { { "BSCALE", "2" } }), Big(SixteenGreyValues(0x3F800000, 0), 4)),
                         FramePixel::Double)[3],
            2.0);
}

TEST_F(FitsFile, TheOnlyImageOfAFileIsRead)
{
  const Cards       empty{ { "SIMPLE", "T" }, { "BITPIX", "8" }, { "NAXIS", "0" } };
  Cards             extension = CardsOf(16);
  const std::string pixels = Big(SixteenGreyValues(7, 1), 2);
  extension[0] = { "XTENSION", "'IMAGE   '" };
  const Cards       table{ { "XTENSION", "'BINTABLE'" }, { "BITPIX", "8" }, { "NAXIS", "2" },
                           { "NAXIS1", "10" },           { "NAXIS2", "3" }, { "PCOUNT", "5" } };
  const std::string first = UnitOf(empty, "");
  EXPECT_EQ(Read<short>(first + UnitOf(table, std::string(35, 't')) + UnitOf(extension, pixels), FramePixel::Short)[0],
            7);
  IsRefused("a.fits", first, { "has 0 images; expected one" });
  IsRefused("a.fits", UnitOf(CardsOf(16), pixels) + UnitOf(extension, pixels), { "has 2 images; expected one" });
  Cards compressed = table;
  compressed.emplace_back("ZIMAGE", "T");
  IsRefused("a.fits", first + UnitOf(compressed, std::string(35, 't')), { "HDU 1: an image in compressed tiles" });
  IsRefused("a.fits", UnitOf(CardsOf(16), pixels) + "and more", { "HDU 1: damaged: at byte 5760 is no extension" });
  Cards four = CardsOf(16);
  four[2].second = "4";
  four.emplace_back("NAXIS4", "1");
  Read<short>(UnitOf(four, pixels), FramePixel::Short);
  four.back().second = "2";
  IsRefused("a.fits", UnitOf(four, pixels), { "4 dimensions; expected 2 (a frame) or 3 (a stack)" });
}

TEST_F(FitsFile, TheChecksumOfItsDataIsChecked)
{
  const std::string pixels = Big(GreyValues(16, 258), 2);                                 // 8 times 0x01020102
  const std::string good = UnitOf(CardsOf(16, { { "DATASUM", "'135268368'" } }), pixels); // 0x08100810
  Read<short>(good, FramePixel::Short);
  std::string damaged = good;
  damaged[2880 + 5] = '\x03';
  IsRefused("a.fits", damaged, { "damaged: the checksum of its data is", "expected DATASUM, 135268368" });
}

TEST_F(FitsFile, SaysWhatTheHeaderSaysOfTheCamera)
{
  const auto camera = [this](const Cards & cards) {
    return IsFrames("a.fits", UnitOf(CardsOf(16, cards), std::string(32, 'a')), FramePixel::Short, 4, 2, 2).camera;
  };
  const Cards named{ { "INSTRUME", "'O''Brien''s camera' / maker" }, { "EXPTIME", "0.25" }, { "BAYERPAT", "'RGGB'" } };
  EXPECT_EQ(camera(named).camera, "O'Brien's camera");
  EXPECT_EQ(camera(named).exposureSeconds, 0.25);
  EXPECT_EQ(camera(named).bayerPattern, "");
  Cards ordered = named;
  ordered.emplace_back("ROWORDER", "'TOP-DOWN'");
  EXPECT_EQ(camera(ordered).bayerPattern, "RGGB");
  ordered.emplace_back("YBAYROFF", "1");
  EXPECT_EQ(camera(ordered).bayerPattern, "");
}

TEST_F(FitsFile, AnExposureOf0IsRecorded)
{
  const auto exposure = [this](const Cards & cards) {
    const std::string bytes = UnitOf(CardsOf(16, cards), std::string(32, 'a'));
    return IsFrames("a.fits", bytes, FramePixel::Short, 4, 2, 2).camera.exposureSeconds;
  };
  EXPECT_EQ(exposure({ { "EXPTIME", "0.0" } }), 0.0); // exposure of a bias frame
  EXPECT_EQ(exposure({ { "EXPTIME", "0." }, { "EXPOSURE", "0.5" } }), 0.5);
  EXPECT_EQ(exposure({ { "EXPTIME", "2.5D-1" } }), 0.25);
  EXPECT_TRUE(std::isnan(exposure({})));
  EXPECT_TRUE(std::isnan(exposure({ { "EXPTIME", "-1.0" } })));
  EXPECT_TRUE(std::isnan(exposure({ { "EXPTIME", "'unknown'" } })));
  EXPECT_TRUE(std::isnan(exposure({ { "EXPTIME", "" } })));
}

TEST_F(FitsFile, DamagedHeadersAreRefused)
{
  const std::string pixels(32, 'a');
  const std::string good = UnitOf(CardsOf(16), pixels);
  const auto        with = [&pixels](std::size_t card, const std::string & value) {
    Cards cards = CardsOf(16);
    cards[card].second = value;
    return UnitOf(cards, pixels);
  };
  IsFrames("a.fits", good, FramePixel::Short, 4, 2, 2);
  IsRefused("a.fits", good.substr(0, 5759), { "truncated: its last block ends at byte 5760, but the file has 5759" });
  IsRefused("a.fits", good.substr(0, 2880 + 31), { "truncated: its data have 32 bytes from byte 2880 on" });
  IsRefused("a.fits", good.substr(0, 200), { "truncated: the file ends within a header" });
  IsRefused("a.fits", with(1, "12"), { "damaged: BITPIX is 12; expected 8, 16, 32, 64, -32 or -64" });
  IsRefused("a.fits", UnitOf(CardsOf(64), std::string(128, 'a')), { "component type long long is not supported" });
  IsRefused("a.fits", with(3, "4x"), { "its keyword NAXIS1 is \"4x\"; expected a whole number" });
  IsRefused("a.fits", with(3, "-4"), { "NAXIS1 is -4; expected at least 0" });
  IsRefused("a.fits", with(3, "0").substr(0, 2880), { "size 0 along axis 0" });
  IsRefused("a.fits", with(5, "900000000000000000"), { "more data than can be counted in bytes" });
  IsRefused("a.fits", with(2, "1000"), { "NAXIS is 1000; expected 0 to 999" });
  IsRefused("a.fits", with(2, "4"), { "has no keyword NAXIS4" });
  IsRefused("a.fits", UnitOf(CardsOf(16, { { "BITPIX", "8" } }), pixels), { "the keyword BITPIX comes twice" });
  IsFrames("a.fits",
           UnitOf(CardsOf(16, { { "ORIGIN", "'a'" }, { "ORIGIN", "'b'" } }), pixels), // as programs write it
           FramePixel::Short,
           4,
           2,
           2);
  IsRefused(
    "a.fits", UnitOf(CardsOf(16, { { "GROUPS", "T" } }), pixels), { "holds random groups, which are no image" });
  IsRefused("a.fits", UnitOf(CardsOf(16, { { "BSCALE", "0" } }), pixels), { "BSCALE is 0" });
  IsRefused("a.fits", UnitOf(CardsOf(16, { { "BZERO", "nan" } }), pixels), { "BZERO is \"nan\"; expected a number" });
  IsRefused("a.fits", Replaced(good, "/ bits", "/ \x01its"), { "card 1 of its header is no text of ASCII" });
  for (std::size_t size = 1; size < 2880 + 32; size += 7)
  {
    ASSERT_NE(SaidOf("a.fits", good.substr(0, size)), "") << size << " bytes";
  }
}

} // namespace
