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

/** Returns a header as ITK writes it, with more lines before the empty line. */
std::string
NrrdHeaderOf(const std::string & encoding, const std::string & more = "")
{
  return "NRRD0004\n# a comment\ntype: unsigned short\ndimension: 3\nspace dimension: 3\nsizes: 7 5 4\nspace "
         "directions: "
         "(1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\nencoding: " +
         encoding + "\nspace origin: (0,0,0)\nkey:=a value\n" + more + "\n";
}

class NrrdFile : public FrameFileTest
{
protected:
  void
  HeaderIsRefused(const std::string & header, const std::vector<std::string> & parts) const
  {
    IsRefused("a.nrrd", header + RandomBytes(StackBytes), parts);
  }

  void
  LineIsRefused(const std::string & line, const std::string & words) const
  {
    HeaderIsRefused(NrrdHeaderOf("raw", line + "\n"), { words });
  }

  FrameFile
  IsStack(const std::string & name, const std::string & bytes) const
  {
    return IsFrames(name, bytes, FramePixel::UnsignedShort, 7, 5, 4);
  }
};

TEST_F(NrrdFile, OfEveryKindThatIsCompleteIsAccepted)
{
  const std::string pixels = RandomBytes(StackBytes);
  EXPECT_STREQ(IsStack("a.nrrd", NrrdHeaderOf("raw") + pixels).format->name, "NRRD");
  IsStack("a.nrrd", NrrdHeaderOf("RAW", "Byte Skip: 5\n") + "12345" + pixels);
  IsStack("a.nrrd", NrrdHeaderOf("raw", "byteskip: -1\nline skip: 0\n") + "12345" + pixels);
  IsStack("a.nrrd", NrrdHeaderOf("gzip") + GzipStream(pixels));
  IsStack("a.nrrd", Replaced(NrrdHeaderOf("gz"), "unsigned short", "uint16") + GzipStream(pixels));
  Write("a.raw", pixels);
  EXPECT_EQ(IsStack("a.nhdr", NrrdHeaderOf("raw", "data file: a.raw\n")).identities.size(), 2u);
  std::string withoutEnd = NrrdHeaderOf("raw", "datafile: " + Path("a.raw") + "\n");
  withoutEnd.pop_back();
  IsStack("a.nhdr", withoutEnd);
  Write("a.gz", GzipStream(pixels));
  IsStack("a.nhdr", NrrdHeaderOf("gzip", "data file: a.gz\n"));
  std::string list = "data file: LIST\n";
  for (std::size_t t = 0; t < 4; ++t)
  {
    const std::string name = "part" + std::to_string(t);
    Write(name, pixels.substr(t * FrameBytes, FrameBytes));
    Write(name + ".gz", GzipStream(pixels.substr(t * FrameBytes, FrameBytes)));
    list += name + "\n";
  }
  withoutEnd = NrrdHeaderOf("raw", list);
  withoutEnd.pop_back();
  EXPECT_EQ(IsStack("a.nhdr", withoutEnd).identities.size(), 5u);
  const std::string frame = "NRRD0001\r\ntype: uchar\r\ndimension: 2\r\nsizes: 7 5\r\nencoding: raw\r\n\r\n";
  IsFrames("f.nrrd", frame + RandomBytes(35), FramePixel::UnsignedChar, 7, 5, 1);
  const std::string wide = Replaced(frame, "encoding", "endian: big\nencoding");
  IsFrames("f.nrrd", Replaced(wide, "uchar", "int16_t") + RandomBytes(70), FramePixel::Short, 7, 5, 1);
  IsFrames("f.nrrd", Replaced(wide, "uchar", "float") + RandomBytes(140), FramePixel::Float, 7, 5, 1);
  IsFrames("f.nrrd", Replaced(wide, "uchar", "double") + RandomBytes(280), FramePixel::Double, 7, 5, 1);
}

