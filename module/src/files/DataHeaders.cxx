// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0

#include "sensornoise/FrameFile.h"
#include "base/Text.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace sensornoise
{
namespace
{
/** Count of the numbers of a MetaImage field: `fixed`, or, for `power` above 0, the number of dimensions to this power.
 */
struct NumberField
{
  const char * name;
  std::size_t  fixed;
  std::size_t  power; // exponent of the number of dimensions
};

constexpr std::array<NumberField, 20> NumberFields{ { { "ID", 1, 0 },
                                                      { "ParentID", 1, 0 },
                                                      { "Color", 4, 0 },
                                                      { "Position", 0, 1 },
                                                      { "Origin", 0, 1 },
                                                      { "Offset", 0, 1 },
                                                      { "TransformMatrix", 0, 2 },
                                                      { "Rotation", 0, 2 },
                                                      { "Orientation", 0, 2 },
                                                      { "CenterOfRotation", 0, 1 },
                                                      { "ElementSpacing", 0, 1 },
                                                      { "ElementSize", 0, 1 },
                                                      { "DimSize", 0, 1 },
                                                      { "ImagePosition", 0, 1 },
                                                      { "SequenceID", 0, 1 },
                                                      { "ElementMin", 1, 0 },
                                                      { "ElementMax", 1, 0 },
                                                      { "ElementNBits", 1, 0 },
                                                      { "ElementToIntensityFunctionSlope", 1, 0 },
                                                      { "ElementToIntensityFunctionOffset", 1, 0 } } };

void
RequireNumbers(const std::string &     file,
               const MetaImageHeader & header,
               const std::string &     key,
               const std::string &     value)
{
  for (const NumberField & field : NumberFields)
  {
    if (key != field.name)
    {
      continue;
    }
    std::size_t count = field.fixed;
    if (field.power > 0)
    {
      const std::string dimensions = header.Field("NDims");
      if (dimensions.empty())
      {
        throw FileError(file, key + " stands before NDims in its header; expected NDims first");
      }
      const std::size_t n = static_cast<std::size_t>(*WholeNumber(dimensions));
      count = field.power == 1 ? n : n * n;
    }
    if (NumbersOf(value).size() != count)
    {
      throw FileError(file, key + " is \"" + value + "\"; expected finite numbers: " + std::to_string(count));
    }
  }
}

bool
IsTrueOrFalse(const std::string & value)
{
  static const std::array<std::string, 12> words{ "True",  "true",  "TRUE",  "T", "t", "1",
                                                  "False", "false", "FALSE", "F", "f", "0" };
  return std::find(words.begin(), words.end(), value) != words.end();
}

/** Throws FileError unless a known field has an allowed value. */
void
CheckMetaImageField(const std::string &     file,
                    const MetaImageHeader & header,
                    const std::string &     key,
                    const std::string &     value)
{
  if (key == "NDims" && value != "2" && value != "3")
  {
    throw FileError(file, "NDims is " + value + "; expected 2 (a frame) or 3 (a stack)");
  }
  if (key == "ObjectType" && value != "Image")
  {
    throw FileError(file, "ObjectType is " + value + "; expected Image");
  }
  if ((key == "BinaryData" || key == "CompressedData" || key == "BinaryDataByteOrderMSB" ||
       key == "ElementByteOrderMSB") &&
      !IsTrueOrFalse(value))
  {
    throw FileError(file, key + " is " + value + "; expected True or False");
  }
  RequireNumbers(file, header, key, value);
}

/** Adds the field of a line to the header. Throws FileError. */
void
AddMetaImageField(const std::string & file, const TextHeader & text, const std::string & line, MetaImageHeader & header)
{
  const std::string place = "line " + std::to_string(text.LineNumber()) + " of its header ";
  const std::size_t separator = line.find_first_of("=:");
  const std::string key = WithoutBlanks(line.substr(0, separator));
  if (separator == std::string::npos || key.empty())
  {
    throw FileError(file, place + "is not the name of a field, \"=\" and a value; expected a MetaImage");
  }
  const std::size_t first = line.find_first_not_of("=: \t", separator);
  const std::string value = first == std::string::npos ? "" : WithoutBlanks(line.substr(first));
  if (value.empty())
  {
    throw FileError(file, place + "gives no value for " + key + "; expected one");
  }
  CheckMetaImageField(file, header, key, value);
  if (!header.fields.emplace(key, value).second)
  {
    throw FileError(file, place + "gives " + key + " a second time; expected each field once");
  }
}
} // namespace

std::string
MetaImageHeader::Field(const std::string & key) const
{
  const auto found = fields.find(key);
  return found == fields.end() ? "" : found->second;
}

MetaImageHeader
ReadMetaImageHeader(const std::string & file, FileBytes & bytes)
{
  MetaImageHeader            header;
  TextHeader                 text(file, bytes);
  std::optional<std::string> line;
  while (header.Field("ElementDataFile").empty() && (line = text.Next()))
  {
    if (!WithoutBlanks(*line).empty())
    {
      AddMetaImageField(file, text, *line, header);
    }
  }
  header.end = text.Offset();
  for (const char * const required : { "NDims", "DimSize", "ElementType", "ElementDataFile" })
  {
    if (header.Field(required).empty())
    {
      throw FileError(file, "has no " + std::string(required) + " in its header; expected a MetaImage that is whole");
    }
  }
  if (header.Field("ElementDataFile").rfind("LIST", 0) == 0)
  {
    bool isBlankBefore = false;
    while ((line = text.Next()))
    {
      const bool isBlank = WithoutBlanks(*line).empty();
      if (isBlankBefore && !isBlank)
      {
        throw FileError(file, "has an empty line in its list of data files; expected a name in each");
      }
      isBlankBefore = isBlank;
      // a last line without an end may be incomplete
      if (text.LineWasEnded() && !isBlank)
      {
        header.list.push_back(WithoutBlanks(*line));
      }
    }
  }
  return header;
}

namespace
{
constexpr std::array<const char *, 32> NrrdFields{ "content",
                                                   "number",
                                                   "type",
                                                   "block size",
                                                   "dimension",
                                                   "space",
                                                   "space dimension",
                                                   "sizes",
                                                   "spacings",
                                                   "thicknesses",
                                                   "axis mins",
                                                   "axis maxs",
                                                   "space directions",
                                                   "centers",
                                                   "centerings",
                                                   "kinds",
                                                   "labels",
                                                   "units",
                                                   "min",
                                                   "max",
                                                   "old min",
                                                   "old max",
                                                   "endian",
                                                   "encoding",
                                                   "line skip",
                                                   "byte skip",
                                                   "sample units",
                                                   "space units",
                                                   "space origin",
                                                   "measurement frame",
                                                   "data file",
                                                   "datafile" };

/** Returns the name of the field that `key` means, in any of its spellings; "" if it is none. */
std::string
FieldNamed(const std::string & key)
{
  const std::string name = LowerCase(key);
  for (const char * const field : NrrdFields)
  {
    std::string joined = field;
    joined.erase(std::remove(joined.begin(), joined.end(), ' '), joined.end());
    if (name == field || name == joined)
    {
      return name == "datafile" ? "data file" : name == "centers" ? "centerings" : field;
    }
  }
  return "";
}

/** Adds the field of a line to the header. Returns the name of the field; "" for a comment or a key with its value.
 * Throws FileError. */
std::string
AddNrrdField(const std::string & file, const TextHeader & text, const std::string & line, NrrdHeader & header)
{
  if (line[0] == '#')
  {
    return "";
  }
  const std::string place = "line " + std::to_string(text.LineNumber()) + " of its header ";
  const std::size_t colon = line.find(": ");
  std::string       name = colon == std::string::npos ? "" : FieldNamed(line.substr(0, colon));
  if (name.empty())
  {
    if (line.find(":=") == std::string::npos)
    {
      throw FileError(file, place + "is neither a field of NRRD nor a comment nor a key with its value");
    }
    return "";
  }
  const std::size_t first = line.find_first_not_of(" \t", colon + 1);
  if (first == std::string::npos)
  {
    throw FileError(file, place + "gives no value for " + name + "; expected one");
  }
  if (!header.fields.emplace(name, line.substr(first)).second)
  {
    throw FileError(file, place + "gives " + name + " a second time; expected each field once");
  }
  return name;
}
} // namespace

std::string
NrrdHeader::Field(const std::string & key) const
{
  const auto found = fields.find(key);
  return found == fields.end() ? "" : found->second;
}

NrrdHeader
ReadNrrdHeader(const std::string & file, FileBytes & bytes)
{
  NrrdHeader                 header;
  TextHeader                 text(file, bytes);
  std::optional<std::string> line = text.Next();
  if (!line || line->size() != 8 || line->rfind("NRRD000", 0) != 0 || line->back() < '1' || line->back() > '5')
  {
    throw FileError(file, "its first line is not NRRD0001 to NRRD0005; expected a NRRD file of one of these versions");
  }
  bool ended = false;
  bool isList = false;
  while (!ended && (line = text.Next()))
  {
    if (!text.LineWasEnded())
    {
      throw FileError(file, "truncated: the last line of its header has no end");
    }
    if (isList && !line->empty())
    {
      header.list.push_back(*line);
    }
    else if (line->empty())
    {
      ended = !isList;
    }
    else
    {
      isList =
        AddNrrdField(file, text, *line, header) == "data file" && header.Field("data file").rfind("LIST", 0) == 0;
    }
  }
  header.end = text.Offset();
  if (!ended && header.Field("data file").empty())
  {
    throw FileError(file, "truncated: its header does not end with an empty line, and names no data file");
  }
  return header;
}

} // namespace sensornoise
