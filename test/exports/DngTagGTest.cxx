// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/NoiseProfile.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
/** A TIFF of both byte orders, written and read by the test itself. */
struct TestTiff
{
  bool isBigEndian{ false };

  std::string
  Bytes(std::uint64_t number, int count) const
  {
    std::string bytes;
    for (int i = 0; i < count; ++i)
    {
      bytes += static_cast<char>(number >> (8 * (isBigEndian ? count - 1 - i : i)) & 0xFFU);
    }
    return bytes;
  }
  std::uint64_t
  Number(const std::string & file, std::size_t at, int count) const
  {
    std::uint64_t number = 0;
    for (int i = 0; i < count; ++i)
    {
      const auto byte =
        static_cast<unsigned char>(file.at(at + static_cast<std::size_t>(isBigEndian ? i : count - 1 - i)));
      number = number << 8U | byte;
    }
    return number;
  }
  std::string
  Entry(unsigned tag, unsigned type, unsigned count, unsigned value) const
  {
    return Bytes(tag, 2) + Bytes(type, 2) + Bytes(count, 4) + Bytes(value, 4);
  }
  /** Width, height and a tag behind NoiseProfile; pixels of an odd number of bytes come first. */
  std::string
  Make(const std::string & pixels, const std::string & more = {}) const
  {
    const std::string entries = Entry(256, 4, 1, 7) + Entry(257, 4, 1, 9) + more + Entry(51111, 4, 1, 3);
    return (isBigEndian ? "MM" : "II") + Bytes(42, 2) + Bytes(8 + pixels.size(), 4) + pixels +
           Bytes(entries.size() / 12, 2) + entries + Bytes(1234, 4);
  }
  /** A file whose first directory is a preview with these SubIFDs. The entries of each are given; a directory has two
   * entries beside the offsets. The offsets of several stand in an array behind the head. */
  std::string
  MakePreview(const std::vector<std::string> & subIfds) const
  {
    std::string file = (isBigEndian ? "MM" : "II") + Bytes(42, 2) + Bytes(0, 4);
    std::string offsets;
    for (const std::string & entries : subIfds)
    {
      offsets += Bytes(file.size(), 4);
      file += Bytes(entries.size() / 12, 2) + entries + Bytes(0, 4);
    }
    const auto many = static_cast<unsigned>(subIfds.size());
    const auto value = static_cast<unsigned>(many == 1 ? Number(offsets, 0, 4) : file.size());
    file += many == 1 ? "" : offsets;
    file.replace(4, 4, Bytes(file.size(), 4));
    const std::string entries = Entry(254, 4, 1, 1) + Entry(330, 4, many, value) + Entry(51111, 4, 1, 3);
    return file + Bytes(3, 2) + entries + Bytes(1234, 4);
  }
  /** Places of the offsets of the SubIFDs of the first directory. */
  std::vector<std::size_t>
  Pointers(const std::string & file) const
  {
    std::vector<std::size_t> places;
    std::size_t              at = Number(file, 4, 4) + 2;
    for (; Number(file, at, 2) != 330; at += 12)
    {
    }
    const auto count = Number(file, at + 4, 4);
    for (std::size_t i = 0; i < count; ++i)
    {
      places.push_back(count == 1 ? at + 8 : Number(file, at + 8, 4) + 4 * i);
    }
    return places;
  }
  /** Tags of the first directory in their order, each with its type, count and value. */
  std::vector<std::vector<std::uint64_t>>
  Entries(const std::string & file) const
  {
    return EntriesAt(file, 4, 1234);
  }
  /** Tags of the directory whose offset is at \a pointer. */
  std::vector<std::vector<std::uint64_t>>
  EntriesAt(const std::string & file, std::size_t pointer, unsigned next) const
  {
    std::size_t                             at = Number(file, pointer, 4);
    std::vector<std::vector<std::uint64_t>> entries;
    const auto                              count = Number(file, at, 2);
    for (at += 2; entries.size() < count; at += 12)
    {
      entries.push_back(
        { Number(file, at, 2), Number(file, at + 2, 2), Number(file, at + 4, 4), Number(file, at + 8, 4) });
    }
    EXPECT_EQ(Number(file, at, 4), next) << "the next directory";
    return entries;
  }
  double
  Double(const std::string & file, std::size_t at) const
  {
    const std::uint64_t bits = Number(file, at, 8);
    double              number = 0.0;
    std::memcpy(&number, &bits, sizeof number);
    return number;
  }
};

const std::vector<std::pair<double, double>> threePlanes{ { 1e-4, 2e-7 }, { 1.5e-4, 0.0 }, { 3e-4, 1e-8 } };

/** Returns the pairs that --check-profile reads in a file. */
std::vector<std::pair<double, double>>
PairsIn(const std::string & file)
{
  std::vector<std::pair<double, double>> pairs;
  for (const ProfileChannel & channel : ReadNoiseProfile("photo.dng", file).channels)
  {
    pairs.emplace_back(channel.scale, channel.constant.value());
  }
  return pairs;
}
} // namespace

