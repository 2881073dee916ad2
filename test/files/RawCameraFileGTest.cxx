// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"
#include "files/FrameReader.h"

#include "helpers/DngTestHelper.h"
#include "helpers/FrameFileTestHelper.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

// Raw files of cameras.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

class RawCameraFile : public FrameFileTest
{
protected:
  void
  SetUp() override
  {
    FrameFileTest::SetUp();
    if (!ReadsRawCameraFiles())
    {
      GTEST_SKIP() << "built without LibRaw";
    }
  }

  static GreyValues
  Read(const FrameFile & file)
  {
    std::vector<unsigned short> pixels(file.width * file.height);
    file.reader->Read(file, 0, 1, pixels.data());
    return { pixels.begin(), pixels.end() };
  }

  FrameFile
  IsSound(const DngOf & dng) const
  {
    return IsFrames("a.dng", dng.Bytes(), FramePixel::UnsignedShort, dng.width, dng.height, 1);
  }

  void
  IsRefused(const DngOf & dng, const std::vector<std::string> & parts) const
  {
    FrameFileTest::IsRefused("a.dng", dng.Bytes(), parts);
  }
};

TEST_F(RawCameraFile, UncompressedAndPackedGreyValuesAreReadUnchanged)
{
  for (const unsigned bits : { 16U, 14U, 12U, 10U })
  {
    for (const bool isBigEndian : { false, true })
    {
      for (const bool isBelow : { false, true })
      {
        DngOf dng = DngOf::Sound(bits);
        dng.isBigEndian = isBigEndian;
        dng.isBelow = isBelow;
        const FrameFile file = IsSound(dng);
        EXPECT_EQ(Read(file), dng.greyValues) << bits << isBigEndian << isBelow;
        EXPECT_EQ(file.camera.blackLevelDn, 64.0) << bits << isBigEndian << isBelow;
      }
    }
  }
}

TEST_F(RawCameraFile, GreyValuesOfLosslessJpegAreReadUnchanged)
{
  for (const unsigned bits : { 16U, 14U, 12U })
  {
    for (const unsigned components : { 1U, 2U })
    {
      for (const unsigned tile : { 0U, 16U, 32U })
      {
        DngOf dng = DngOf::Sound(bits);
        dng.isJpeg = true;
        dng.components = components;
        dng.tile = tile;
        EXPECT_EQ(Read(IsSound(dng)), dng.greyValues) << bits << ' ' << components << ' ' << tile;
      }
    }
  }
}

TEST_F(RawCameraFile, SaysWhatTheCameraIs)
{
  const CameraSettings camera = IsSound(DngOf::Sound()).camera;
  EXPECT_EQ(camera.camera, "Maker Model 1");
  EXPECT_EQ(camera.bayerPattern, "RGGB");
  EXPECT_EQ(camera.bitDepth, 14u); // from the white level; all digital numbers fit
  EXPECT_EQ(camera.blackLevelDn, 64.0);
  EXPECT_EQ(camera.whiteLevelDn, 16383.0);
  EXPECT_EQ(camera.isoSpeed, 400.0);
  EXPECT_EQ(camera.exposureSeconds, 0.02); // LibRaw has 0.01999999955, in single precision
  EXPECT_TRUE(std::isnan(camera.opticalBlackDn));
  EXPECT_EQ(IsSound(DngOf::Sound(12)).camera.bitDepth, 12u);
  DngOf bright = DngOf::Sound();
  bright.greyValues[100] = 20000;
  EXPECT_EQ(IsSound(bright).camera.bitDepth, 0u);
}

