// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameFormats.h"

#include "files/FileBytes.h"
#include "files/FrameReader.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace sensornoise
{
namespace
{
constexpr std::uint64_t LongestNpyHeader = 65536; // [bytes]; numpy writes about 100

/** Header: its dictionary as text, and the offset of the pixels [bytes]. */
struct NpyHeader
{
  std::string   text{};
  std::uint64_t end{ 0 };
};

NpyHeader
ReadNpyHeader(const std::string & file, FileBytes & bytes)
{
  std::array<unsigned char, 12> head{};
  bytes.Read(0, head.data(), 10);
  const unsigned version = head[6];
  if (version < 1 || version > 3)
  {
    throw FileError(file, "NPY version " + std::to_string(version) + "; expected 1 to 3");
  }
  const std::size_t width = version == 1 ? 2 : 4;
  bytes.Read(0, head.data(), 8 + width);
  const std::uint64_t length = NumberInBytes(head.data() + 8, width, false);
  NpyHeader           header;
  header.end = 8 + width + length;
  if (length > LongestNpyHeader || !bytes.Holds(8 + width, length))
  {
    throw FileError(file,
                    "damaged or truncated: a header of " + std::to_string(length) + " bytes in a file of " +
                      std::to_string(bytes.Size()) + "; expected at most " + std::to_string(LongestNpyHeader));
  }
  header.text.resize(static_cast<std::size_t>(length));
  bytes.Read(8 + width, header.text.data(), header.text.size());
  return header;
}

/** Returns the text behind "'key':", without spaces before it. Throws FileError unless the key occurs exactly once. */
std::string
ValueInDictionary(const std::string & file, const std::string & text, const std::string & key)
{
  const std::string quoted = "'" + key + "':";
  const std::size_t at = text.find(quoted);
  if (at == std::string::npos || text.find(quoted, at + 1) != std::string::npos)
  {
    throw FileError(file, "damaged: its header has not one " + quoted + "; expected a NPY file of numpy.save()");
  }
  const std::size_t begin = text.find_first_not_of(' ', at + quoted.size());
  return begin == std::string::npos ? "" : text.substr(begin);
}

/** Returns the format of a type in the notation of numpy, for example '<u2'. Throws FileError for other types. */
SampleFormat
FormatOfNpy(const std::string & file, const std::string & value)
{
  struct KnownType
  {
    const char * name;
    FramePixel   pixel;
    StoredNumber stored;
  };
  constexpr StoredNumber                    same = StoredNumber::SameAsPixel;
  static constexpr std::array<KnownType, 7> types{ { { "u1", FramePixel::UnsignedChar, same },
                                                     { "u2", FramePixel::UnsignedShort, same },
                                                     { "i2", FramePixel::Short, same },
                                                     { "u4", FramePixel::Double, StoredNumber::UnsignedInt },
                                                     { "i4", FramePixel::Double, StoredNumber::Int },
                                                     { "f4", FramePixel::Float, same },
                                                     { "f8", FramePixel::Double, same } } };
  const std::size_t                         end = value.find('\'', 1);
  const bool         isText = value.size() > 1 && value[0] == '\'' && end != std::string::npos && end >= 3;
  const std::string  type = isText ? value.substr(1, end - 1) : "";
  const auto * const found = std::find_if(
    types.begin(), types.end(), [&](const KnownType & known) { return isText && type.substr(1) == known.name; });
  const bool hasOrder = isText && (type[0] == '<' || type[0] == '>' || (type[0] == '|' && type == "|u1"));
  if (found == types.end() || !hasOrder)
  {
    throw FileError(file,
                    "its elements are " + (isText ? PrintableText(type) : "records") +
                      ", which are not supported; expected u1, u2, i2, u4, i4, f4 or f8: array.astype(numpy.uint16)");
  }
  SampleFormat format;
  format.pixel = found->pixel;
  format.stored = found->stored;
  format.isBigEndian = type[0] == '>';
  format.bits = static_cast<unsigned>(8 * SizeOf(found->pixel, found->stored));
  return format;
}

/** Returns the axes of '(60, 480, 640)', the slowest first. Throws FileError if it is no shape. */
std::vector<std::uint64_t>
ShapeOfNpy(const std::string & file, const std::string & value)
{
  const std::size_t          end = value.find(')');
  const std::string          shape = value.substr(0, end == std::string::npos ? 0 : end + 1);
  std::vector<std::uint64_t> axes;
  std::string                number;
  bool                       isShape = shape.size() > 2 && shape[0] == '(';
  for (std::size_t i = 1; isShape && i < shape.size(); ++i)
  {
    if (shape[i] != ',' && shape[i] != ')')
    {
      number += shape[i];
      continue;
    }
    const std::string digits = WithoutBlanks(number);
    if (!digits.empty() || shape[i] == ',') // "(5, )" has one axis
    {
      const std::optional<std::uint64_t> axis = WholeNumber(digits);
      isShape = axis.has_value();
      axes.push_back(axis.value_or(0));
    }
    number.clear();
  }
  if (!isShape)
  {
    throw FileError(file, "damaged: its shape is " + PrintableText(shape) + "; expected (frames, rows, columns)");
  }
  return axes;
}
} // namespace

bool
IsHeadOfNpy(const std::string & head, const std::string & /*name*/)
{
  return head.rfind("\x93NUMPY", 0) == 0;
}

void
InspectNpy(FileBytes & bytes, FrameFile & file, const BeforeInflating & /*beforeInflating*/)
{
  const NpyHeader   header = ReadNpyHeader(file.name, bytes);
  const std::string order = ValueInDictionary(file.name, header.text, "fortran_order");
  FramePlaces       places;
  places.path = file.name;
  places.offset = header.end;
  places.sample = FormatOfNpy(file.name, ValueInDictionary(file.name, header.text, "descr"));
  const std::vector<std::uint64_t> shape = ShapeOfNpy(file.name, ValueInDictionary(file.name, header.text, "shape"));
  if (order.rfind("False", 0) != 0)
  {
    throw FileError(
      file.name, "its array is in Fortran's order; expected C order: numpy.save(name, numpy.ascontiguousarray(array))");
  }
  if (shape.size() < 2 || shape.size() > 3)
  {
    throw FileError(file.name,
                    "its array has " + std::to_string(shape.size()) +
                      " axes; expected (rows, columns) of a frame or (frames, rows, columns) of a stack");
  }
  std::vector<std::uint64_t> sizes(shape.rbegin(), shape.rend());
  sizes.resize(3, 1);
  file.pixel = places.sample.pixel;
  SetFrameSizes(file, sizes);
  SetFramePlaces(file, places, bytes.Size(), sizes[2]);
}

} // namespace sensornoise
