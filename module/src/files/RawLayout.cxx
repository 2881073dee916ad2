// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0

#include "base/Text.h"
#include "files/FileBytes.h"
#include "files/FrameFormats.h"
#include "files/FrameReader.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
[[noreturn]] void
RefuseLayout(const std::string & text, const std::string & found)
{
  throw std::invalid_argument(
    "\"" + text + "\" is no layout of raw frames: " + found +
    "; expected WIDTHxHEIGHT:TYPE[:SKIP[:ROW[:GAP[:END]]]], for example 640x480:uint16le or 1920x1080:Mono12p:64");
}

std::vector<std::string>
Parted(const std::string & text, char separator)
{
  std::vector<std::string> parts{ "" };
  for (const char c : text)
  {
    if (c == separator)
    {
      parts.emplace_back();
    }
    else
    {
      parts.back() += c;
    }
  }
  return parts;
}

struct NumberType
{
  const char * name;
  FramePixel   pixel;
  bool         isBigEndian;
  StoredNumber stored;
};

std::optional<SampleFormat>
FormatOfNumbers(const std::string & name)
{
  constexpr StoredNumber                      same = StoredNumber::SameAsPixel;
  static constexpr std::array<NumberType, 13> types{
    { { "uint8", FramePixel::UnsignedChar, false, same },
      { "uint16le", FramePixel::UnsignedShort, false, same },
      { "uint16be", FramePixel::UnsignedShort, true, same },
      { "int16le", FramePixel::Short, false, same },
      { "int16be", FramePixel::Short, true, same },
      { "uint32le", FramePixel::Double, false, StoredNumber::UnsignedInt },
      { "uint32be", FramePixel::Double, true, StoredNumber::UnsignedInt },
      { "int32le", FramePixel::Double, false, StoredNumber::Int },
      { "int32be", FramePixel::Double, true, StoredNumber::Int },
      { "float32le", FramePixel::Float, false, same },
      { "float32be", FramePixel::Float, true, same },
      { "float64le", FramePixel::Double, false, same },
      { "float64be", FramePixel::Double, true, same } }
  };
  const auto * const found =
    std::find_if(types.begin(), types.end(), [&](const NumberType & type) { return name == type.name; });
  if (found == types.end())
  {
    return std::nullopt;
  }
  SampleFormat format;
  format.pixel = found->pixel;
  format.stored = found->stored;
  format.isBigEndian = found->isBigEndian;
  format.bits = static_cast<unsigned>(8 * SizeOf(found->pixel, found->stored));
  return format;
}

/** Returns the format of the bits and the end of a name, for example "12p"; none for other names. */
std::optional<SampleFormat>
FormatOfBits(const std::string & bitsAndEnd, SamplePacking packing, const std::string & end)
{
  if (bitsAndEnd.size() < end.size() || bitsAndEnd.substr(bitsAndEnd.size() - end.size()) != end)
  {
    return std::nullopt;
  }
  const std::string bits = bitsAndEnd.substr(0, bitsAndEnd.size() - end.size());
  const bool        isWhole = packing == SamplePacking::Whole;
  const bool        isPacked = bits == "10" || bits == "12" || (bits == "14" && packing != SamplePacking::GigE);
  if (!(isWhole ? bits == "8" || bits == "10" || bits == "12" || bits == "14" || bits == "16" : isPacked))
  {
    return std::nullopt;
  }
  SampleFormat format;
  format.packing = packing;
  format.bits = static_cast<unsigned>(std::stoul(bits));
  format.pixel = format.bits == 8 ? FramePixel::UnsignedChar : FramePixel::UnsignedShort;
  return format;
}

struct NameOfPacking
{
  const char *  begin;
  const char *  end;
  SamplePacking packing;
};

/** Returns the format of a name without a Bayer pattern; none for unknown names. */
std::optional<SampleFormat>
FormatOfCamera(const std::string & name)
{
  static constexpr std::array<NameOfPacking, 7> names{ { { "mono", "", SamplePacking::Whole },
                                                         { "mono", "p", SamplePacking::LowestFirst },
                                                         { "mono", "packed", SamplePacking::GigE },
                                                         { "raw", "", SamplePacking::Mipi },
                                                         { "s", "p", SamplePacking::Mipi },
                                                         { "s", "", SamplePacking::Whole },
                                                         { "uint", "msb", SamplePacking::HighestFirst } } };
  for (const NameOfPacking & known : names)
  {
    const std::string begin = known.begin;
    if (name.rfind(begin, 0) == 0)
    {
      if (const auto format = FormatOfBits(name.substr(begin.size()), known.packing, known.end))
      {
        return format;
      }
    }
  }
  return std::nullopt;
}

/** Removes the pattern from "bayerrg12p" or "srggb10p", which leaves "mono12p" or "s10p". Returns the pattern; "" if
 * there is none. */
std::string
TakePattern(std::string & name)
{
  static constexpr std::array<const char *, 4> patterns{ { "rggb", "grbg", "gbrg", "bggr" } };
  for (const std::string pattern : patterns)
  {
    const std::string genicam = "bayer" + pattern.substr(0, 2);
    const std::string linux = "s" + pattern;
    const bool        isGenicam = name.rfind(genicam, 0) == 0;
    if (isGenicam || name.rfind(linux, 0) == 0)
    {
      name = (isGenicam ? "mono" : "s") + name.substr(isGenicam ? genicam.size() : linux.size());
      std::string upper = pattern;
      std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
      return upper;
    }
  }
  return "";
}

