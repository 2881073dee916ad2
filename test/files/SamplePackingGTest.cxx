// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameReader.h"
#include "helpers/BurstFilesTestHelper.h"

#include <cstddef>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

// Bits of pixels in bytes.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

const unsigned char *
BytesOf(const std::string & text)
{
  return reinterpret_cast<const unsigned char *>(text.data());
}

GreyValues
Unpacked(SamplePacking packing, unsigned bits, const std::string & bytes)
{
  const SampleFormat format{ FramePixel::UnsignedShort, packing, false, bits };
  const std::size_t  groups = bytes.size() / BytesInGroup(format);
  EXPECT_EQ(bytes.size() % BytesInGroup(format), 0u);
  std::vector<unsigned short> pixels(groups * SamplesInGroup(format));
  UnpackSamples(format, BytesOf(bytes), groups, pixels.data());
  return { pixels.begin(), pixels.end() };
}

// The examples of the Linux kernel's documentation and of GenICam's Pixel Format Naming Convention, by hand.
TEST(SamplePacking, IsThatOfTheStandards)
{
  const GreyValues two{ 0xABC, 0x123 };
  EXPECT_EQ(Unpacked(SamplePacking::LowestFirst, 12, "\xBC\x3A\x12"), two);
  EXPECT_EQ(Unpacked(SamplePacking::HighestFirst, 12, "\xAB\xC1\x23"), two);
  EXPECT_EQ(Unpacked(SamplePacking::GigE, 12, "\xAB\x3C\x12"), two);
  EXPECT_EQ(Unpacked(SamplePacking::Mipi, 12, "\xAB\x12\x3C"), two);
  EXPECT_EQ(Unpacked(SamplePacking::GigE, 10, "\xFF\x21\x80"), (GreyValues{ 0x3FD, 0x202 }));
  EXPECT_EQ(Unpacked(SamplePacking::Mipi, 10, "\x01\x02\x03\xFF\xE4"), (GreyValues{ 4, 9, 14, 1023 }));
}

TEST(SamplePacking, UnpacksWhatWasPacked)
{
  std::mt19937 random(1);
  for (const unsigned bits : { 10U, 12U, 14U })
  {
    GreyValues greyValues;
    for (int i = 0; i < 4000; ++i)
    {
      greyValues.push_back(static_cast<unsigned>(random() >> (32 - bits)));
    }
    EXPECT_EQ(Unpacked(SamplePacking::LowestFirst, bits, BitStream(greyValues, bits, false)), greyValues) << bits;
    EXPECT_EQ(Unpacked(SamplePacking::HighestFirst, bits, BitStream(greyValues, bits, true)), greyValues) << bits;
    EXPECT_EQ(Unpacked(SamplePacking::Mipi, bits, MipiPacked(greyValues, bits)), greyValues) << bits;
    if (bits < 14)
    {
      EXPECT_EQ(Unpacked(SamplePacking::GigE, bits, GigEPacked(greyValues, bits)), greyValues) << bits;
    }
  }
}

TEST(SamplePacking, TurnsWholeNumbersAround)
{
  const SampleFormat format{ FramePixel::Float, SamplePacking::Whole, true, 32 };
  float              number = 0.0F;
  UnpackSamples(format, BytesOf(std::string("\x3F\xC0\0\0", 4)), 1, &number);
  EXPECT_EQ(number, 1.5F);
  const SampleFormat shorts{ FramePixel::Short, SamplePacking::Whole, false, 16 };
  short              pair[2] = {};
  UnpackSamples(shorts, BytesOf("\xFE\xFF\x01\x02"), 2, pair);
  EXPECT_EQ(pair[0], -2);
  EXPECT_EQ(pair[1], 0x201);
}
} // namespace
