// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameReader.h"
#include "helpers/CompressedBytesTestHelper.h"
#include "helpers/FrameFileTestHelper.h"

#include <algorithm>
#include <cstring>
#include <thread>
#include <utility>
#include <vector>

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

// 7 x 5 pixels of 2 bytes, 4 frames
constexpr std::size_t FrameBytes = 70;
constexpr std::size_t Frames = 4;

/** Pixels of MetaImage and NRRD files, wherever the header says that they are. */
class DataFile : public FrameFileTest
{
protected:
  std::string
  MetaImage(const std::string & dataFile, const std::string & more = "", const std::string & pixels = "") const
  {
    return Write("a.mha",
                 "NDims = 3\nDimSize = 7 5 4\nElementType = MET_USHORT\n" + more + "ElementDataFile = " + dataFile +
                   "\n" + pixels);
  }

  std::string
  Nrrd(const std::string & encoding, const std::string & more, const std::string & pixels = "") const
  {
    return Write("a.nrrd",
                 "NRRD0004\ntype: uint16\ndimension: 3\nsizes: 7 5 4\nencoding: " + encoding + "\n" + more + "\n" +
                   pixels);
  }

  /** Writes one file for each frame, and returns their names in lines. */
  template <typename TEncode>
  std::string
  WriteParts(const std::string & pixels, TEncode encode) const
  {
    std::string names;
    for (std::size_t t = 0; t < Frames; ++t)
    {
      const std::string name = "part" + std::to_string(t);
      Write(name, encode(pixels.substr(t * FrameBytes, FrameBytes)));
      names += name + "\n";
    }
    return names;
  }

  static std::string
  Read(const FrameFile & file, std::size_t first, std::size_t count)
  {
    std::string bytes(count * FrameBytes, '\0');
    file.reader->Read(file, first, count, bytes.data());
    return bytes;
  }

  /** Expects that any frames, read in any order and by several threads at once, are the frames of \a pixels. */
  static void
  GivesFrames(const std::string & name, const std::string & pixels)
  {
    const FrameFile file = InspectFrameFile(name);
    for (std::size_t first = 0; first < Frames; ++first)
    {
      for (std::size_t count = 1; first + count <= Frames; ++count)
      {
        EXPECT_EQ(Read(file, first, count), pixels.substr(first * FrameBytes, count * FrameBytes)) << first << count;
        EXPECT_EQ(Read(file, 0, 1), pixels.substr(0, FrameBytes)) << first << count;
      }
    }
    std::vector<std::string> found(Frames);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < Frames; ++t)
    {
      threads.emplace_back([&, t] { found[t] = Read(file, t, 1); });
    }
    for (std::size_t t = 0; t < Frames; ++t)
    {
      threads[t].join();
      EXPECT_EQ(found[t], pixels.substr(t * FrameBytes, FrameBytes)) << t;
    }
  }
};

std::string
Unchanged(std::string bytes)
{
  return bytes;
}

std::string
Swapped(std::string bytes)
{
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
  {
    std::swap(bytes[i], bytes[i + 1]);
  }
  return bytes;
}

TEST_F(DataFile, GivesTheFramesOfAMetaImage)
{
  const std::string pixels = RandomBytes(Frames * FrameBytes); // this machine's order is the lowest byte first
  GivesFrames(MetaImage("LOCAL", "", pixels), pixels);
  GivesFrames(MetaImage("LOCAL", "BinaryDataByteOrderMSB = True\n", Swapped(pixels)), pixels);
  GivesFrames(MetaImage("LOCAL", "ElementByteOrderMSB = True\n", Swapped(pixels)), pixels);
  GivesFrames(MetaImage("LOCAL", "HeaderSize = -1\n", "12345" + pixels), pixels);
  Write("b.raw", "12345" + pixels);
  GivesFrames(MetaImage("b.raw", "HeaderSize = 5\n"), pixels);
  GivesFrames(MetaImage("b.raw", "HeaderSize = -1\n"), pixels);
  GivesFrames(MetaImage("LIST", "", WriteParts(pixels, Unchanged)), pixels);
  for (const std::string & stream : { ZlibStream(pixels), GzipStream(pixels) })
  {
    const std::string size = "CompressedData = True\nCompressedDataSize = " + std::to_string(stream.size()) + "\n";
    GivesFrames(MetaImage("LOCAL", size, stream), pixels);
    Write("b.zraw", stream);
    GivesFrames(MetaImage("b.zraw", size), pixels);
  }
}

TEST_F(DataFile, GivesTheFramesOfANrrd)
{
  const std::string pixels = RandomBytes(Frames * FrameBytes);
  GivesFrames(Nrrd("raw", "endian: little\n", pixels), pixels);
  GivesFrames(Nrrd("raw", "endian: big\n", Swapped(pixels)), pixels);
  GivesFrames(Nrrd("raw", "endian: little\nbyte skip: -1\n", "12345" + pixels), pixels);
  GivesFrames(Nrrd("gzip", "endian: big\n", GzipStream(Swapped(pixels))), pixels);
  Write("b.gz", GzipStream(pixels));
  GivesFrames(Nrrd("gzip", "endian: little\ndata file: b.gz\n"), pixels);
  GivesFrames(Nrrd("raw", "endian: little\ndata file: LIST\n" + WriteParts(pixels, Unchanged)), pixels);
  GivesFrames(Nrrd("gzip", "endian: little\ndata file: LIST\n" + WriteParts(pixels, GzipStream)), pixels);
}

TEST_F(DataFile, GivesIntegersOf32BitsAsDouble)
{
  const std::string numbers("\xFF\xFF\xFF\xFF\0\0\0\x80\1\0\0\0", 12);
  const std::string header = "NRRD0004\ntype: TYPE\ndimension: 2\nsizes: 3 1\nencoding: gzip\nendian: little\n\n";
  const auto        valuesOf = [&](const std::string & type) {
    const FrameFile     file = InspectFrameFile(Write("i.nrrd", Replaced(header, "TYPE", type) + GzipStream(numbers)));
    std::vector<double> values(3);
    file.reader->Read(file, 0, 1, values.data());
    return values;
  };
  EXPECT_EQ(valuesOf("int32"), (std::vector<double>{ -1.0, -2147483648.0, 1.0 }));
  EXPECT_EQ(valuesOf("uint32"), (std::vector<double>{ 4294967295.0, 2147483648.0, 1.0 }));
}

// The inspected bytes are the bytes that are read: a stream that another program changes is checked again while it is
// read.
TEST_F(DataFile, AStreamThatIsDamagedAfterItsInspectionIsRefused)
{
  const std::string pixels = RandomBytes(Frames * FrameBytes);
  std::string       stream = GzipStream(pixels);
  const FrameFile   file = InspectFrameFile(Nrrd("gzip", "endian: little\n", stream));
  const auto        said = [&] {
    try
    {
      Read(file, 0, Frames);
      return std::string();
    }
    catch (const FileError & error)
    {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(said(), "");
  stream[stream.size() - 8] = static_cast<char>(stream[stream.size() - 8] ^ 1); // a bit of the checksum
  Nrrd("gzip", "endian: little\n", stream);
  EXPECT_NE(said().find("280 bytes and then an error (incorrect data check)"), std::string::npos) << said();
  Nrrd("gzip", "endian: little\n", stream.substr(0, stream.size() / 2));
  EXPECT_NE(said().find("no end of the stream"), std::string::npos) << said();
  Nrrd("gzip", "endian: little\n", GzipStream(pixels));
  EXPECT_EQ(said(), "");
}

} // namespace
