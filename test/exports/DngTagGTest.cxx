// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/NoiseExport.h"

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
  /** Tags of the first directory in their order, each with its type, count and value. */
  std::vector<std::vector<std::uint64_t>>
  Entries(const std::string & file) const
  {
    std::size_t                             at = Number(file, 4, 4);
    std::vector<std::vector<std::uint64_t>> entries;
    const auto                              count = Number(file, at, 2);
    for (at += 2; entries.size() < count; at += 12)
    {
      entries.push_back(
        { Number(file, at, 2), Number(file, at + 2, 2), Number(file, at + 4, 4), Number(file, at + 8, 4) });
    }
    EXPECT_EQ(Number(file, at, 4), 1234U) << "the next directory";
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
}
