// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "base/Text.h"
#include "files/FrameReader.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace sensornoise
{
namespace
{
void
SetPixelOfMetaImage(FrameFile & file, const std::string & type)
{
  struct KnownType
  {
    const char * name;
    FramePixel   pixel;
    StoredNumber stored;
  };
  constexpr StoredNumber              same = StoredNumber::SameAsPixel;
  static const std::vector<KnownType> types{ { "MET_UCHAR", FramePixel::UnsignedChar, same },
                                             { "MET_USHORT", FramePixel::UnsignedShort, same },
                                             { "MET_SHORT", FramePixel::Short, same },
                                             { "MET_UINT", FramePixel::Double, StoredNumber::UnsignedInt },
                                             { "MET_INT", FramePixel::Double, StoredNumber::Int },
                                             { "MET_FLOAT", FramePixel::Float, same },
                                             { "MET_DOUBLE", FramePixel::Double, same } };
  for (const KnownType & known : types)
  {
    if (type == known.name)
    {
      file.pixel = known.pixel;
      file.stored = known.stored;
      return;
    }
  }
  static const std::vector<std::pair<std::string, std::string>> others{ { "MET_CHAR", "char" },
                                                                        { "MET_LONG", "long" },
                                                                        { "MET_ULONG", "unsigned long" },
                                                                        { "MET_LONG_LONG", "long long" },
                                                                        { "MET_ULONG_LONG", "unsigned long long" } };
  for (const auto & [name, component] : others)
  {
    if (type == name)
    {
      throw FileError(file.name, UnsupportedPixel(component));
    }
  }
  throw FileError(file.name, UnsupportedPixel(type));
}

bool
IsTrue(const std::string & value)
{
  return !value.empty() && std::string("Tt1").find(value[0]) != std::string::npos;
}

/** Returns the size of the compressed pixels [bytes]; 0 if they are not compressed. Throws FileError if the header does
 * not give it. */
std::uint64_t
CompressedBytesOf(const std::string & file, const MetaImageHeader & header)
{
  if (!IsTrue(header.Field("CompressedData")))
  {
    return 0;
  }
  if (header.Field("HeaderSize") == "-1" || !header.list.empty())
  {
    throw FileError(file, "compressed with a HeaderSize of -1 or in a list of data files; expected neither");
  }
  const std::string                  text = header.Field("CompressedDataSize");
  const std::optional<std::uint64_t> size = WholeNumber(text);
  if (text.empty() || !size || *size == 0)
  {
    throw FileError(file,
                    "compressed " +
                      (text.empty() ? "without a CompressedDataSize" : "with a CompressedDataSize of " + text) +
                      " in the header; expected the number of compressed bytes, which shows whether they are "
                      "all there");
  }
  return *size;
}

/** Throws FileError unless the image is binary, has one component per pixel, and has one byte order. */
void
CheckMetaImageMeaning(const std::string & file, const MetaImageHeader & header)
{
  const std::string channels = header.Field("ElementNumberOfChannels");
  if (!channels.empty() && channels != "1")
  {
    const std::optional<std::uint64_t> number = WholeNumber(channels);
    throw FileError(file,
                    number ? SeveralComponents(*number) : "ElementNumberOfChannels is " + channels + "; expected 1");
  }
  const std::string binary = header.Field("BinaryData");
  if (!binary.empty() && !IsTrue(binary))
  {
    throw FileError(file, "BinaryData is False, and pixels written as text cannot be checked; expected binary pixels");
  }
  const std::string order = header.Field("BinaryDataByteOrderMSB");
  const std::string sameOrder = header.Field("ElementByteOrderMSB");
  if (!order.empty() && !sameOrder.empty() && IsTrue(order) != IsTrue(sameOrder))
  {
    throw FileError(file,
                    "BinaryDataByteOrderMSB is " + order + " and ElementByteOrderMSB " + sameOrder +
                      "; expected the same of both");
  }
}

/** Returns the numbers of the last of these fields that the header has; empty if it has none. */
std::vector<double>
NumbersOfLast(const MetaImageHeader & header, std::initializer_list<const char *> keys)
{
  std::vector<double> numbers;
  for (const char * const key : keys)
  {
    numbers = header.Field(key).empty() ? numbers : NumbersOf(header.Field(key));
  }
  return numbers;
}

/** Returns the geometry from the fields of old and new versions of MetaIO. The last field that the header has counts,
 * as in MetaIO. */
StackGeometry
GeometryOfMetaImage(const MetaImageHeader & header, std::size_t axes)
{
  StackGeometry             geometry;
  const std::vector<double> spacing = NumbersOfLast(header, { "ElementSize", "ElementSpacing" });
  const std::vector<double> origin = NumbersOfLast(header, { "Position", "Offset", "Origin", "ImagePosition" });
  const std::vector<double> cosines = NumbersOfLast(header, { "Orientation", "Rotation", "TransformMatrix" });
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    geometry.spacing[axis] = spacing.empty() ? 1.0 : spacing[axis];
    geometry.origin[axis] = origin.empty() ? 0.0 : origin[axis];
    for (std::size_t row = 0; row < axes && !cosines.empty(); ++row)
    {
      geometry.direction[row][axis] = cosines[axis * axes + row];
    }
  }
  return UsableGeometry(geometry);
}

/** Returns the offset of the pixels that the header gives [bytes]; 0 if it gives none. None if the pixels are the last
 * bytes of the file. Throws FileError. */
std::optional<std::uint64_t>
HeaderSizeOf(const std::string & file, const MetaImageHeader & header)
{
  const std::string text = header.Field("HeaderSize");
  if (text == "-1")
  {
    return std::nullopt;
  }
  const std::optional<std::uint64_t> size = text.empty() ? 0 : WholeNumber(text);
  if (!size || *size > INT32_MAX)
  {
    throw FileError(file, "HeaderSize is " + text + "; expected -1, 0 or a number of bytes");
  }
  return size;
}

/** Returns the place of the pixels of a MetaImage of \a size bytes, or in a list the place of each frame. Throws
 * FileError for a place within the header, a pattern of names, and a list without one file for each frame. */
std::vector<DataPlace>
PlacesOfMetaImage(const FrameFile & file, const MetaImageHeader & header, std::uint64_t size)
{
  const std::string                  dataFile = header.Field("ElementDataFile");
  const std::optional<std::uint64_t> headerSize = HeaderSizeOf(file.name, header);
  std::vector<DataPlace>             places;
  if (dataFile == "LOCAL" || dataFile == "Local" || dataFile == "local")
  {
    if (headerSize && *headerSize > 0 && *headerSize < header.end)
    {
      throw FileError(file.name,
                      "HeaderSize is " + std::to_string(*headerSize) + ", within the header of " +
                        std::to_string(header.end) + " bytes; expected the pixels after it");
    }
    const std::uint64_t offset = headerSize && *headerSize > 0 ? *headerSize : header.end;
    places.push_back({ file.name, std::min(offset, size), !headerSize, true });
    return places;
  }
  if (dataFile.find('%') != std::string::npos)
  {
    throw FileError(file.name,
                    "ElementDataFile is the pattern " + dataFile + "; expected LOCAL, LIST or the name of one file");
  }
  if (dataFile.rfind("LIST", 0) != 0)
  {
    places.push_back({ PathOfDataFile(file.name, dataFile), headerSize.value_or(0), !headerSize, false });
    return places;
  }
  const std::string dimension = WithoutBlanks(dataFile.substr(4));
  if (header.Field("NDims") != "3" || !(dimension.empty() || dimension == "2"))
  {
    throw FileError(file.name,
                    "ElementDataFile is " + dataFile + "; expected a list with one file for each frame of a 3-D image");
  }
  if (header.list.size() != file.frames)
  {
    throw FileError(file.name,
                    (header.list.size() < file.frames ? "truncated: " : "") + std::to_string(header.list.size()) +
                      " whole lines in its list of data files, expected " + std::to_string(file.frames));
  }
  for (const std::string & line : header.list)
  {
    places.push_back({ PathOfDataFile(file.name, line), headerSize.value_or(0), !headerSize, false });
  }
  return places;
}
} // namespace