TEST_F(RawCameraFile, PatternIsThatOfTheFirstVisiblePixel)
{
  const std::vector<std::pair<std::vector<std::uint64_t>, std::string>> patterns{
    { { 0, 1, 1, 2 }, "RGGB" }, { { 1, 0, 2, 1 }, "GRBG" }, { { 1, 2, 0, 1 }, "GBRG" }, { { 2, 1, 1, 0 }, "BGGR" }
  };
  for (const auto & [colours, name] : patterns)
  {
    DngOf dng = DngOf::Sound();
    dng.tags[33422] = { 1, colours };
    EXPECT_EQ(IsSound(dng).camera.bayerPattern, name);
  }
  // the pattern of a DNG begins at its active area: top, left, bottom, right
  DngOf inside = DngOf::Sound();
  inside.tags[50829] = { 4, { 2, 4, 32, 46 } };
  FrameFile file = IsFrames("a.dng", inside.Bytes(), FramePixel::UnsignedShort, 42, 30, 1);
  EXPECT_EQ(file.camera.bayerPattern, "RGGB");
  const GreyValues found = Read(file);
  EXPECT_EQ(found.front(), inside.greyValues[2 * 48 + 4]);
  EXPECT_EQ(found[42], inside.greyValues[3 * 48 + 4]);
  EXPECT_EQ(found.back(), inside.greyValues[31 * 48 + 45]);
  // LibRaw begins at even places: a row and a column later
  inside.tags[50829] = { 4, { 1, 3, 31, 47 } };
  file = IsFrames("a.dng", inside.Bytes(), FramePixel::UnsignedShort, 43, 29, 1);
  EXPECT_EQ(file.camera.bayerPattern, "BGGR");
  EXPECT_EQ(Read(file).front(), inside.greyValues[2 * 48 + 4]);
}

TEST_F(RawCameraFile, MonochromeSensorsHaveNoPattern)
{
  DngOf dng = DngOf::Sound(12);
  dng.tags = { { 262, { 3, { 34892 } } }, { 33421, {} }, { 33422, {} } };
  const FrameFile file = IsSound(dng);
  EXPECT_EQ(file.camera.bayerPattern, "");
  EXPECT_EQ(file.camera.blackLevelDn, 64.0);
  EXPECT_EQ(Read(file), dng.greyValues);
}

TEST_F(RawCameraFile, BlackLevelsThatDifferAreNone)
{
  DngOf dng = DngOf::Sound();
  dng.tags[50713] = { 3, { 2, 2 } };
  dng.tags[50714] = { 4, { 64, 64, 64, 64 } };
  EXPECT_EQ(IsSound(dng).camera.blackLevelDn, 64.0);
  dng.tags[50714] = { 4, { 64, 65, 64, 64 } };
  EXPECT_TRUE(std::isnan(IsSound(dng).camera.blackLevelDn));
}

TEST_F(RawCameraFile, MaskedColumnsGiveTheOpticalBlack)
{
  DngOf dng = DngOf::Sound();
  for (unsigned y = 0; y < dng.height; ++y)
  {
    for (unsigned x = 0; x < 8; ++x)
    {
      dng.greyValues[y * dng.width + x] = 100 + (x % 2) + 4 * (y % 2); // row means 100.5 and 104.5
    }
  }
  dng.tags[50829] = { 4, { 0, 8, 32, 48 } };
  dng.tags[50830] = { 4, { 0, 0, 32, 8 } };
  const CameraSettings camera = IsFrames("a.dng", dng.Bytes(), FramePixel::UnsignedShort, 40, 32, 1).camera;
  EXPECT_DOUBLE_EQ(camera.opticalBlackDn, 102.5);
  EXPECT_NEAR(camera.opticalBlackErrorDn, 2.0 / std::sqrt(31.0), 1e-12);
}

TEST_F(RawCameraFile, TruncatedAndOtherSizesAreRefused)
{
  for (const unsigned bits : { 16U, 12U })
  {
    DngOf dng = DngOf::Sound(bits);
    dng.tags[257] = { 4, { dng.height + 1 } };
    dng.tags[278] = { 4, { dng.height + 1 } };
    IsRefused(dng, { "damaged: its strip or tile 0 has", "bytes; expected" });
    dng.tags[257] = { 4, { dng.height - 1 } };
    IsRefused(dng, { "damaged: its strip or tile 0 has" });
    dng = DngOf::Sound(bits);
    dng.tags[256] = { 4, { dng.width + 2 } };
    IsRefused(dng, { "damaged: its strip or tile 0 has" });
    dng = DngOf::Sound(bits);
    dng.tags[273] = { 4, { 4000 } };
    IsRefused(dng, { "truncated: has" });
  }
  DngOf moved = DngOf::Sound(16);
  moved.tags[273] = { 4, { 60 } }; // into the directory
  IsRefused(moved, { "holds pixels twice, or pixels and something else" });
  DngOf dng = DngOf::Sound(12);
  dng.isJpeg = true;
  dng.tags[257] = { 4, { dng.height + 1 } };
  dng.tags[278] = { 4, { dng.height + 1 } };
  IsRefused(dng, { "strip or tile 0: damaged: its JPEG has 1536 digital numbers; expected 1584" });
  dng = DngOf::Sound(12);
  dng.isJpeg = true;
  const std::string whole = dng.Bytes();
  std::string       cut = whole;
  cut.replace(900, 2, "\xFF\xD9"); // an end before the end
  FrameFileTest::IsRefused("a.dng", cut, { "damaged" });
}

