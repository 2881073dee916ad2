// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/BurstFilesTestHelper.h"
#include "files/FrameReader.h"
#include "helpers/FrameFileTestHelper.h"

#include <string>
#include <vector>

// Arrays of numpy.save().

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

std::string
NpyOf(const std::string & dictionary, const std::string & data, unsigned version = 1)
{
  std::string text = "\x93NUMPY";
  text += static_cast<char>(version);
  text += '\0';
  AppendNumber(text, dictionary.size(), version == 1 ? 2 : 4, false);
  return text + dictionary + data;
}

std::string
Dictionary(const std::string & type, const std::string & shape, const std::string & isFortran = "False")
{
  return "{'descr': '" + type + "', 'fortran_order': " + isFortran + ", 'shape': " + shape + ", }     \n";
}

class NpyFile : public FrameFileTest
{
protected:
  template <typename TPixel>
  std::vector<TPixel>
  Read(const std::string & type, const std::string & data, FramePixel pixel) const
  {
    const FrameFile     file = IsFrames("a.npy", NpyOf(Dictionary(type, "(2, 1, 3)"), data), pixel, 3, 1, 2);
    std::vector<TPixel> pixels(6);
    EXPECT_STREQ(file.format->name, "NPY");
    file.reader->Read(file, 0, 2, pixels.data());
    return pixels;
  }
};

TEST_F(NpyFile, EachTypeIsReadExactly)
{
  const GreyValues greyValues{ 1, 2, 3, 4, 5, 65535 };
  for (const bool isBigEndian : { false, true })
  {
    const std::string order = isBigEndian ? ">" : "<";
    const std::string shorts = BytesOfGreyValues(greyValues, 2, isBigEndian);
    const std::string longs = BytesOfGreyValues({ 1, 2, 3, 4, 5, 0xFFFFFFFF }, 4, isBigEndian);
    EXPECT_EQ(Read<unsigned short>(order + "u2", shorts, FramePixel::UnsignedShort)[5], 65535);
    EXPECT_EQ(Read<short>(order + "i2", shorts, FramePixel::Short)[5], -1);
    EXPECT_EQ(Read<double>(order + "u4", longs, FramePixel::Double)[5], 4294967295.0);
    EXPECT_EQ(Read<double>(order + "i4", longs, FramePixel::Double)[5], -1.0);
    EXPECT_EQ(
      Read<float>(order + "f4", BytesOfGreyValues(GreyValues(6, 0x3F800000), 4, isBigEndian), FramePixel::Float)[2],
      1.0F);
    Read<double>(order + "f8", std::string(48, '\0'), FramePixel::Double);
  }
  EXPECT_EQ(Read<unsigned char>("|u1", "abcdef", FramePixel::UnsignedChar)[5], 'f');
}

TEST_F(NpyFile, TwoAxesAreAFrameAndEachVersionIsRead)
{
  for (const unsigned version : { 1u, 2u, 3u })
  {
    const std::string bytes = NpyOf(Dictionary("|u1", "(2,3)"), "abcdef", version);
    IsFrames("a.npy", bytes, FramePixel::UnsignedChar, 3, 2, 1);
  }
  IsRefused("a.npy", NpyOf(Dictionary("|u1", "(2,3)"), "abcdef", 4), { "NPY version 4; expected 1 to 3" });
}

TEST_F(NpyFile, OtherArraysAreRefused)
{
  const auto isRefused = [this](const std::string & dictionary, const std::string & words) {
    IsRefused("a.npy", NpyOf(dictionary, "abcdef"), { words });
  };
  isRefused(Dictionary("|u1", "(2,3)", "True"), "in Fortran's order; expected C order");
  isRefused(Dictionary("<u8", "(2,3)"), "its elements are <u8, which are not supported; expected u1, u2, i2, u4");
  isRefused(Dictionary("|b1", "(2,3)"), "its elements are |b1");
  isRefused(Dictionary("|u2", "(1,3)"), "its elements are |u2");
  isRefused("{'descr': [('a', '<u2')], 'fortran_order': False, 'shape': (3,), }", "its elements are records");
  isRefused(Dictionary("|u1", "(6,)"), "its array has 1 axes; expected (rows, columns)");
  isRefused(Dictionary("|u1", "(1, 1, 2, 3)"), "its array has 4 axes");
  isRefused(Dictionary("|u1", "()"), "damaged: its shape is");
  isRefused(Dictionary("|u1", "(2, -3)"), "damaged: its shape is (2, -3)");
  isRefused(Dictionary("|u1", "(2, , 3)"), "damaged: its shape is (2, , 3)");
  isRefused(Dictionary("|u1", "(0, 3)"), "size 0 along axis 1");
  isRefused(Dictionary("|u1", "(2, 2)"), "6 bytes of pixels; expected 4");
  isRefused(Dictionary("|u1", "(2, 4)"), "truncated: 6 bytes of pixels; expected 8");
  isRefused("{'descr': '|u1', 'shape': (2, 3), }", "has not one 'fortran_order':");
  isRefused(Dictionary("|u1", "(2,3)") + Dictionary("|u1", "(2,3)"), "has not one 'fortran_order':");
}

TEST_F(NpyFile, TruncatedFilesAreRefused)
{
  const std::string good = NpyOf(Dictionary("|u1", "(2,3)"), "abcdef");
  IsFrames("a.npy", good, FramePixel::UnsignedChar, 3, 2, 1);
  for (std::size_t size = 1; size < good.size(); ++size)
  {
    ASSERT_NE(SaidOf("a.npy", good.substr(0, size)), "") << size << " bytes";
  }
}

} // namespace