void
ReadType(const std::string & text, const std::string & type, RawLayout & layout)
{
  std::string name = LowerCase(type);
  if (const auto numbers = FormatOfNumbers(name))
  {
    layout.sample = *numbers;
    return;
  }
  layout.camera.bayerPattern = TakePattern(name);
  const bool isLinux = name.size() > 1 && name[0] == 's';
  const auto camera = isLinux && layout.camera.bayerPattern.empty() ? std::nullopt : FormatOfCamera(name);
  if (!camera)
  {
    const bool lacksOrder = FormatOfNumbers(name + "le").has_value();
    if (name.rfind("uint64", 0) == 0 || name.rfind("int64", 0) == 0)
    {
      RefuseLayout(text, "integers of 64 bits (" + type + ") are not supported; expected integers of up to 32 bits");
    }
    RefuseLayout(text,
                 lacksOrder
                   ? "the type " + type + " does not say which byte comes first; " + name + "le or " + name + "be would"
                   : "the type \"" + type +
                       "\" is not known (uint8, uint16le, float32le, Mono12p, "
                       "Mono12Packed, RAW10, SRGGB10P and others are)");
  }
  layout.sample = *camera;
  layout.camera.bitDepth = camera->bits;
}

std::uint64_t
ReadCount(const std::string & text, const std::string & what, const std::string & digits)
{
  const std::optional<std::uint64_t> number = WholeNumber(digits);
  if (!number)
  {
    RefuseLayout(text, what + " is \"" + digits + "\", not a whole number");
  }
  return *number;
}

/** Returns ":SKIP:ROW:GAP:END" of a layout, up to the last number that is not 0. */
std::string
BytesBesidePixels(const RawLayout & layout)
{
  std::string text;
  std::string upToLast;
  for (const std::uint64_t bytes : { layout.skipBytes, layout.rowBytes, layout.gapBytes, layout.endBytes })
  {
    text += ":" + std::to_string(bytes);
    upToLast = bytes != 0 ? text : upToLast;
  }
  return upToLast;
}

/** Returns a warning if the bytes of 16-bit pixels seem swapped in the first frame; else "". */
std::string
WarningOfByteOrder(FileBytes & bytes, const RawLayout & layout)
{
  const FramePixel pixel = layout.sample.pixel;
  if (layout.sample.packing != SamplePacking::Whole || layout.rowBytes % 2 != 0 ||
      (pixel != FramePixel::UnsignedShort && pixel != FramePixel::Short))
  {
    return "";
  }
  constexpr std::uint64_t    most = std::uint64_t{ 1 } << 16; // [pixels]
  const auto                 pixels = static_cast<std::size_t>(std::min(layout.width * layout.height, most));
  std::vector<unsigned char> held(2 * pixels);
  bytes.Read(layout.skipBytes, held.data(), held.size());
  const ByteOrders     orders = CompareByteOrders(held.data(), pixels, pixel == FramePixel::Short);
  const bool           isBig = layout.sample.isBigEndian;
  const BytesInOrder & given = isBig ? orders.big : orders.little;
  if (!given.IsSwapped(isBig ? orders.little : orders.big))
  {
    return "";
  }
  const std::string type = pixel == FramePixel::Short ? "int16" : "uint16";
  return "its bytes look swapped, as neighbouring pixels differ far less in the other order. Use the type " + type +
         (isBig ? "le" : "be") + ": --raw " + std::to_string(layout.width) + "x" + std::to_string(layout.height) + ":" +
         type + (isBig ? "le" : "be") + BytesBesidePixels(layout);
}

/** Format of raw frames. It is not in the table of formats, because nothing identifies such a file. */
const FrameFormat RawFormat{ "raw frames without a header", false, nullptr, nullptr };
} // namespace

RawLayout
ReadRawLayout(const std::string & text)
{
  const std::vector<std::string> parts = Parted(text, ':');
  const std::vector<std::string> size = Parted(LowerCase(parts.front()), 'x');
  if (parts.size() < 2 || parts.size() > 6 || size.size() != 2)
  {
    RefuseLayout(text,
                 size.size() != 2 ? "its size is \"" + parts.front() + "\""
                                  : "it has " + std::to_string(parts.size()) + " parts");
  }
  RawLayout layout;
  layout.width = ReadCount(text, "the width", size[0]);
  layout.height = ReadCount(text, "the height", size[1]);
  constexpr std::uint64_t longest = INT32_MAX;
  if (layout.width < 1 || layout.height < 1 || layout.width > longest || layout.height > longest)
  {
    RefuseLayout(text, "a size of " + parts.front() + " pixels");
  }
  ReadType(text, parts[1], layout);
  layout.skipBytes = parts.size() > 2 ? ReadCount(text, "the bytes to skip", parts[2]) : 0;
  layout.rowBytes = parts.size() > 3 ? ReadCount(text, "the bytes of a row", parts[3]) : 0;
  layout.gapBytes = parts.size() > 4 ? ReadCount(text, "the bytes behind a frame", parts[4]) : 0;
  layout.endBytes = parts.size() > 5 ? ReadCount(text, "the bytes at the end", parts[5]) : 0;
  return layout;
}

FrameFile
InspectRawFile(const std::string & name, const RawLayout & layout)
{
  FrameFile file;
  file.name = name;
  file.identities.push_back(IdentityOf(name));
  file.format = &RawFormat;
  file.pixel = layout.sample.pixel;
  file.camera = layout.camera;
  SetFrameSizes(file, { layout.width, layout.height });
  FileBytes   bytes(name);
  FramePlaces places;
  places.path = name;
  places.offset = layout.skipBytes;
  places.rowBytes = layout.rowBytes;
  places.gapBytes = layout.gapBytes;
  places.endBytes = layout.endBytes;
  places.sample = layout.sample;
  SetFramePlaces(file, places, bytes.Size(), std::nullopt);
  file.warning = WarningOfByteOrder(bytes, layout);
  RequireUnchanged(file);
  return file;
}

} // namespace sensornoise
