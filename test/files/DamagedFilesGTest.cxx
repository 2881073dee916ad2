// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/FrameFileTestHelper.h"
#include "helpers/PngTestHelper.h"
#include "helpers/TiffTestHelper.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

/** Files of every kind, damaged at random: each is refused with a sentence, or holds as many bytes of pixels as before.
 */
class DamagedFiles : public FrameFileTest
{
protected:
  struct Sample
  {
    std::string name;
    std::string bytes;
  };

  static std::vector<Sample>
  Samples()
  {
    const std::string pixels = RandomBytes(936);
    const std::string zlib = ZlibStream(pixels);
    const std::string meta =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nOffset = 0 "
      "0 0\nElementSpacing = 1 1 1\nDimSize = 13 9 4\nElementType = MET_USHORT\n";
    const std::string nrrd = "NRRD0004\n# a comment\ntype: unsigned short\ndimension: 3\nsizes: 13 9 4\nkinds: domain "
                             "domain domain\nendian: little\nkey:=value\nencoding: ";
    std::vector<Sample> samples{ { "a.mha", meta + "ElementDataFile = LOCAL\n" + pixels },
                                 { "z.mha",
                                   meta + "CompressedData = True\nCompressedDataSize = " + std::to_string(zlib.size()) +
                                     "\nElementDataFile = LOCAL\n" + zlib },
                                 { "d.mhd", meta + "ElementDataFile = d.raw\n" },
                                 { "a.nrrd", nrrd + "raw\n\n" + pixels },
                                 { "z.nrrd", nrrd + "gzip\n\n" + GzipStream(pixels) },
                                 { "d.nhdr", nrrd + "raw\ndata file: d.raw\n" } };
    PngOf               png;
    png.piece = 100;
    png.before = PngChunkOf("sBIT", "\x0C") + PngChunkOf("tEXt", "a");
    png.shift = 4;
    samples.push_back({ "a.png", png.Bytes() });
    png.interlacing = 1;
    samples.push_back({ "i.png", png.Bytes() });
    for (const unsigned compression : { 1u, 5u, 8u, 32773u })
    {
      TiffOf tiff = TiffWith({ { 305, Text("a program") } });
      tiff.compression = compression;
      tiff.pages.resize(4, tiff.pages.front());
      samples.push_back({ "c" + std::to_string(compression) + ".tif", tiff.Bytes() });
      tiff.isBig = true;
      tiff.isBigEndian = true;
      samples.push_back({ "b" + std::to_string(compression) + ".tif", tiff.Bytes() });
    }
    for (const unsigned compression : { 1u, 5u, 8u, 32773u })
    {
      TiffOf tiff;
      tiff.compression = compression;
      tiff.tileWidth = 16;
      tiff.tileLength = 16;
      tiff.pages.resize(4);
      samples.push_back({ "t" + std::to_string(compression) + ".tif", tiff.Bytes() });
    }
    return samples;
  }

  static void
  Damage(std::string & bytes, std::mt19937_64 & random)
  {
    const auto        place = [&] { return static_cast<std::size_t>(random() % bytes.size()); };
    const std::size_t at = place();
    const std::size_t length = std::min<std::size_t>(1 + random() % 16, bytes.size() - at);
    switch (random() % 7)
    {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(place(), length));
        break;
      case 3:
        std::fill_n(
          bytes.begin() + static_cast<std::ptrdiff_t>(at), length, static_cast<char>(random() % 2 == 0 ? 0 : 255));
        break;
      case 4: // in the header of a text
        bytes[at % std::min<std::size_t>(bytes.size(), 300)] = static_cast<char>('0' + random() % 10);
        break;
      case 5:
        bytes[at] = static_cast<char>(random());
        break;
      default:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
    }
  }
};

TEST_F(DamagedFiles, AreRefusedOrHoldAsManyPixels)
{
  Write("d.raw", RandomBytes(936));
  std::mt19937_64 random(1);
  for (const Sample & sample : Samples())
  {
    ASSERT_EQ(SaidOf(sample.name, sample.bytes), "");
    const std::uint64_t expected = InspectFrameFile(Path(sample.name)).bytes;
    std::size_t         refused = 0;
    for (int i = 0; i < 1000; ++i)
    {
      std::string bytes = sample.bytes;
      for (std::uint64_t damages = 1 + random() % 3; damages > 0 && !bytes.empty(); --damages)
      {
        Damage(bytes, random);
      }
      const auto start = std::chrono::steady_clock::now();
      if (SaidOf(sample.name, bytes).empty())
      {
        EXPECT_EQ(InspectFrameFile(Path(sample.name)).bytes, expected) << sample.name << ", " << i;
      }
      else
      {
        ++refused;
      }
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      EXPECT_LT(seconds.count(), 5.) << sample.name << ", " << i;
    }
    EXPECT_GT(refused, 100u) << sample.name;
  }
}

} // namespace
