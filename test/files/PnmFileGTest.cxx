// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/BurstFilesTestHelper.h"
#include "files/FrameReader.h"
#include "helpers/FrameFileTestHelper.h"

#include <string>
#include <vector>

// Netpbm's PGM, of one image or of several.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

class PnmFile : public FrameFileTest
{};

TEST_F(PnmFile, FramesOfEightAndSixteenBitsAreRead)
{
  const std::string eight = "P5\n# a camera\n3 2\n255\nabcdef";
  FrameFile         file = IsFrames("a.pgm", eight, FramePixel::UnsignedChar, 3, 2, 1);
  EXPECT_STREQ(file.format->name, "PGM");
  EXPECT_EQ(file.camera.bitDepth, 8u);
  const std::string header = "P5 2 1 4095\n";
  const std::string stack =
    header + BytesOfGreyValues({ 1, 2 }, 2, true) + header + BytesOfGreyValues({ 3, 4000 }, 2, true);
  file = IsFrames("a.pgm", stack, FramePixel::UnsignedShort, 2, 1, 2);
  EXPECT_EQ(file.camera.bitDepth, 12u);
  std::vector<unsigned short> pixels(4);
  file.reader->Read(file, 0, 2, pixels.data());
  EXPECT_EQ(pixels, (std::vector<unsigned short>{ 1, 2, 3, 4000 }));
  file = IsFrames("a.pgm", "P5\t2\r1\n1000\nabcd", FramePixel::UnsignedShort, 2, 1, 1);
  EXPECT_EQ(file.camera.bitDepth, 0u);
}

TEST_F(PnmFile, OtherFilesOfTheFamilyAreRefused)
{
  IsRefused("a.ppm", "P6\n1 1\n255\nabc", { "3 components a pixel; expected 1 grey value" });
  IsRefused("a.pgm", "P2\n1 1\n255\n7\n", { "a PGM file of text (P2); expected binary grey values (P5)" });
  IsRefused("a.pbm", "P4\n8 1\na", { "(P4) without grey values; expected PGM (P5)" });
}

TEST_F(PnmFile, DamagedFilesAreRefused)
{
  IsRefused("a.pgm", "P5\n3 2\n255\nabcde", { "truncated: 5 bytes of pixels; expected 6" });
  IsRefused("a.pgm", "P5\n3 2\n255\nabcdefg", { "at byte 17 is no header of an image; expected P5" });
  IsRefused("a.pgm", "P5\n3 2\n0\nabcdef", { "its largest value is 0; expected 1 to 65535" });
  IsRefused("a.pgm", "P5\n3 2\n65536\nabcdef", { "its largest value is 65536" });
  IsRefused("a.pgm", "P5\n3 x\n255\nabcdef", { "the height in the header at byte 0 is no number" });
  IsRefused("a.pgm", "P5\n3", { "the width in the header at byte 0 is no number" });
  IsRefused("a.pgm", "P5\n0 2\n255\nabcdef", { "size 0 along axis 0" });
  IsRefused("a.pgm", "P5\n99999999999999999999999 2\n255\nabcdef", { "the width in the header" });
  IsRefused("a.pgm", "P5\n#" + std::string(70000, 'c') + "\n3 2\n255\nabcdef", { "a header of more than 65536 bytes" });
  const std::string first = "P5\n1 1\n255\na";
  IsRefused("a.pgm", first + "P5\n1 1\n254\na", { "the header of image 1 differs from the header of the first" });
  IsRefused("a.pgm", first + "P5\n1  1\n255\na", { "the header of image 1 differs from the header of the first" });
  IsRefused("a.pgm", first + "P5\n1 1\n255\n", { "truncated" });
  const std::string good = "P5\n# a camera\n3 2\n255\nabcdef";
  for (std::size_t size = 1; size < good.size(); ++size)
  {
    ASSERT_NE(SaidOf("a.pgm", good.substr(0, size)), "") << size << " bytes";
  }
}

} // namespace
