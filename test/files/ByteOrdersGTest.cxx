// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FileBytes.h"
#include "files/FrameFormats.h"
#include "helpers/FrameFileTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

// Images are smooth in the right order of their bytes alone.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

constexpr std::size_t Width = 64;

/** Returns a ramp of 8 DN per pixel, with noise of a standard deviation of \a noiseDn about \a levelDn, the lowest byte
 * first. */
std::string
FrameOf(double levelDn, double noiseDn, double slopeDn)
{
  std::mt19937_64            random(7);
  std::normal_distribution<> noise(0.0, noiseDn);
  std::string                bytes;
  for (std::size_t i = 0; i < Width * Width; ++i)
  {
    const double level = levelDn + slopeDn * static_cast<double>(i % Width) + noise(random);
    const auto   greyValue = static_cast<unsigned int>(static_cast<int>(std::lround(level)) + 65536) % 65536U;
    bytes += static_cast<char>(greyValue % 256U);
    bytes += static_cast<char>(greyValue / 256U);
  }
  return bytes;
}

/** Returns the end of a text behind \a words; "none" if it does not have them. */
std::string
PartBehind(const std::string & text, const std::string & words)
{
  const std::size_t at = text.find(words);
  return at == std::string::npos ? "none" : text.substr(at + words.size());
}

class ByteOrdersOfRaw : public FrameFileTest
{
protected:
  std::string
  WarningOf(const std::string & bytes, const std::string & type) const
  {
    return InspectRawFile(Write("a.raw", bytes), ReadRawLayout("64x64:" + type)).warning;
  }
};
} // namespace

TEST_F(ByteOrdersOfRaw, SwappedBytesAreNamedWithTheTypeToUse)
{
  for (const std::string & frame :
       { FrameOf(1000.0, 20.0, 40.0), FrameOf(1000.0, 8.0, 0.0), FrameOf(300.0, 300.0, 9.0) })
  {
    EXPECT_EQ(WarningOf(frame, "uint16le"), "");
    EXPECT_NE(WarningOf(frame, "uint16be").find("its bytes look swapped"), std::string::npos);
    EXPECT_NE(WarningOf(frame, "uint16be").find("--raw 64x64:uint16le"), std::string::npos);
    EXPECT_NE(WarningOf(frame, "int16be").find("--raw 64x64:int16le"), std::string::npos);
  }
}

TEST_F(ByteOrdersOfRaw, TheLayoutToUseKeepsTheBytesBesideThePixels)
{
  const std::string frame = FrameOf(1000.0, 20.0, 40.0);
  const std::string skipped(16, '\0');
  const std::string at = "--raw 64x64:uint16le";
  EXPECT_EQ(PartBehind(WarningOf(frame, "uint16be:0:0"), at), "");
  EXPECT_EQ(PartBehind(WarningOf(skipped + frame, "uint16be:16"), at), ":16");
  EXPECT_EQ(PartBehind(WarningOf(frame + skipped, "uint16be:0:0:16"), at), ":0:0:16");
  EXPECT_EQ(PartBehind(WarningOf(skipped + frame + "four", "uint16be:16:128:0:4"), at), ":16:128:0:4");
}

TEST_F(ByteOrdersOfRaw, SignedNoiseAboutZeroIsInOrder)
{
  const std::string frame = FrameOf(0.0, 8.0, 0.0);
  EXPECT_EQ(WarningOf(frame, "int16le"), "");
  EXPECT_NE(WarningOf(frame, "int16be"), "");
}

TEST_F(ByteOrdersOfRaw, FramesThatMakeSenseInBothOrdersAreNotNamed)
{
  const std::string levels(2 * Width * Width, '\x12'); // one level
  EXPECT_EQ(WarningOf(levels, "uint16le"), "");
  EXPECT_EQ(WarningOf(levels, "uint16be"), "");
  std::string bytes; // 8 bits in the high byte: the camera shifts its digital numbers
  for (std::size_t i = 0; i < Width * Width; ++i)
  {
    bytes += '\0';
    bytes += static_cast<char>(i % 200);
  }
  EXPECT_EQ(WarningOf(bytes, "uint16le"), "");
  std::mt19937_64 random(3);
  std::string     uniform; // noise of all 16 bits, which no order makes smooth
  for (std::size_t i = 0; i < 2 * Width * Width; ++i)
  {
    uniform += static_cast<char>(random() % 256);
  }
  EXPECT_EQ(WarningOf(uniform, "uint16le"), "");
  EXPECT_EQ(WarningOf(uniform, "uint16be"), "");
}

TEST(SensorNoiseByteOrders, RoughnessIsTheSumOfDifferencesTwoPixelsApart)
{
  const std::vector<unsigned char> bytes{ 1, 0, 0, 0, 4, 0, 0, 2 }; // 1, 0, 4, 512; the other way 256, 0, 1024, 2
  const ByteOrders                 orders = CompareByteOrders(bytes.data(), 4, false);
  EXPECT_DOUBLE_EQ(orders.little.roughness, 3.0 + 512.0);
  EXPECT_DOUBLE_EQ(orders.big.roughness, 768.0 + 2.0);
  EXPECT_EQ(orders.little.largest, 512U);
  EXPECT_EQ(orders.big.largest, 1024U);
  EXPECT_TRUE(orders.little.usesLowByte);
}