TEST(DngTag, IsAddedInItsPlaceAndNothingElseChanges)
{
  for (const bool isBigEndian : { false, true })
  {
    for (const char * pixels : { "pixel", "pixels" })
    {
      const TestTiff    tiff{ isBigEndian };
      const std::string file = tiff.Make(pixels);
      const std::string copy = WithNoiseProfile(file, threePlanes);
      EXPECT_EQ(copy.substr(0, 4), file.substr(0, 4));
      EXPECT_EQ(copy.substr(8, file.size() - 8), file.substr(8)) << "offsets of the file stay true";
      const auto entries = tiff.Entries(copy);
      ASSERT_EQ(entries.size(), 4U);
      EXPECT_EQ(entries[0], (std::vector<std::uint64_t>{ 256, 4, 1, 7 }));
      EXPECT_EQ(entries[1], (std::vector<std::uint64_t>{ 257, 4, 1, 9 }));
      EXPECT_EQ(entries[3], (std::vector<std::uint64_t>{ 51111, 4, 1, 3 }));
      EXPECT_EQ(entries[2][0], 51041U);
      EXPECT_EQ(entries[2][1], 12U); // DOUBLE
      ASSERT_EQ(entries[2][2], 6U);
      EXPECT_EQ(entries[2][3] % 2, 0U);
      for (std::size_t plane = 0; plane < 3; ++plane)
      {
        EXPECT_EQ(tiff.Double(copy, entries[2][3] + 16 * plane), threePlanes[plane].first);
        EXPECT_EQ(tiff.Double(copy, entries[2][3] + 16 * plane + 8), threePlanes[plane].second);
      }
    }
  }
}

TEST(DngTag, ReplacesOneThatIsThere)
{
  const TestTiff    tiff{ false };
  const std::string once = WithNoiseProfile(tiff.Make("pixels"), threePlanes);
  const std::string twice = WithNoiseProfile(once, { { 5e-4, 6e-7 } });
  const auto        entries = tiff.Entries(twice);
  ASSERT_EQ(entries.size(), 4U);
  EXPECT_EQ(entries[2][2], 2U);
  EXPECT_EQ(tiff.Double(twice, entries[2][3]), 5e-4);
}

// DNG 1.7: NoiseProfile is a tag of the raw directory, which is the main image (NewSubfileType 0) in the SubIFDs of a
// preview. Adobe's DNG SDK writes and reads it in the first directory: both have it.
TEST(DngTag, IsAlsoInTheRawDirectoryBelowAPreview)
{
  for (const bool isBigEndian : { false, true })
  {
    const TestTiff    tiff{ isBigEndian };
    const std::string preview = tiff.Entry(254, 4, 1, 1) + tiff.Entry(256, 4, 1, 5);
    const std::string mask = tiff.Entry(254, 4, 1, 4) + tiff.Entry(256, 4, 1, 7);
    const std::string raw = tiff.Entry(254, 4, 1, 0) + tiff.Entry(256, 4, 1, 7) + tiff.Entry(51111, 4, 1, 9);
    const std::string old = tiff.Entry(256, 4, 1, 7) + tiff.Entry(51041, 12, 2, 8) + tiff.Entry(51111, 4, 1, 9);
    for (const auto & [subIfds, place] : std::vector<std::pair<std::vector<std::string>, std::size_t>>{
           { { raw }, 0 }, { { preview, mask, raw, preview }, 2 }, { { old }, 0 }, { { preview, old }, 1 } })
    {
      const std::string file = tiff.MakePreview(subIfds);
      const std::string copy = WithNoiseProfile(file, threePlanes);
      const auto        first = tiff.Entries(copy);
      ASSERT_EQ(first.size(), 4U);
      EXPECT_EQ(first[2][0], 51041U);
      const auto pointers = tiff.Pointers(copy);
      ASSERT_EQ(pointers.size(), subIfds.size());
      for (std::size_t i = 0; i < subIfds.size(); ++i)
      {
        if (i != place)
        {
          EXPECT_EQ(tiff.EntriesAt(copy, pointers[i], 0), tiff.EntriesAt(file, tiff.Pointers(file)[i], 0)) << i;
        }
      }
      const auto entries = tiff.EntriesAt(copy, pointers[place], 0);
      const auto tag = entries.size() - 2;
      EXPECT_EQ(entries[tag][0], 51041U);
      ASSERT_EQ(entries[tag][2], 6U);
      EXPECT_EQ(tiff.Double(copy, entries[tag][3] + 16), threePlanes[1].first);
      EXPECT_EQ(entries.back(), (std::vector<std::uint64_t>{ 51111, 4, 1, 9 }));
      EXPECT_EQ(entries[tag - 1], (std::vector<std::uint64_t>{ 256, 4, 1, 7 }));
      EXPECT_EQ(PairsIn(copy), threePlanes);
    }
    for (const std::string & file : { tiff.MakePreview({ preview }), tiff.MakePreview({}) }) // no main image
    {
      EXPECT_EQ(PairsIn(WithNoiseProfile(file, threePlanes)), threePlanes);
    }
  }
}