TEST_F(NrrdFile, GivesItsGeometryInTheCoordinatesOfITK)
{
  const std::string head = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 2\nencoding: raw\n";
  const auto        geometryOf = [&](const std::string & lines) {
    return IsFrames("g.nrrd", head + lines + "\nab", FramePixel::UnsignedChar, 1, 1, 2).geometry;
  };
  const std::string   vectors = "space directions: (0,2,0) (3, 0, 0) (0,0,-4)\nspace origin: (5,6,7)\n";
  const StackGeometry lps = geometryOf("space: left-posterior-superior\n" + vectors);
  EXPECT_EQ(lps.spacing, (std::array<double, 3>{ 2.0, 3.0, 4.0 }));
  EXPECT_EQ(lps.origin, (std::array<double, 3>{ 5.0, 6.0, 7.0 }));
  EXPECT_EQ(lps.direction[0], (std::array<double, 3>{ 0.0, 1.0, 0.0 }));
  EXPECT_EQ(lps.direction[2], (std::array<double, 3>{ 0.0, 0.0, -1.0 }));
  const StackGeometry ras = geometryOf("space: RAS\n" + vectors);
  EXPECT_EQ(ras.origin, (std::array<double, 3>{ -5.0, -6.0, 7.0 }));
  EXPECT_EQ(ras.direction[0], (std::array<double, 3>{ 0.0, -1.0, 0.0 }));
  EXPECT_EQ(ras.direction[1], (std::array<double, 3>{ -1.0, 0.0, 0.0 }));
  EXPECT_EQ(geometryOf("spacings: 0.5 nan 2\n").spacing, (std::array<double, 3>{ 0.5, 1.0, 2.0 }));
  const StackGeometry other = geometryOf("space dimension: 2\nspace directions: (1,0) (0,1) none\n");
  EXPECT_EQ(other.spacing, StackGeometry().spacing); // time has no direction in space
  LineIsRefused("spacings: 1 2", "spacings are 1 2; expected numbers: 3");
  HeaderIsRefused(Replaced(NrrdHeaderOf("raw"), "(0,1,0)", "(0,1)"), { "gives \"(0,1)\"", "in brackets: 3" });
  HeaderIsRefused(Replaced(NrrdHeaderOf("raw"), "(0,1,0)", "(0,x,0)"), { "gives \"(0,x,0)\"" });
  HeaderIsRefused(Replaced(NrrdHeaderOf("raw"), " (0,0,1)", ""), { "space directions: 2, but its dimension is 3" });
  HeaderIsRefused(Replaced(NrrdHeaderOf("raw"), "space dimension: 3", "space dimension: 9"), { "expected 1 to 8" });
}

TEST_F(NrrdFile, WhatIsNoImageOfOneValueIsRefused)
{
  const std::string good = NrrdHeaderOf("raw");
  HeaderIsRefused(Replaced(good, "NRRD0004", "NRRD0006"), { "its first line is not NRRD0001 to NRRD0005" });
  HeaderIsRefused(Replaced(good, "NRRD0004", "NRRD00044"), { "its first line is not" });
  HeaderIsRefused(Replaced(good, "unsigned short", "int64"), { "component type long long is not supported" });
  HeaderIsRefused(Replaced(good, "unsigned short", "int8"), { "component type char is not supported" });
  HeaderIsRefused(Replaced(good, "unsigned short", "block"), { "component type block is not supported" });
  HeaderIsRefused(Replaced(good, "kinds: domain", "kinds: RGB-color"), { "axis 0 is of kind rgb-color: 7 components" });
  HeaderIsRefused(Replaced(good, "domain domain domain", "domain domain list"), { "of kind list: 4 components" });
  HeaderIsRefused(Replaced(good, "domain domain domain", "domain"), { "kinds: 1, but its dimension is 3" });
  IsStack("named.tif", good + RandomBytes(StackBytes)); // a format is recognised by its contents
}

