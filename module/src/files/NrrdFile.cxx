// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/NrrdFile.h"

#include "files/DataFile.h"
#include "sensornoise/FrameFile.h"
#include "files/FrameSizes.h"
#include "files/NrrdGeometry.h"
#include "files/NrrdHeader.h"
#include "files/StoredNumber.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{
namespace
{
using NamesOfType = std::pair<std::vector<std::string>, std::string>;

bool
IsOneOf(const std::string & word, const std::vector<std::string> & words)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

void
SetPixelOfNrrd(FrameFile & file, const NrrdHeader & header)
{
  struct KnownType
  {
    std::vector<std::string> names;
    FramePixel               pixel;
    StoredNumber             stored;
  };
  constexpr StoredNumber              same = StoredNumber::SameAsPixel;
  static const std::vector<KnownType> types{
    { { "uchar", "unsigned char", "uint8", "uint8_t" }, FramePixel::UnsignedChar, same },
    { { "ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t" }, FramePixel::UnsignedShort, same },
    { { "short", "short int", "signed short", "signed short int", "int16", "int16_t" }, FramePixel::Short, same },
    { { "uint", "unsigned int", "uint32", "uint32_t" }, FramePixel::Double, StoredNumber::UnsignedInt },
    { { "int", "signed int", "int32", "int32_t" }, FramePixel::Double, StoredNumber::Int },
    { { "float" }, FramePixel::Float, same },
    { { "double" }, FramePixel::Double, same }
  };
  static const std::vector<NamesOfType> others{
    { { "signed char", "int8", "int8_t" }, "char" },
    { { "longlong", "long long", "long long int", "signed long long", "int64", "int64_t" }, "long long" },
    { { "ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t" }, "unsigned long long" }
  };
  const std::string type = WithoutBlanks(InSmallLetters(header.Field("type")));
  for (const KnownType & known : types)
  {
    if (IsOneOf(type, known.names))
    {
      file.pixel = known.pixel;
      file.stored = known.stored;
      return;
    }
  }
  for (const auto & [names, component] : others)
  {
    if (IsOneOf(type, names))
    {
      throw FileError(file.name, UnsupportedPixel(component));
    }
  }
  throw FileError(file.name, UnsupportedPixel(type));
}

std::vector<std::uint64_t>
SizesOfNrrd(const std::string & file, const NrrdHeader & header)
{
  const std::optional<std::uint64_t> dimension = WholeNumber(WithoutBlanks(header.Field("dimension")));
  std::vector<std::uint64_t>         sizes;
  for (const std::string & word : WordsOf(header.Field("sizes")))
  {
    const std::optional<std::uint64_t> size = WholeNumber(word);
    if (!size)
    {
      throw FileError(file, "sizes are " + header.Field("sizes") + "; expected whole numbers");
    }
    sizes.push_back(*size);
  }
  if (!dimension || *dimension != sizes.size())
  {
    throw FileError(file,
                    "sizes: " + std::to_string(sizes.size()) + ", but its dimension is " + header.Field("dimension") +
                      "; expected as many sizes");
  }
  return sizes;
}

/** Throws unless each axis is one of the image, none the components of a pixel. */
void
CheckKinds(const std::string & file, const NrrdHeader & header, const std::vector<std::uint64_t> & sizes)
{
  const std::vector<std::string> kinds = WordsOf(InSmallLetters(header.Field("kinds")));
  if (!kinds.empty() && kinds.size() != sizes.size())
  {
    throw FileError(file,
                    "kinds: " + std::to_string(kinds.size()) + ", but its dimension is " +
                      std::to_string(sizes.size()) + "; expected as many kinds");
  }
  for (std::size_t i = 0; i < kinds.size(); ++i)
  {
    if (!IsOneOf(kinds[i], { "domain", "space", "time", "none", "???" }))
    {
      throw FileError(file,
                      "axis " + std::to_string(i) + " is of kind " + kinds[i] + ": " + SeveralComponents(sizes[i]));
    }
  }
}

/** Where pixels in a file of their own, or in this one, begin. */
DataPlace
PlaceOfNrrd(const FrameFile & file, const std::string & path, const std::string & skip, std::uint64_t begin)
{
  const std::optional<std::uint64_t> skipped = skip.empty() ? 0 : WholeNumber(skip);
  if (!skipped && skip != "-1")
  {
    throw FileError(file.name, "byte skip is " + skip + "; expected -1, 0 or a number of bytes");
  }
  return { path, begin + skipped.value_or(0), !skipped, begin > 0 };
}

/** The path of a data file. Throws where the name stands for several files. */
std::string
PathOfNrrdData(const std::string & file, const std::string & name)
{
  if (name == "-" || name.find('%') != std::string::npos)
  {
    throw FileError(file, "its data file is " + name + "; expected the name of one file, or LIST");
  }
  return PathOfDataFile(file, name);
}

std::vector<DataPlace>
PlacesOfNrrd(const FrameFile & file, const NrrdHeader & header)
{
  const std::string      name = header.Field("data file");
  const std::string      skip = WithoutBlanks(header.Field("byte skip"));
  std::vector<DataPlace> places;
  if (name.empty())
  {
    places.push_back(PlaceOfNrrd(file, file.name, skip, header.end));
    return places;
  }
  if (name.rfind("LIST", 0) != 0)
  {
    places.push_back(PlaceOfNrrd(file, PathOfNrrdData(file.name, name), skip, 0));
    return places;
  }
  const std::string dimension = WithoutBlanks(name.substr(4));
  if (WithoutBlanks(header.Field("dimension")) != "3" || !(dimension.empty() || dimension == "2"))
  {
    throw FileError(file.name,
                    "its data file is " + name + "; expected a list with one file for each frame of a 3-D image");
  }
  if (header.list.size() != file.frames)
  {
    throw FileError(file.name,
                    (header.list.size() < file.frames ? "truncated: " : "") + std::to_string(header.list.size()) +
                      " whole lines in its list of data files, expected " + std::to_string(file.frames));
  }
  for (const std::string & line : header.list)
  {
    places.push_back(PlaceOfNrrd(file, PathOfNrrdData(file.name, line), skip, 0));
  }
  return places;
}

/** Whether the pixels are in streams of gzip. Throws unless they are, or raw. */
bool
IsGzip(const FrameFile & file, const NrrdHeader & header)
{
  const std::string encoding = WithoutBlanks(InSmallLetters(header.Field("encoding")));
  const bool        isGzip = encoding == "gzip" || encoding == "gz";
  if (!isGzip && encoding != "raw")
  {
    throw FileError(file.name, "encoding is " + (encoding.empty() ? "missing" : encoding) + "; expected raw or gzip");
  }
  const std::string endian = WithoutBlanks(InSmallLetters(header.Field("endian")));
  if ((SizeOf(file.pixel) > 1 || !endian.empty()) && endian != "little" && endian != "big")
  {
    throw FileError(file.name, "endian is " + (endian.empty() ? "missing" : endian) + "; expected little or big");
  }
  const std::string lines = WithoutBlanks(header.Field("line skip"));
  if (!lines.empty() && lines != "0")
  {
    throw FileError(file.name, "line skip is " + lines + ", which cannot be checked; expected none, or a byte skip");
  }
  const std::string skip = WithoutBlanks(header.Field("byte skip"));
  if (isGzip && !skip.empty() && skip != "0")
  {
    throw FileError(file.name, "byte skip is " + skip + " within compressed pixels; expected none");
  }
  return isGzip;
}
} // namespace

