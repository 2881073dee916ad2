// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "helpers/CompressedBytesTestHelper.h"
#include "helpers/FrameFileTestHelper.h"

#include <array>
#include <string>
#include <vector>

namespace
{
using namespace sensornoise;
using namespace sensornoise::test;

// 7 x 5 pixels of 2 bytes, 4 frames
constexpr std::size_t FrameBytes = 70;
constexpr std::size_t StackBytes = 280;

/** Returns a header as ITK writes it, with more lines before the last line. */
std::string
MetaImageHeaderOf(const std::string & dataFile, const std::string & more = "")
{
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nTransformMatrix = 1 0 0 0 "
         "1 "
         "0 0 0 1\nOffset = 0 0 0\nCenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\nElementSpacing = 1 1 "
         "1.5e-3\nDimSize = 7 5 4\nElementType = MET_USHORT\n" +
         more + "ElementDataFile = " + dataFile + "\n";
}

std::string
CompressedHeaderOf(const std::string & dataFile, std::size_t bytes)
{
  return MetaImageHeaderOf(dataFile, "CompressedData = True\nCompressedDataSize = " + std::to_string(bytes) + "\n");
}

class MetaImageFile : public FrameFileTest
{
protected:
  void
  HeaderIsRefused(const std::string & header, const std::vector<std::string> & parts) const
  {
    IsRefused("a.mha", header + RandomBytes(StackBytes), parts);
  }

  void
  LineIsRefused(const std::string & line, const std::string & words) const
  {
    HeaderIsRefused(MetaImageHeaderOf("LOCAL", line + "\n"), { words });
  }