TEST_F(NrrdFile, TimeIsTheLastAxis)
{
  const auto headerOf = [](const std::string & kinds) {
    return Replaced(NrrdHeaderOf("raw"), "domain domain domain", kinds);
  };
  IsStack("a.nrrd", headerOf("domain domain time") + RandomBytes(StackBytes));
  HeaderIsRefused(headerOf("time domain domain"), { "axis 0 is of kind time", "expected time as the last axis" });
  HeaderIsRefused(headerOf("space Time space"), { "axis 1 is of kind time", "numpy.moveaxis" });
}

TEST_F(NrrdFile, SizesThatCannotBeAreRefused)
{
  const auto isRefused = [this](const std::string & sizes, const std::string & words) {
    HeaderIsRefused(Replaced(NrrdHeaderOf("raw"), "7 5 4", sizes), { words });
  };
  isRefused("7 5 0", "size 0 along axis 2");
  isRefused("7 5 4294967296", "size 4294967296 along axis 2");
  isRefused("7 5 -4", "sizes are 7 5 -4; expected whole numbers");
  isRefused("7 5", "sizes: 2, but its dimension is 3");
  isRefused("2147483647 2147483647 4", "more than can be counted in bytes");
  isRefused("7 5 5", "truncated: 280 bytes of pixels, expected 350");
  isRefused("7 5 3", "70 bytes are left over after its pixels; expected none");
  const std::string line = Replaced(Replaced(NrrdHeaderOf("raw"), "dimension: 3", "dimension: 1"), "7 5 4", "140");
  HeaderIsRefused(Replaced(line, "kinds: domain domain domain\n", ""), { "1 dimensions; expected 2" });
}

TEST_F(NrrdFile, LinesThatAreNoFieldsAreRefused)
{
  LineIsRefused("# " + std::string(4095, 'c'), "line 13 of its header has more than 4096 characters");
  EXPECT_EQ(SaidOf("a.nrrd", NrrdHeaderOf("raw", "# " + std::string(4094, 'c') + "\n") + RandomBytes(StackBytes)), "");
  LineIsRefused("foo: bar", "line 13 of its header is neither a field of NRRD nor a comment nor a key");
  LineIsRefused("type: float", "gives type a second time");
  LineIsRefused("byte skip: 5\nbyteskip: 5", "gives byte skip a second time");
  LineIsRefused("content: ", "gives no value for content");
  LineIsRefused(std::string("# a\0", 4), "has the character of code 0");
  LineIsRefused("# a\rb", "has a carriage return within it");
  std::string many;
  for (int i = 0; i < 100001; ++i)
  {
    many += "#\n";
  }
  LineIsRefused(many, "its header has more than 100000 lines, or more than 4 MiB");
  many.clear();
  for (int i = 0; i < 5000; ++i)
  {
    many += "# " + std::string(900, 'c') + "\n";
  }
  LineIsRefused(many, "its header has more than 100000 lines, or more than 4 MiB");
  HeaderIsRefused(Replaced(NrrdHeaderOf("raw"), "sizes:", "# sizes:"), { "sizes: 0, but its dimension is 3" });
  std::string cut = NrrdHeaderOf("raw");
  cut.pop_back();
  IsRefused("a.nrrd", cut, { "truncated: its header does not end with an empty line, and names no data file" });
  cut.pop_back();
  IsRefused("a.nrrd", cut, { "truncated: the last line of its header has no end" });
}

TEST_F(NrrdFile, EncodingsThatCannotBeCheckedAreRefused)
{
  for (const std::string encoding : { "ascii", "txt", "hex", "bzip2", "bz2" })
  {
    HeaderIsRefused(NrrdHeaderOf(encoding), { "encoding is " + encoding + "; expected raw or gzip" });
  }
  const std::string good = NrrdHeaderOf("raw");
  HeaderIsRefused(Replaced(good, "encoding: raw\n", ""), { "encoding is missing" });
  HeaderIsRefused(Replaced(good, "endian: little\n", ""), { "endian is missing; expected little or big" });
  HeaderIsRefused(Replaced(good, "little", "middle"), { "endian is middle" });
  LineIsRefused("line skip: 2", "line skip is 2, which cannot be checked");
  LineIsRefused("byte skip: -2", "byte skip is -2; expected -1, 0 or a number of bytes");
  HeaderIsRefused(NrrdHeaderOf("gzip", "byte skip: 2\n"), { "byte skip is 2 within compressed pixels" });
}

