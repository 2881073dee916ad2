// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/BurstFilesTestHelper.h"
#include "files/FrameReader.h"
#include "helpers/FrameFileTestHelper.h"

#include <string>
#include <vector>

// SER, the format of astronomers' recordings.

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

/** Returns grey values of a noisy ramp of 12 bits, with many values of the low byte. */
GreyValues
Ramp(std::size_t count, unsigned scale = 1)
{
  GreyValues greyValues;
  for (std::size_t i = 0; i < count; ++i)
  {
    greyValues.push_back(static_cast<unsigned>(1000 + 3 * i + i * i % 37) * scale);
  }
  return greyValues;
}

class SerFile : public FrameFileTest
{
protected:
  std::vector<unsigned short>
  Read(const FrameFile & file) const
  {
    std::vector<unsigned short> pixels(file.width * file.height * file.frames);
    file.reader->Read(file, 0, file.frames, pixels.data());
    return pixels;
  }

  static SerOf
  Sound(bool isBigEndian = false)
  {
    SerOf ser;
    ser.pixels = BytesOfGreyValues(Ramp(140), 2, isBigEndian);
    return ser;
  }
};

TEST_F(SerFile, IsReadInEitherOrderWhateverTheFlagSays)
{
  const GreyValues greyValues = Ramp(140);
  for (const bool isBig : { false, true })
  {
    for (const unsigned flag : { 0U, 1U })
    {
      SerOf ser = Sound(isBig);
      ser.isLittleEndian = flag;
      const FrameFile file = IsFrames("a.ser", ser.Bytes(), FramePixel::UnsignedShort, 7, 5, 4);
      EXPECT_EQ(Read(file), (std::vector<unsigned short>(greyValues.begin(), greyValues.end()))) << isBig << flag;
    }
  }
}

// Grey values of 8 bits in the high byte are valid in both byte orders. The reader then takes the order that programs
// write.
TEST_F(SerFile, AnUnclearByteOrderIsTakenFromTheFlag)
{
  GreyValues greyValues;
  for (unsigned i = 0; i < 140; ++i)
  {
    greyValues.push_back((i * 7 % 200) << 8);
  }
  SerOf ser = Sound();
  ser.depth = 16;
  ser.pixels = BytesOfGreyValues(greyValues, 2);
  FrameFile file = IsFrames("a.ser", ser.Bytes(), FramePixel::UnsignedShort, 7, 5, 4);
  EXPECT_EQ(Read(file), (std::vector<unsigned short>(greyValues.begin(), greyValues.end())));
  ser.isLittleEndian = 1;
  file = IsFrames("a.ser", ser.Bytes(), FramePixel::UnsignedShort, 7, 5, 4);
  EXPECT_EQ(Read(file)[1], 7);
}

TEST_F(SerFile, SaysWhatTheCameraIs)
{
  const char * const patterns[] = { "RGGB", "GRBG", "GBRG", "BGGR" };
  for (unsigned color = 8; color < 12; ++color)
  {
    SerOf ser = Sound();
    ser.color = color;
    const FrameFile file = IsFrames("a.ser", ser.Bytes(), FramePixel::UnsignedShort, 7, 5, 4);
    EXPECT_EQ(file.camera.bayerPattern, patterns[color - 8]);
    EXPECT_EQ(file.camera.bitDepth, 12u);
    EXPECT_EQ(file.camera.camera, "A camera");
  }
  SerOf ser = Sound();
  ser.depth = 16; // what programs write for any sensor
  EXPECT_EQ(IsFrames("a.ser", ser.Bytes(), FramePixel::UnsignedShort, 7, 5, 4).camera.bitDepth, 0u);
  ser.depth = 12; // but the digital numbers were shifted to the high bits
  ser.pixels = BytesOfGreyValues(Ramp(140, 16), 2);
  EXPECT_EQ(IsFrames("a.ser", ser.Bytes(), FramePixel::UnsignedShort, 7, 5, 4).camera.bitDepth, 0u);
  ser.depth = 8;
  ser.pixels = RandomBytes(140);
  const FrameFile file = IsFrames("a.ser", ser.Bytes(), FramePixel::UnsignedChar, 7, 5, 4);
  EXPECT_EQ(file.camera.bitDepth, 8u);
  EXPECT_EQ(file.camera.bayerPattern, "");
}