  FrameFile
  IsStack(const std::string & name, const std::string & bytes) const
  {
    return IsFrames(name, bytes, FramePixel::UnsignedShort, 7, 5, 4);
  }
};

TEST_F(MetaImageFile, OfEveryKindThatIsCompleteIsAccepted)
{
  const std::string pixels = RandomBytes(StackBytes);
  EXPECT_STREQ(IsStack("a.mha", MetaImageHeaderOf("LOCAL") + pixels).format->name, "MetaImage");
  EXPECT_STREQ(IsStack("A.MHA", MetaImageHeaderOf("LOCAL") + pixels).format->name, "MetaImage");
  IsStack("a.mha", MetaImageHeaderOf("Local", "HeaderSize = -1\n") + pixels);
  IsStack("a.mha",
          MetaImageHeaderOf("local", "HeaderSize = 400\nName = a\n\nComment = b : c\nKey: x\n") +
            std::string(
              400 - MetaImageHeaderOf("local", "HeaderSize = 400\nName = a\n\nComment = b : c\nKey: x\n").size(), ' ') +
            pixels);
  Write("a.raw", pixels);
  EXPECT_EQ(IsStack("a.mhd", MetaImageHeaderOf("a.raw")).identities.size(), 2u);
  IsStack("a.mhd", MetaImageHeaderOf(Path("a.raw")));
  Write("b.raw", "12345" + pixels);
  IsStack("a.mhd", MetaImageHeaderOf("b.raw", "HeaderSize = 5\n"));
  IsStack("a.mhd", MetaImageHeaderOf("b.raw", "HeaderSize = -1\n"));
  std::string list;
  for (std::size_t t = 0; t < 4; ++t)
  {
    const std::string name = "part" + std::to_string(t);
    Write(name, pixels.substr(t * FrameBytes, FrameBytes));
    list += name + "\n";
  }
  EXPECT_EQ(IsStack("a.mhd", MetaImageHeaderOf("LIST") + list).identities.size(), 5u);
  IsStack("a.mhd", MetaImageHeaderOf("LIST 2") + list);
  for (const std::string & stream : { ZlibStream(pixels), GzipStream(pixels) })
  {
    IsStack("a.mha", CompressedHeaderOf("LOCAL", stream.size()) + stream);
    Write("a.zraw", stream);
    IsStack("a.mhd", CompressedHeaderOf("a.zraw", stream.size()));
  }
  const std::string frame = "NDims = 2\nDimSize = 7 5\nElementType = MET_DOUBLE\nElementDataFile = LOCAL\r\n";
  IsFrames("f.mha", frame + RandomBytes(280), FramePixel::Double, 7, 5, 1);
  IsFrames("f.mha", Replaced(frame, "DOUBLE", "FLOAT") + RandomBytes(140), FramePixel::Float, 7, 5, 1);
  IsFrames("f.mha", Replaced(frame, "DOUBLE", "SHORT") + RandomBytes(70), FramePixel::Short, 7, 5, 1);
  IsFrames("f.mha", Replaced(frame, "DOUBLE", "UCHAR") + RandomBytes(35), FramePixel::UnsignedChar, 7, 5, 1);
}

TEST_F(MetaImageFile, GivesTheGeometryOfTheFieldThatCountsMost)
{
  const std::string head = "NDims = 2\nDimSize = 1 1\nElementType = MET_UCHAR\n";
  const auto        geometryOf = [&](const std::string & lines) {
    return IsFrames("g.mha", head + lines + "ElementDataFile = LOCAL\na", FramePixel::UnsignedChar, 1, 1, 1).geometry;
  };
  const StackGeometry old = geometryOf("Position = 1 2\nElementSize = 3 4\nRotation = 0 1 1 0\n");
  EXPECT_EQ(old.origin, (std::array<double, 3>{ 1.0, 2.0, 0.0 }));
  EXPECT_EQ(old.spacing, (std::array<double, 3>{ 3.0, 4.0, 1.0 }));
  EXPECT_EQ(old.direction[1], (std::array<double, 3>{ 1.0, 0.0, 0.0 }));
  const StackGeometry both = geometryOf("Origin = 7 8\nOffset = 1 2\nElementSpacing = -5 6\nElementSize = 3 4\n");
  EXPECT_EQ(both.origin, (std::array<double, 3>{ 7.0, 8.0, 0.0 }));
  EXPECT_EQ(both.spacing, (std::array<double, 3>{ 5.0, 6.0, 1.0 }));
  EXPECT_EQ(both.direction[0], (std::array<double, 3>{ -1.0, 0.0, 0.0 })); // a spacing below 0 turns its axis
  const StackGeometry none = geometryOf("ElementSpacing = 0 2\nTransformMatrix = 1 0 1 0\n");
  EXPECT_EQ(none.spacing, (std::array<double, 3>{ 1.0, 2.0, 1.0 }));
  EXPECT_EQ(none.direction, StackGeometry().direction); // a singular matrix
}

TEST_F(MetaImageFile, WhatIsNoImageOfOneValueIsRefused)
{
  const std::string good = MetaImageHeaderOf("LOCAL");
  for (const std::string dimensions : { "1", "4", "99", "-3", "3.0", "x" })
  {
    HeaderIsRefused(Replaced(good, "NDims = 3", "NDims = " + dimensions),
                    { "NDims is " + dimensions + "; expected 2 (a frame) or 3 (a stack)" });
  }
  HeaderIsRefused(Replaced(good, "Type = Image", "Type = Tube"), { "ObjectType is Tube; expected Image" });
  LineIsRefused("ElementNumberOfChannels = 3", "3 components a pixel; expected 1");
  LineIsRefused("ElementNumberOfChannels = x", "ElementNumberOfChannels is x");
  HeaderIsRefused(Replaced(good, "MET_USHORT", "MET_LONG"), { "component type long is not supported" });
  HeaderIsRefused(Replaced(good, "MET_USHORT", "MET_USHORT_ARRAY"), { "component type MET_USHORT_ARRAY" });
  HeaderIsRefused(Replaced(good, "BinaryData = True", "BinaryData = False"), { "BinaryData is False" });
  LineIsRefused("ElementByteOrderMSB = True", "BinaryDataByteOrderMSB is False and ElementByteOrderMSB True");
  LineIsRefused("CompressedData = Trve", "CompressedData is Trve; expected True or False");
}

TEST_F(MetaImageFile, SizesThatCannotBeAreRefused)
{
  const auto isRefused = [this](const std::string & sizes, const std::string & words) {
    HeaderIsRefused(Replaced(MetaImageHeaderOf("LOCAL"), "7 5 4", sizes), { words });
  };
  isRefused("7 5 0", "size 0 along axis 2");
  isRefused("7 5 4294967296", "size 4294967296 along axis 2");
  isRefused("7 5 -4", "DimSize is 7 5 -4; expected whole numbers");
  isRefused("7 5", "DimSize is \"7 5\"; expected finite numbers: 3");
  isRefused("2147483647 2147483647 4", "more than can be counted in bytes");
  isRefused("7 5 5", "truncated: 280 bytes of pixels, expected 350");
  isRefused("7 5 3", "70 bytes are left over after its pixels; expected none");
}

TEST_F(MetaImageFile, LinesThatAreNoFieldsAreRefused)
{
  LineIsRefused("Comment = " + std::string(5000, 'c'), "line 12 of its header has more than 4096 characters");
  LineIsRefused("Comment =", "gives no value for Comment; expected one");
  LineIsRefused("a line without a separator", "line 12 of its header is not the name of a field");
  LineIsRefused("= a", "is not the name of a field");
  LineIsRefused("Offset = 0 0 0", "gives Offset a second time");
  LineIsRefused("Position = 0 0", "Position is \"0 0\"; expected finite numbers: 3");
  LineIsRefused("Color = 1 1 1 1e999", "Color is \"1 1 1 1e999\"; expected finite numbers: 4");
  LineIsRefused("Rotation = 1 0 0 1", "expected finite numbers: 9");
  LineIsRefused(std::string("Comment = a\0b", 13), "has the character of code 0; expected text");
  LineIsRefused("Comment = a\rb", "has a carriage return within it");
  HeaderIsRefused("Offset = 0 0 0\n" + MetaImageHeaderOf("LOCAL"), { "Offset stands before NDims" });
  for (const std::string field : { "NDims", "DimSize", "ElementType", "ElementDataFile" })
  {
    const std::string good = MetaImageHeaderOf("LOCAL");
    IsRefused("a.mha", Replaced(good, field + " =", "Other" + field + " ="), { field });
  }
}

TEST_F(MetaImageFile, PixelsThatAreNotWhereTheHeaderSaysAreRefused)
{
  const std::string pixels = RandomBytes(StackBytes);
  LineIsRefused("HeaderSize = 100", "HeaderSize is 100, within the header of");
  LineIsRefused("HeaderSize = -2", "HeaderSize is -2; expected -1, 0 or a number of bytes");
  LineIsRefused("HeaderSize = 99999", "truncated: 0 bytes of pixels, expected 280");
  IsRefused("a.mha", MetaImageHeaderOf("LOCAL") + pixels + "a", { "1 bytes are left over after its pixels" });
  IsRefused("a.mha", MetaImageHeaderOf("LOCAL") + pixels.substr(1), { "truncated: 279 bytes of pixels, expected 280" });
  IsRefused("a.mha",
            MetaImageHeaderOf("LOCAL", "HeaderSize = -1\n") + pixels.substr(1),
            { "truncated: 279 bytes of pixels, expected 280" });
  IsRefused("a.mha",
            Replaced(MetaImageHeaderOf("LOCAL", "HeaderSize = -1\n"), "7 5 4", "7 5 3") + pixels,
            { "70 bytes before its pixels, enough for another frame" });
  IsRefused("a.mhd", MetaImageHeaderOf("a.raw"), { "its data file " + Path("a.raw") + ": does not exist" });
  IsRefused("a.mhd", MetaImageHeaderOf("a.mhd"), { "its data file " + Path("a.mhd") + " is the file itself" });
  IsRefused("a.mhd", MetaImageHeaderOf("."), { "is a folder" });
  Write("a.raw", pixels + "ab");
  IsRefused("a.mhd", MetaImageHeaderOf("a.raw"), { "2 bytes in its data file " + Path("a.raw") + " are left over" });
  IsRefused("a.mhd", MetaImageHeaderOf("a.raw", "HeaderSize = 3\n"), { "truncated: 279 bytes of pixels in its data" });
  IsRefused("a.mhd", MetaImageHeaderOf("part%03d 0 3 1"), { "ElementDataFile is the pattern part%03d 0 3 1" });
}

TEST_F(MetaImageFile, AListThatIsNotOfAFileForEachFrameIsRefused)
{
  std::string list;
  for (const std::string name : { "p0", "p1", "p2", "p3" })
  {
    Write(name, RandomBytes(FrameBytes));
    list += name + "\n";
  }
  const std::string header = MetaImageHeaderOf("LIST");
  IsStack("a.mhd", header + list);
  IsRefused(
    "a.mhd", header + list.substr(0, list.size() - 1), { "truncated: 3 whole lines in its list", "expected 4" });
  IsStack("a.mhd", header + list + "\n \n");
  IsRefused(
    "a.mhd", header + Replaced(list, "p2\n", "p2\n\n"), { "an empty line in its list", "expected a name in each" });
  IsRefused("a.mhd", header + " \n" + list, { "an empty line in its list of data files" });
  IsRefused("a.mhd", header + list + "p3\n", { "5 whole lines in its list of data files, expected 4" });
  IsRefused("a.mhd", header + Replaced(list, "p3", "p2"), { "p2 comes twice in its list; expected each once" });
  IsRefused("a.mhd", header + Replaced(list, "p3", "p4"), { "p4: does not exist" });
  IsRefused("a.mhd", header + Replaced(list, "p3", "a.mhd"), { "a.mhd is the file itself" });
  IsRefused(
    "a.mhd", MetaImageHeaderOf("LIST 1") + list, { "ElementDataFile is LIST 1; expected a list with one file" });
  Write("p1", RandomBytes(FrameBytes - 1));
  IsRefused("a.mhd", header + list, { "truncated: 69 bytes of pixels in its data file " + Path("p1"), "expected 70" });
}

TEST_F(MetaImageFile, CompressedPixelsThatAreNotExactlyThoseDeclaredAreRefused)
{
  const std::string pixels = RandomBytes(StackBytes);
  const std::string stream = ZlibStream(pixels);
  const auto        isRefused = [this](const std::string & bytes, std::size_t size, const std::string & words) {
    IsRefused("a.mha", CompressedHeaderOf("LOCAL", size) + bytes, { words });
  };
  isRefused(ZlibStream(pixels.substr(1)), stream.size() - 1, "give 279 bytes");
  isRefused(ZlibStream(pixels + "a"), stream.size() + 1, "give more than 280 bytes, expected 280 bytes");
  isRefused(
    stream.substr(0, stream.size() - 1), stream.size() - 1, "280 bytes and then an error (no end of the stream)");
  isRefused(stream.substr(0, stream.size() - 1) + "x", stream.size(), "error (incorrect data check)");
  isRefused(stream + "a", stream.size(), "1 bytes are left over after its pixels");
  isRefused(stream + "a", stream.size() + 1, "1 bytes are left over after its pixels");
  isRefused(stream, stream.size() + 1, "truncated: " + std::to_string(stream.size()) + " bytes of compressed pixels");
  isRefused(stream, 0, "compressed with a CompressedDataSize of 0");
  LineIsRefused("CompressedData = True", "compressed without a CompressedDataSize");
  LineIsRefused("CompressedData = True\nHeaderSize = -1", "compressed with a HeaderSize of -1");
  IsRefused("a.mhd", CompressedHeaderOf("LIST", 9) + "a\nb\nc\nd\n", { "compressed with", "in a list of data files" });
}

} // namespace