bool
IsHeadOfMetaImage(const std::string & head, const std::string & name)
{
  return HasEnding(name, { ".mha", ".mhd" }) && head.find_first_of("=:") != std::string::npos &&
         head.rfind("NRRD", 0) != 0;
}

void
InspectMetaImage(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating)
{
  const MetaImageHeader header = ReadMetaImageHeader(file.name, bytes);
  CheckMetaImageMeaning(file.name, header);
  SetPixelOfMetaImage(file, header.Field("ElementType"));
  std::vector<std::uint64_t> sizes;
  for (const std::string & word : WordsOf(header.Field("DimSize")))
  {
    const std::optional<std::uint64_t> number = WholeNumber(word);
    if (!number)
    {
      throw FileError(file.name, "DimSize is " + header.Field("DimSize") + "; expected whole numbers");
    }
    sizes.push_back(*number);
  }
  SetFrameSizes(file, sizes);
  file.geometry = GeometryOfMetaImage(header, sizes.size());
  const bool isBigEndian =
    IsTrue(header.Field("BinaryDataByteOrderMSB")) || IsTrue(header.Field("ElementByteOrderMSB"));
  DataCoding coding;
  coding.sample = WholeSample(file, isBigEndian);
  coding.compressedBytes = CompressedBytesOf(file.name, header);
  if (coding.compressedBytes > 0)
  {
    coding.compression = InflateContainer::ZlibOrGzip;
  }
  SetDataFrames(file, PlacesOfMetaImage(file, header, bytes.Size()), coding, beforeInflating);
}

std::vector<std::string>
DataFilesOfMetaImage(FileBytes & bytes, const std::string & name)
{
  const MetaImageHeader    header = ReadMetaImageHeader(name, bytes);
  const std::string        dataFile = header.Field("ElementDataFile");
  std::vector<std::string> paths;
  if (dataFile.rfind("LIST", 0) != 0 && LowerCase(dataFile) != "local")
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
