// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "base/Text.h"
#include "files/FrameReader.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>

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
  const std::string type = WithoutBlanks(LowerCase(header.Field("type")));
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

/** Throws FileError unless each axis is an axis of the image: no axis is the components of a pixel, and only the last
 * axis is time. */
void
CheckKinds(const std::string & file, const NrrdHeader & header, const std::vector<std::uint64_t> & sizes)
{
  const std::vector<std::string> kinds = WordsOf(LowerCase(header.Field("kinds")));
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
    if (kinds[i] == "time" && i + 1 < kinds.size())
    {
      throw FileError(file,
                      "axis " + std::to_string(i) +
                        " is of kind time; expected time as the last axis. Reorder the axes: numpy.moveaxis()");
    }
  }
}

/** Returns the place of pixels in the file \a path, from \a begin + \a skip on. \a begin is above 0 if this is the file
 * itself. Throws FileError. */
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

/** Returns the path of a data file. Throws FileError if the name means several files. */
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

/** Returns whether the pixels are compressed by gzip. Throws FileError unless they are, or are raw, with a byte order
 * and skips that can be checked. */
bool
IsGzip(const FrameFile & file, const NrrdHeader & header)
{
  const std::string encoding = WithoutBlanks(LowerCase(header.Field("encoding")));
  const bool        isGzip = encoding == "gzip" || encoding == "gz";
  if (!isGzip && encoding != "raw")
  {
    throw FileError(file.name, "encoding is " + (encoding.empty() ? "missing" : encoding) + "; expected raw or gzip");
  }
  const std::string endian = WithoutBlanks(LowerCase(header.Field("endian")));
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

/** Returns the number of a word, NaN for "nan", which means not known; none for other words. */
std::optional<double>
NumberOrNaN(const std::string & word)
{
  return WithoutBlanks(LowerCase(word)) == "nan" ? std::numeric_limits<double>::quiet_NaN()
                                                 : FiniteNumber(WithoutBlanks(word));
}

/** Returns the numbers of "(1,0,0)". Throws FileError unless there are \a count. */
std::vector<double>
VectorIn(const std::string & file, const std::string & text, std::size_t count)
{
  std::vector<double> numbers;
  const bool          isVector = text.size() > 2 && text.front() == '(' && text.back() == ')';
  for (std::size_t begin = 1; isVector && begin < text.size();)
  {
    const std::size_t           end = text.find_first_of(",)", begin);
    const std::optional<double> number = NumberOrNaN(text.substr(begin, end - begin));
    numbers.push_back(number.value_or(0.0));
    if (!number)
    {
      numbers.clear();
      break;
    }
    begin = end + 1;
  }
  if (numbers.size() != count)
  {
    throw FileError(file,
                    "its header gives \"" + text +
                      "\" for a position or direction; expected numbers in brackets: " + std::to_string(count));
  }
  return numbers;
}

/** Returns the vectors of a field, one for each axis. The vector of an axis outside of space is empty. Throws FileError
 * unless there are \a count. */
std::vector<std::vector<double>>
VectorsIn(const std::string & file, const std::string & text, std::size_t count)
{
  std::vector<std::vector<double>> vectors;
  for (std::size_t at = text.find_first_not_of(" \t"); at != std::string::npos;)
  {
    const bool        isNone = LowerCase(text.substr(at, 4)) == "none";
    const std::size_t close = isNone ? at + 3 : std::min(text.find(')', at), text.size() - 1);
    vectors.push_back(isNone ? std::vector<double>() : VectorIn(file, text.substr(at, close + 1 - at), count));
    at = text.find_first_not_of(" \t", close + 1);
  }
  if (vectors.size() != count)
  {
    throw FileError(file,
                    "space directions: " + std::to_string(vectors.size()) + ", but its dimension is " +
                      std::to_string(count) + "; expected as many");
  }
  return vectors;
}

/** Returns the signs that convert coordinates of a space to coordinates of ITK, one for each axis of the space; empty
 * without a space. */
std::vector<double>
SignsOfSpace(const std::string & file, const NrrdHeader & header)
{
  const std::string dimension = WithoutBlanks(header.Field("space dimension"));
  if (!dimension.empty())
  {
    const std::optional<std::uint64_t> axes = WholeNumber(dimension);
    if (!axes || *axes == 0 || *axes > 8) // NRRD_SPACE_DIM_MAX
    {
      throw FileError(file, "space dimension is " + dimension + "; expected 1 to 8");
    }
    return std::vector<double>(static_cast<std::size_t>(*axes), 1.0);
  }
  const std::string space = WithoutBlanks(LowerCase(header.Field("space")));
  if (space.empty())
  {
    return {};
  }
  static const std::map<std::string, std::vector<double>> known{ { "right-anterior-superior", { -1.0, -1.0, 1.0 } },
                                                                 { "ras", { -1.0, -1.0, 1.0 } },
                                                                 { "left-anterior-superior", { -1.0, 1.0, 1.0 } },
                                                                 { "las", { -1.0, 1.0, 1.0 } } };
  const auto                                              found = known.find(space);
  const std::size_t time = space.size() > 5 && space.rfind("-time") == space.size() - 5 ? 1 : 0;
  return found != known.end() ? found->second : std::vector<double>(3 + time, 1.0);
}

void
SetSpacings(const std::string & file, const std::string & text, std::size_t axes, StackGeometry & geometry)
{
  const std::vector<std::string> words = WordsOf(text);
  for (std::size_t axis = 0; axis < words.size(); ++axis)
  {
    const std::optional<double> spacing = NumberOrNaN(words[axis]);
    if (!spacing || words.size() != axes)
    {
      throw FileError(file, "spacings are " + text + "; expected numbers: " + std::to_string(axes));
    }
    geometry.spacing[axis] = *spacing;
  }
}

/** Returns the geometry that the header of a NRRD image of \a axes axes gives, in the coordinates of ITK (left,
 * posterior, superior). RAS and LAS are converted to these. `spacings` apply to axes without a space direction. A space
 * with another number of axes is not used. Throws FileError for a field that cannot be read. Source: "Space and
 * orientation information" in the definition of the format, https://teem.sourceforge.net/nrrd/format.html. */
StackGeometry
GeometryOfNrrd(const std::string & file, const NrrdHeader & header, std::size_t axes)
{
  StackGeometry             geometry;
  const std::vector<double> signs = SignsOfSpace(file, header);
  if (!header.Field("spacings").empty())
  {
    SetSpacings(file, header.Field("spacings"), axes, geometry);
  }
  const std::string directions = header.Field("space directions");
  const std::string origin = WithoutBlanks(header.Field("space origin"));
  if (signs.size() != axes)
  {
    return UsableGeometry(geometry);
  }
  const auto vectors = directions.empty() ? std::vector<std::vector<double>>(axes) : VectorsIn(file, directions, axes);
  const auto place = origin.empty() ? std::vector<double>(axes, 0.0) : VectorIn(file, origin, axes);
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    double length = 0.0;
    for (const double part : vectors[axis])
    {
      length += part * part;
    }
    length = std::sqrt(length);
    geometry.origin[axis] = signs[axis] * place[axis];
    if (length > 0.0)
    {
      geometry.spacing[axis] = length;
      for (std::size_t row = 0; row < axes; ++row)
      {
        geometry.direction[row][axis] = signs[row] * (1.0 / length) * vectors[axis][row]; // rounded as in ITK
      }
    }
  }
  return UsableGeometry(geometry);
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
  coding.sample = WholeSample(file, WithoutBlanks(LowerCase(header.Field("endian"))) == "big");
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