TEST_F(NrrdFile, PixelsThatAreNotWhereTheHeaderSaysAreRefused)
{
  const std::string pixels = RandomBytes(StackBytes);
  IsRefused("a.nrrd", NrrdHeaderOf("raw") + pixels + "a", { "1 bytes are left over after its pixels" });
  IsRefused("a.nrrd", NrrdHeaderOf("raw") + pixels.substr(1), { "truncated: 279 bytes of pixels, expected 280" });
  HeaderIsRefused(
    Replaced(NrrdHeaderOf("raw", "byte skip: -1\n"), "7 5 4", "7 5 3"),
    { "70 bytes before its pixels, enough for another frame; expected the number of bytes to skip, not -1" });
  LineIsRefused("byte skip: 99", "truncated: 181 bytes of pixels, expected 280");
  const auto isRefused = [this](const std::string & dataFile, const std::string & words) {
    IsRefused("a.nhdr", NrrdHeaderOf("raw", "data file: " + dataFile + "\n"), { words });
  };
  isRefused("a.raw", "its data file " + Path("a.raw") + ": does not exist");
  isRefused("a.nhdr", "its data file " + Path("a.nhdr") + " is the file itself");
  isRefused("-", "its data file is -; expected the name of one file, or LIST");
  isRefused("part%03d 0 3 1", "its data file is part%03d 0 3 1");
  isRefused("LIST 1\na\nb", "its data file is LIST 1; expected a list with one file for each frame");
  isRefused("LIST\na\nb\nc", "truncated: 3 whole lines in its list of data files, expected 4");
  isRefused("LIST\na\nb\nc\nd\ne", "5 whole lines in its list");
  Write("a.raw", pixels + "ab");
  isRefused("a.raw", "2 bytes in its data file " + Path("a.raw") + " are left over");
  Write("part", RandomBytes(FrameBytes));
  isRefused("LIST\npart\npart\npart\npart", "part comes twice in its list");
}

TEST_F(NrrdFile, CompressedPixelsThatAreNotExactlyThoseDeclaredAreRefused)
{
  const std::string pixels = RandomBytes(StackBytes);
  const std::string stream = GzipStream(pixels);
  const auto        isRefused = [this](const std::string & bytes, const std::string & words) {
    IsRefused("a.nrrd", NrrdHeaderOf("gzip") + bytes, { words });
  };
  isRefused(GzipStream(pixels.substr(1)), "give 279 bytes, expected 280 bytes and the end of the stream");
  isRefused(GzipStream(pixels + "a"), "give more than 280 bytes");
  isRefused(ZlibStream(pixels), "0 bytes and then an error (incorrect header check)");
  isRefused(pixels, "0 bytes and then an error");
  isRefused(stream + "a", "1 bytes are left over after its pixels");
  isRefused(stream + stream, "bytes are left over after its pixels");
  isRefused("", "0 bytes and then an error (no end of the stream)");
  const std::size_t head = 10; // bytes of gzip's header; some of their bits have no meaning
  std::size_t       accepted = 0;
  for (std::size_t bit = 8 * head; bit < 8 * stream.size(); ++bit)
  {
    accepted += SaidOf("a.nrrd", NrrdHeaderOf("gzip") + WithChangedBit(stream, bit)).empty() ? 1 : 0;
  }
  EXPECT_LE(accepted, 7u); // those that fill up the last byte before the checksum
  for (std::size_t size = 0; size < stream.size(); ++size)
  {
    ASSERT_NE(SaidOf("a.nrrd", NrrdHeaderOf("gzip") + stream.substr(0, size)), "") << size << " bytes";
  }
}

} // namespace