TEST_F(RawCameraFile, LossIsRefused)
{
  DngOf dng = DngOf::Sound();
  dng.tags[259] = { 3, { 34892 } };
  IsRefused(dng, { "loss" });
  dng = DngOf::Sound(12);
  dng.isJpeg = true;
  dng.jpegFrame = 0xC1;
  IsRefused(dng, { "compressed with loss, as JPEG" });
  dng = DngOf::Sound();
  dng.tags[50712] = { 3, { 0, 1, 4, 9 } };
  IsRefused(dng, { "rounded through a table (LinearizationTable)" });
}

TEST_F(RawCameraFile, SeveralColoursAPixelAreRefused)
{
  DngOf dng = DngOf::Sound();
  dng.greyValues.insert(dng.greyValues.end(), dng.greyValues.begin(), dng.greyValues.end());
  dng.greyValues.insert(dng.greyValues.end(), dng.greyValues.begin(), dng.greyValues.begin() + 48 * 32);
  dng.tags[262] = { 3, { 34892 } };
  dng.tags[277] = { 3, { 3 } };
  dng.tags[258] = { 3, { 16, 16, 16 } };
  IsRefused(dng, { "colours a pixel" });
}

// By the contents, whatever the name; a TIFF stays one.
TEST(RawCameraFiles, AreDistinguishedFromTiff)
{
  class Files : public FrameFileTest
  {
  public:
    using FrameFileTest::Write;
    void
    TestBody() override
    {}
    Files() { SetUp(); }
    ~Files() override { TearDown(); }
  };
  Files      files;
  const auto format = [&](const std::string & name, const std::string & bytes) {
    const FrameFormat * const found = FindFrameFormat(bytes.substr(0, 512), files.Write(name, bytes));
    return std::string(found == nullptr ? "" : found->name);
  };
  EXPECT_EQ(format("a.tif", DngOf::Sound().Bytes()), "camera raw");
  DngOf nef = DngOf::Sound();
  nef.isBelow = true;
  EXPECT_EQ(format("b.tif", nef.Bytes()), "camera raw");
  EXPECT_EQ(format("c.tif", TiffOf{}.Bytes()), "TIFF");
  TiffOf many;
  many.width = 100;
  EXPECT_EQ(format("d.tif", many.Bytes()), "TIFF");
  EXPECT_EQ(format("e.x", std::string("II*\0\x10\0\0\0CR\2\0", 12) + std::string(600, ' ')), "camera raw");
  EXPECT_EQ(format("f.x", "FUJIFILMCCD-RAW 0201"), "camera raw");
  EXPECT_EQ(format("g.x", std::string("\0\0\0\x18", 4) + "ftypcrx "), "camera raw");
  EXPECT_EQ(format("h.nef", std::string("MM\0*\0\0\0\x8", 8)), "camera raw");
}

TEST(RawCameraFiles, WithoutLibRawGetOneSentence)
{
  if (ReadsRawCameraFiles())
  {
    GTEST_SKIP() << "built with LibRaw";
  }
  class Files : public FrameFileTest
  {
  public:
    using FrameFileTest::IsRefused;
    void
    TestBody() override
    {}
    Files() { SetUp(); }
    ~Files() override { TearDown(); }
  };
  Files().IsRefused("a.dng", DngOf::Sound().Bytes(), { "a raw file of a camera (DNG)", "has no LibRaw; expected" });
}
} // namespace