// Programs such as exiftool write the tag into the raw directory alone.
TEST(DngTag, IsReadInTheRawDirectoryIfTheFirstHasNone)
{
  const TestTiff    tiff{ false };
  const std::string raw = tiff.Entry(51041, 12, 2, 0);
  std::string       file = tiff.MakePreview({ raw });
  file.replace(8 + 2 + 8, 4, tiff.Bytes(file.size(), 4)); // the offset of the values
  const double scale = 3e-4;
  const double offset = 5e-8;
  std::string  values(16, '\0');
  std::memcpy(values.data(), &scale, 8);
  std::memcpy(values.data() + 8, &offset, 8);
  EXPECT_EQ(PairsIn(file + values), (std::vector<std::pair<double, double>>{ { scale, offset } }));
  EXPECT_THROW(PairsIn(file), ExportError) << "ends before the values";
  EXPECT_THROW(PairsIn(tiff.MakePreview({ tiff.Entry(256, 4, 1, 7) })), ExportError);
}

TEST(DngTag, OtherAndDamagedFilesAreRefused)
{
  const TestTiff    tiff{ true };
  const std::string file = tiff.Make("pixels");
  const auto        refused = [](const std::string & bytes, const std::string & part) {
    try
    {
      WithNoiseProfile(bytes, threePlanes);
      ADD_FAILURE() << part;
    }
    catch (const ExportError & error)
    {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused("", "no classic TIFF");
  refused("II+\0" + file, "no classic TIFF"); // of 64-bit offsets
  for (std::size_t length = 4; length < file.size(); length += 3)
  {
    refused(file.substr(0, length), "before the end of its first directory");
  }
  refused("MM" + tiff.Bytes(42, 2) + tiff.Bytes(0xFFFFFFFF, 4), "before the end");
  std::string preview = tiff.MakePreview({ tiff.Entry(256, 4, 1, 7) });
  preview.replace(tiff.Pointers(preview).front(), 4, tiff.Bytes(preview.size() - 1, 4));
  refused(preview, "before the end of its raw directory");
}

// DNG 1.7: NoiseProfile refers to levels between BlackLevel (50714) and WhiteLevel (50717) of the raw directory.
TEST(DngTag, LevelsAreTheLevelsOfTheRawDirectory)
{
  const auto levelsOf = [](const std::string & file, ExportSettings settings = {}) {
    SetLevelsOfDng(file, settings);
    return std::make_pair(settings.blackLevelDn.value(), settings.whiteLevelDn.value());
  };
  using Levels = std::pair<double, double>;
  for (const bool isBigEndian : { false, true })
  {
    const TestTiff    tiff{ isBigEndian };
    const std::string version = tiff.Entry(50706, 1, 4, 0x401);
    const auto        shortTag = [&](unsigned tag, unsigned value) { // stands first in the field of the value
      return tiff.Bytes(tag, 2) + tiff.Bytes(3, 2) + tiff.Bytes(1, 4) + tiff.Bytes(value, 2) + tiff.Bytes(0, 2);
    };
    const std::string bits = shortTag(258, 14);
    EXPECT_EQ(levelsOf(tiff.Make("pixels", version)), Levels(0.0, 1.0));
    EXPECT_EQ(levelsOf(tiff.Make("pixels", bits + version)), Levels(0.0, 16383.0));
    EXPECT_EQ(levelsOf(tiff.Make("pixels", bits + version + shortTag(50714, 512) + tiff.Entry(50717, 4, 1, 16000))),
              Levels(512.0, 16000.0));
    // four places of a pattern, of RATIONAL: 64, 65, 66 and 67 DN, behind the head
    std::string places;
    for (const unsigned level : { 64U, 65U, 66U, 67U })
    {
      places += tiff.Bytes(2 * level, 4) + tiff.Bytes(2, 4);
    }
    const std::string file = tiff.Make(places, version + tiff.Entry(50714, 5, 4, 8) + tiff.Entry(50717, 4, 1, 4095));
    EXPECT_EQ(levelsOf(file), Levels(65.5, 4095.0));
    ExportSettings given;
    given.blackLevelDn = 64.0;
    given.whiteLevelDn = 4095.0;
    EXPECT_EQ(levelsOf(file, given), Levels(65.5, 4095.0));
    given.blackLevelDn = 63.0;
    EXPECT_THROW(levelsOf(file, given), ExportUseError);
    given.blackLevelDn = 65.0;
    given.whiteLevelDn = 16383.0;
    EXPECT_THROW(levelsOf(file, given), ExportUseError);
    EXPECT_THROW(levelsOf(tiff.Make("pixels")), ExportError) << "no DNGVersion";
    EXPECT_THROW(levelsOf(tiff.Make("pixels", version + tiff.Entry(50714, 4, 1000000, 8))), ExportError);
    const std::string noQuotient = tiff.Bytes(64, 4) + tiff.Bytes(0, 4);
    EXPECT_THROW(levelsOf(tiff.Make(noQuotient, version + tiff.Entry(50714, 5, 1, 8))), ExportError);
  }
}