TEST_F(SerFile, MayEndWithATimeForEachFrameAndWithNothingElse)
{
  SerOf ser = Sound();
  ser.trailer = std::string(32, '\1');
  IsFrames("a.ser", ser.Bytes(), FramePixel::UnsignedShort, 7, 5, 4);
  for (const std::size_t bytes : { 1U, 24U, 31U, 33U, 70U })
  {
    ser.trailer = std::string(bytes, '\1');
    IsRefused("a.ser", ser.Bytes(), { std::to_string(280 + bytes) + " bytes of pixels; expected 280", "8 bytes more" });
  }
  const std::string whole = Sound().Bytes();
  IsRefused("a.ser", whole.substr(0, whole.size() - 1), { "truncated: 279 bytes of pixels; expected 280" });
  IsRefused("a.ser", whole.substr(0, 177), { "truncated: " });
}

// The number of frames is what programs write last.
TEST_F(SerFile, ThatWasNotClosedIsReadWithAWarning)
{
  SerOf           ser = Sound();
  const FrameFile closed = IsFrames("a.ser", ser.Bytes(), FramePixel::UnsignedShort, 7, 5, 4);
  EXPECT_EQ(closed.warning, "");
  ser.frames = 0;
  ser.trailer = "the beginning of a frame";
  const FrameFile open = IsFrames("b.ser", ser.Bytes(), FramePixel::UnsignedShort, 7, 5, 4);
  EXPECT_EQ(open.warning,
            "says 0 frames, but holds 4 and 24 bytes more: the recording was not closed. All whole frames are read");
  std::vector<unsigned short> expected(140);
  std::vector<unsigned short> found(140);
  closed.reader->Read(closed, 0, 4, expected.data());
  open.reader->Read(open, 0, 4, found.data());
  EXPECT_EQ(found, expected);
}

TEST_F(SerFile, HeadersThatCannotBeTrueAreRefused)
{
  const auto refused = [this](const auto & change, const std::vector<std::string> & parts) {
    SerOf ser = Sound();
    change(ser);
    IsRefused("a.ser", ser.Bytes(), parts);
  };
  refused([](SerOf & ser) { ser.color = 100; }, { "colours of three values a pixel (ColorID 100)" });
  refused([](SerOf & ser) { ser.color = 101; }, { "colours of three values a pixel" });
  refused([](SerOf & ser) { ser.color = 7; }, { "ColorID is 7; expected 0, 8 to 11 or 16 to 19" });
  refused([](SerOf & ser) { ser.depth = 0; }, { "PixelDepthPerPlane is 0 bits; expected 1 to 16" });
  refused([](SerOf & ser) { ser.depth = 32; }, { "PixelDepthPerPlane is 32 bits" });
  refused([](SerOf & ser) { ser.isLittleEndian = 2; }, { "LittleEndian is 2; expected 0 or 1" });
  refused([](SerOf & ser) { ser.width = 0; }, { "size 0 along axis 0" });
  refused([](SerOf & ser) { ser.pixels.resize(69), ser.frames = 0; }, { "size 0 along axis 2" });
  refused([](SerOf & ser) { ser.height = 0xFFFFFFFF; }, { "size 4294967295 along axis 1" });
  refused([](SerOf & ser) { ser.frames = 5; }, { "truncated: 280 bytes of pixels; expected 350" });
  refused([](SerOf & ser) { ser.frames = 3; }, { "280 bytes of pixels; expected 210" });
  refused([](SerOf & ser) { ser.width = ser.height = ser.frames = 0x7FFFFFFF; }, { "more than can be counted" });
}
} // namespace
