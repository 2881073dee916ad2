// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TiffPage.h"

#include "files/TextHeader.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sensornoise
{
namespace
{
/** The number in ImageJ's line "key=number"; nothing where there is none. */
std::optional<std::uint64_t>
NumberOfImageJ(const std::string & text, const std::string & key)
{
  const std::size_t line = text.rfind("ImageJ=", 0) == 0 ? text.find("\n" + key + "=") : std::string::npos;
  if (line == std::string::npos)
  {
    return std::nullopt;
  }
  const std::size_t begin = line + key.size() + 2;
  return WholeNumber(text.substr(begin, text.find_first_of(std::string("\n\r\0", 3), begin) - begin));
}

/** The value of an attribute of an XML element. */
std::string
AttributeOf(const std::string & element, const std::string & name)
{
  const std::string start = " " + name + "=";
  const std::size_t at = element.find(start);
  if (at == std::string::npos || at + start.size() >= element.size())
  {
    return "";
  }
  const char        quote = element[at + start.size()];
  const std::size_t begin = at + start.size() + 1;
  const std::size_t end = element.find(quote, begin);
  return (quote == '"' || quote == '\'') && end != std::string::npos ? element.substr(begin, end - begin) : "";
}

std::vector<FrameAxis>
AxesOfOme(const std::string & file, const std::string & text)
{
  const std::size_t begin = text.find("<Pixels ");
  const std::size_t end = text.find('>', std::min(begin, text.size()));
  if (text.find("<OME") == std::string::npos || end == std::string::npos)
  {
    return {};
  }
  if (text.find("<Pixels ", end) != std::string::npos)
  {
    throw FileError(file, "its OME-XML describes several images; expected one, a burst, in a file of its own");
  }
  std::string element = text.substr(begin, end - begin);
  std::replace_if(element.begin(), element.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  std::vector<FrameAxis> axes;
  for (const char letter : AttributeOf(element, "DimensionOrder"))
  {
    if (letter == 'C' || letter == 'Z' || letter == 'T')
    {
      const std::string size = AttributeOf(element, std::string("Size") + letter);
      const auto        kind = letter == 'C'   ? FrameAxis::Kind::Channel
                               : letter == 'Z' ? FrameAxis::Kind::Plane
                                               : FrameAxis::Kind::Time;
      axes.push_back({ kind, static_cast<std::size_t>(WholeNumber(size).value_or(1)) });
    }
  }
  return axes;
}
} // namespace

std::string
DescriptionOf(TiffBytes & tiff, const TiffDirectory & directory)
{
  constexpr std::uint64_t longest = std::uint64_t{ 1 } << 20;
  const TiffEntry * const entry = directory.Find(270);
  if (entry == nullptr || entry->type != 2)
  {
    return "";
  }
  std::string text(static_cast<std::size_t>(std::min(entry->count, longest)), '\0');
  tiff.File().Read(entry->offset, text.data(), text.size());
  return text;
}

std::optional<std::uint64_t>
ImagesOfImageJ(const std::string & description)
{
  return NumberOfImageJ(description, "images");
}

std::vector<FrameAxis>
AxesOfDescription(const std::string & file, const std::string & description)
{
  std::vector<FrameAxis> axes;
  if (description.rfind("ImageJ=", 0) == 0)
  {
    using Kind = FrameAxis::Kind;
    for (const auto & [key, kind] : { std::pair{ "channels", Kind::Channel },
                                      std::pair{ "slices", Kind::Plane },
                                      std::pair{ "frames", Kind::Time } })
    {
      axes.push_back({ kind, static_cast<std::size_t>(NumberOfImageJ(description, key).value_or(1)) });
    }
  }
  else
  {
    axes = AxesOfOme(file, description);
  }
  axes.erase(std::remove_if(axes.begin(), axes.end(), [](const FrameAxis & axis) { return axis.size <= 1; }),
             axes.end());
  const bool isTime = axes.size() == 1 && axes.front().kind != FrameAxis::Kind::Channel;
  return isTime ? std::vector<FrameAxis>() : axes;
}

} // namespace sensornoise