bool
IsHeadOfNrrd(const std::string & head, const std::string & /*name*/)
{
  return head.rfind("NRRD", 0) == 0;
}

void
InspectNrrd(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating)
{
  const NrrdHeader header = ReadNrrdHeader(file.name, bytes);
  SetPixelOfNrrd(file, header);
  const std::vector<std::uint64_t> sizes = SizesOfNrrd(file.name, header);
  CheckKinds(file.name, header, sizes);
  SetFrameSizes(file, sizes);
  file.geometry = GeometryOfNrrd(file.name, header, sizes.size());
  DataCoding coding;
  if (IsGzip(file, header))
  {
    coding.compression = InflateContainer::Gzip;
  }
  coding.sample = WholeSample(file, WithoutBlanks(InSmallLetters(header.Field("endian"))) == "big");
  SetDataFrames(file, PlacesOfNrrd(file, header), coding, beforeInflating);
}

std::vector<std::string>
DataFilesOfNrrd(FileBytes & bytes, const std::string & name)
{
  const NrrdHeader         header = ReadNrrdHeader(name, bytes);
  const std::string        dataFile = header.Field("data file");
  std::vector<std::string> paths;
  if (!dataFile.empty() && dataFile.rfind("LIST", 0) != 0)
  {
    paths.push_back(PathOfDataFile(name, dataFile));
  }
  for (const std::string & line : header.list)
  {
    paths.push_back(PathOfDataFile(name, line));
  }
  return paths;
}

} // namespace sensornoise
